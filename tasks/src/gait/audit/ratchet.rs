use super::{Cheat, CheatKind};
use crate::gait::{Trajectory, contact};

/// Half the speed a usable gait needs, body lengths/s.
const FASTEST: f64 = 0.25;
/// Shorter stretches without a touchdown, in s, are a stride or a glide.
const STRETCH: f64 = 2.0;

/// A body that in the second half gets ahead in stretches in which no foot (legless: no part) comes down: it slides,
/// shaken forward by the friction. The figure is the progress in all such stretches over the time of the second half.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Option<Cheat> {
    let body = trajectory.body();
    let parts: Vec<usize> =
        if body.legless || body.legs.is_empty() { (0..body.parts.len()).collect() } else { body.feet().collect() };
    let (half, end) = (trajectory.at(0.5), trajectory.steps());
    let mut borders = vec![half, end];
    for part in parts {
        let stances = contact::stances(trajectory, part);
        borders.extend(stances.iter().map(|stance| stance.start().saturating_sub(1)).filter(|step| *step > half));
    }
    borders.sort_unstable();
    let stretches = borders.windows(2).map(|pair| (pair[0], pair[1]));
    let (mut progress, mut longest) = (0.0, (half, half));
    for (from, to) in stretches.filter(|&(from, to)| trajectory.time(to - from) > STRETCH) {
        progress += trajectory.progress(from, to).max(0.0);
        if to - from > longest.1 - longest.0 {
            longest = (from, to);
        }
    }
    let speed = progress / trajectory.time(end - half) / f64::from(body.body_length);
    (speed > FASTEST).then(|| Cheat {
        kind: CheatKind::FrictionRatchet,
        part: body.parts[0].name.clone(),
        worst: speed,
        threshold: FASTEST,
        time: trajectory.time(longest.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{Pose, body, film};

    #[test]
    fn a_body_that_slides_without_steps_is_flagged() {
        let sliding = film(20.0, |step| Pose { touching: [false, true, true], ..Pose::walking(step) });
        let cheat = find(&Trajectory::new(&body(), &sliding).expect("a script")).expect("flagged");
        assert!((cheat.worst - 1.0).abs() < 1e-5, "{cheat}");
    }

    #[test]
    fn a_single_step_does_not_hide_a_slide() {
        let sliding = film(20.0, |step| Pose { touching: [false, true, step / 5 != 150], ..Pose::walking(step) });
        assert!(find(&Trajectory::new(&body(), &sliding).expect("a script")).is_some());
    }
}
