use super::{Cheat, CheatKind};
use crate::gait::{Trajectory, contact, trajectory::shorter_way};
use std::f64::consts::FRAC_PI_2;

/// A torso tilted farther than 60° is falling,
const FALLING: f64 = std::f64::consts::FRAC_PI_3;
/// if it then comes to lie: tilts farther than 90°, or touches the ground.
const LYING: f64 = FRAC_PI_2;
/// The most of the distance that may be made from there on.
const LARGEST_SHARE: f64 = 0.5;
/// A body that topples gets its own height ahead, and a little more for its limbs.
const TOPPLING: f64 = 1.2;
/// Less than this share of the start height is no distance at all.
const NOWHERE: f64 = 0.1;

/// Bodies that fall, and count that as distance: most of the distance is made in falls and what follows them (from 60° of
/// tilt on, until the torso is up again), or there is no more distance than toppling gives, and the body lies at the end.
///
/// A runner that leans over farther than 60° and never comes to lie has not fallen.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Option<Cheat> {
    // A body that has turned over is up again.
    let tilt = |step: usize| shorter_way(trajectory.tilts()[step]).abs();
    let lies = |step: usize| tilt(step) > LYING || trajectory.snapshots()[step].torso().touching;
    let falls: Vec<_> = contact::ranges((0..trajectory.tilts().len()).map(|step| tilt(step) > FALLING))
        .into_iter()
        .filter(|fall| fall.clone().any(lies))
        .collect();
    let end = trajectory.steps();
    let distance = trajectory.progress(0, end);
    let first = falls.first().filter(|_| distance > NOWHERE * trajectory.start_height())?;
    let cheat = |kind, worst, threshold| Cheat {
        kind,
        part: trajectory.body().parts[0].name.clone(),
        worst,
        threshold,
        time: trajectory.time(*first.start()),
    };
    let toppling = TOPPLING * trajectory.start_height();
    let ends_lying = falls.last().is_some_and(|fall| *fall.end() == end);
    if distance <= toppling && ends_lying {
        return Some(cheat(CheatKind::Toppling, distance, toppling));
    }
    let fallen: f64 = falls.iter().map(|fall| trajectory.progress(fall.start().saturating_sub(1), *fall.end())).sum();
    let share = fallen / distance;
    (share > LARGEST_SHARE && share.is_finite()).then(|| cheat(CheatKind::Fall, share, LARGEST_SHARE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{Pose, body, film};

    use std::f64::consts::PI;

    /// Tips over in the first second, then goes on at a speed, m/s.
    fn tipping(speed: f64, up_again: bool) -> Option<Cheat> {
        let script = |step: usize| {
            let time = step as f64 * 0.02;
            let tilt = if up_again && time > 2.0 { 0.0 } else { -0.5 * PI * time.min(1.0) };
            let lies = time >= 1.0 && tilt != 0.0;
            let x = 0.8 * time.min(1.0) + speed * (time - 1.0).max(0.0);
            Pose { x, tilt, touching: [lies, true, true], ..Pose::standing() }
        };
        find(&Trajectory::new(&body(), &film(20.0, script)).expect("a script"))
    }

    #[test]
    fn one_that_only_topples_is_flagged() {
        let cheat = tipping(0.0, false).expect("flagged");
        assert_eq!(cheat.kind, CheatKind::Toppling);
        assert!((cheat.worst - 0.8).abs() < 1e-5);
    }

    #[test]
    fn one_that_gets_ahead_lying_is_flagged() {
        assert_eq!(tipping(0.5, false).map(|cheat| cheat.kind), Some(CheatKind::Fall));
    }

    #[test]
    fn one_that_turns_over_and_goes_on_upright_is_not() {
        let tumbling = |step: usize| {
            let time = step as f64 * 0.02;
            let tilt = -2.0 * PI * time.min(1.0);
            Pose { x: 0.5 * time, tilt, touching: [(0.3..0.7).contains(&time), true, true], ..Pose::standing() }
        };
        assert_eq!(find(&Trajectory::new(&body(), &film(20.0, tumbling)).expect("a script")), None);
    }

    #[test]
    fn one_that_gets_up_and_goes_is_not() {
        assert_eq!(tipping(0.5, true), None);
    }
}
