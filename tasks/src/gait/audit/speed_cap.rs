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
    let speed: fn(&PartState) -> f64 = |state| libm::hypot(f64::from(state.vx), f64::from(state.vy));
    let spin: fn(&PartState) -> f64 = |state| f64::from(state.spin).abs();
    let caps = [(CheatKind::SpeedCap, speed, SPEED_CAP), (CheatKind::SpinCap, spin, TURN_CAP / trajectory.time_step())];
    let mut cheats = Vec::new();
    for (part, of_part) in trajectory.body().parts.iter().enumerate() {
        for (kind, figure, cap) in caps {
            let figures = trajectory.snapshots().iter().map(|snapshot| figure(&snapshot.parts[part]));
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
    }
}
