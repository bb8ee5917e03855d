use super::{Cheat, CheatKind, sustained::worst};
use crate::{PartState, gait::Trajectory};
use std::f64::consts::FRAC_PI_4;

/// Above this an environment calls a body exploded, m/s.
const SPEED_CAP: f64 = 100.0;
/// rapier lets a part turn by 45° a step.
const TURN_CAP: f64 = FRAC_PI_4;
/// What is within a thousandth of a cap is at the cap.
const NEARLY: f64 = 0.999;

/// Parts at a cap: their path is then the cap's, and not that of a body.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Vec<Cheat> {
    let seconds = trajectory.time_step();
    // A part that jumps from one place to another has moved, whatever its speed says.
    let speed = |before: &PartState, now: &PartState| {
        let [vx, vy, dx, dy] = [now.vx, now.vy, now.x - before.x, now.y - before.y].map(f64::from);
        libm::hypot(vx, vy).max(libm::hypot(dx, dy) / seconds)
    };
    let spin = |_: &PartState, now: &PartState| f64::from(now.spin).abs();
    type Figure<'a> = &'a dyn Fn(&PartState, &PartState) -> f64;
    let caps: [(CheatKind, Figure<'_>, f64); 2] =
        [(CheatKind::SpeedCap, &speed, SPEED_CAP), (CheatKind::SpinCap, &spin, TURN_CAP / seconds)];
    let mut cheats = Vec::new();
    for (part, of_part) in trajectory.body().parts.iter().enumerate() {
        for (kind, figure, cap) in caps {
            let states = || trajectory.snapshots().iter().map(|snapshot| &snapshot.parts[part]);
            let before = states().take(1).chain(states());
            let figures = before.zip(states()).map(|(before, now)| figure(before, now));
            let worst = worst(figures).filter(|worst| worst.figure >= NEARLY * cap);
            cheats.extend(worst.map(|worst| Cheat {
                kind,
                part: of_part.name.clone(),
                worst: worst.figure,
                threshold: cap,
                time: trajectory.time(worst.snapshot),
            }));
        }
    }
    cheats
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{Pose, body, film};

    #[test]
    fn a_part_at_a_cap_is_flagged() {
        let mut walk = film(2.0, Pose::walking);
        walk[30].parts[2].spin = -39.27;
        walk[40].parts[0].vx = 100.0;
        let cheats = find(&Trajectory::new(&body(), &walk).expect("a script"));
        let found: Vec<_> = cheats.iter().map(|cheat| (cheat.kind, &cheat.part[..])).collect();
        assert_eq!(found, [(CheatKind::SpeedCap, "torso"), (CheatKind::SpinCap, "right leg")]);
        let mut jumping = film(2.0, Pose::walking);
        jumping[40..].iter_mut().for_each(|snapshot| snapshot.parts[0].x += 10.0);
        let cheats = find(&Trajectory::new(&body(), &jumping).expect("a script"));
        assert_eq!(cheats.iter().map(|cheat| cheat.part.as_str()).collect::<Vec<_>>(), ["torso"]);
        assert!((cheats[0].time - 0.8).abs() < 0.03, "{}", cheats[0].time);
    }
}
