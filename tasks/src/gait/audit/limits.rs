use super::{Cheat, CheatKind, sustained::sustained};
use crate::gait::Trajectory;
use std::f64::consts::TAU;

/// A strong motor overshoots a soft limit by about 9° (0.15 rad): flagged is twice that.
const TOLERANCE: f64 = 20.0;

/// Joints beyond their limits for two steps in a row, or three times as far for one. Limits a whole turn apart are
/// none.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Vec<Cheat> {
    let of_hinge = |(index, hinge): (usize, &crate::BodyHinge)| {
        let [low, high] = hinge.limits.map(f64::from);
        let beyond = trajectory.hinge_angles(index).iter().map(|angle| (low - angle).max(angle - high).to_degrees());
        let worst = sustained(beyond, TOLERANCE).filter(|_| high - low < TAU)?;
        Some(Cheat {
            kind: CheatKind::LimitViolation,
            part: trajectory.hinge_name(hinge).into(),
            worst: worst.figure,
            threshold: TOLERANCE,
            time: trajectory.time(worst.snapshot),
        })
    };
    trajectory.body().hinges.iter().enumerate().filter_map(of_hinge).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{Pose, body, film};

    fn beyond(degrees: f64) -> Vec<Cheat> {
        let angle = 1.0 + degrees.to_radians();
        // Turned by steps small enough to tell one way round from the other.
        let bent = film(2.0, |step| Pose { hips: [angle * (step as f64 / 50.0).min(1.0), 0.0], ..Pose::walking(step) });
        find(&Trajectory::new(&body(), &bent).expect("a script"))
    }

    #[test]
    fn a_leg_far_beyond_its_limit_is_flagged() {
        let cheats = beyond(30.0);
        assert_eq!(cheats.len(), 1);
        assert!((cheats[0].worst - 30.0).abs() < 1e-3);
        // Turned right round, it is where it was, and still beyond.
        assert_eq!(beyond(300.0).len(), 1);
    }

    #[test]
    fn the_overshoot_of_a_strong_motor_is_ordinary() {
        assert_eq!(beyond(9.0), []);
    }
}
