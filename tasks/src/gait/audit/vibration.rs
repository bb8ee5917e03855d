use super::{Cheat, CheatKind};
use crate::gait::{Goal, JointUse, Trajectory};

/// The eye blurs what swings faster, Hz; a usable run stays below 4.
const FASTEST: f64 = 8.0;
/// Smaller swings than this to either side, in degrees, propel no body.
const MATTERS: f64 = 2.0;
/// Two reversals make a cycle.
const MOST_REVERSALS: f64 = 2.0 * FASTEST;

/// Joints that vibrate: bodies that buzz over the ground on an engine's friction and softness.
pub(super) fn find(trajectory: &Trajectory<'_>, joints: &[JointUse], goal: Goal) -> Vec<Cheat> {
    let time = if goal == Goal::Height { 0.0 } else { trajectory.time(trajectory.at(0.5)) };
    let mut cheats = Vec::new();
    for joint in joints {
        let vibrates = joint.dominant_frequency > FASTEST && joint.dominant_amplitude > MATTERS;
        let chatters = joint.reversals > MOST_REVERSALS;
        let cheat = |kind, worst, threshold| Cheat { kind, part: joint.name.clone(), worst, threshold, time };
        cheats.extend(vibrates.then(|| cheat(CheatKind::Vibration, joint.dominant_frequency, FASTEST)));
        cheats.extend(chatters.then(|| cheat(CheatKind::Chatter, joint.reversals, MOST_REVERSALS)));
    }
    cheats
}

#[cfg(test)]
mod tests {
    use crate::gait::{
        CheatKind as Found, GaitReport,
        synthetic::{Pose, TIME_STEP, body, film},
    };
    use std::f64::consts::TAU;

    fn kinds(hertz: f64, swing: f64) -> Vec<Found> {
        let buzzing = film(20.0, |step| {
            let angle = swing * libm::sin(TAU * hertz * step as f64 * TIME_STEP);
            Pose { hips: [angle, Pose::walking(step).hips[1]], ..Pose::walking(step) }
        });
        let report = GaitReport::measure(&body(), &buzzing, None).expect("a script");
        report.cheats.iter().map(|cheat| cheat.kind).collect()
    }

    #[test]
    fn a_joint_that_buzzes_is_flagged() {
        assert_eq!(kinds(12.0, 0.05), [Found::Vibration, Found::Chatter]);
        assert_eq!(kinds(12.0, 0.005), []);
        assert_eq!(kinds(4.0, 0.1), []);
    }
}
