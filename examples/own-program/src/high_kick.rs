//! The high kick: what it is, when it is one, and what a body feels of it.

use creatures::{Blueprint, BodyView, Channel, Sense};
use serde::Deserialize;
use tasks::{
    Movement, Snapshot, Verdict,
    gait::{Findings, GaitReport, Goal, Reason, Rules, Trajectory, View},
};

/// How high the highest limb has been above the ground, m; nothing once the body turns over.
#[derive(Clone, Default)]
pub(crate) struct HighKick(f32);

impl Movement for HighKick {
    fn name(&self) -> &str {
        "high-kick"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn begin(&mut self, _: &Snapshot) {
        self.0 = 0.0;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if now.torso().cos < 0.0 {
            self.0 = 0.0;
            return Verdict::End;
        }
        self.0 = self.0.max(highest_limb(now));
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.0.into()
    }
}

/// The middle of the highest part but the torso, which is the first, m.
fn highest_limb(now: &Snapshot) -> f32 {
    now.parts[1..].iter().fold(0.0, |highest, part| highest.max(part.y))
}

/// A kick is usable if it is as high as the torso was at the start, and the body does not turn over.
#[derive(Debug)]
pub(crate) struct CleanKick;

/// What is tilted farther lies on its back, degrees.
const LARGEST_TILT: f64 = 120.0;

impl Rules for CleanKick {
    fn name(&self) -> &str {
        "high-kick"
    }

    fn seconds(&self) -> f64 {
        3.0
    }

    fn view(&self) -> View {
        View { goal: Goal::Height, ..View::default() }
    }

    fn judge(&self, gait: &GaitReport, trajectory: &Trajectory<'_>) -> Findings {
        let reached = f64::from(trajectory.snapshots().iter().map(highest_limb).fold(0.0, f32::max));
        let required = trajectory.start_height();
        let low = (reached < required).then(|| {
            Reason::other("low-kick", format!("kicks {reached:.2} m high, at least {required:.2} m required"))
        });
        let tilt = gait.torso.largest_tilt;
        let tumbling = (tilt > LARGEST_TILT).then(|| {
            Reason::other("tumbling", format!("torso: tilted by {tilt:.0}°, at most {LARGEST_TILT:.0}° allowed"))
        });
        Findings::new(low.into_iter().chain(tumbling))
    }
}

/// The sensor: how far each joint of a leg is lifted from its start pose, as a share of `most` degrees.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Lift {
    most: f32,
}

impl Default for Lift {
    fn default() -> Self {
        Self { most: 90.0 }
    }
}

impl Sense for Lift {
    fn channels(&self, blueprint: &Blueprint) -> Vec<Channel> {
        let part = |&hinge: &usize| &blueprint.parts()[blueprint.hinges()[hinge].child].name;
        let channel = |hinge| Channel { name: format!("lift of {}", part(hinge)), unit: "", range: [0.0, 1.0] };
        blueprint.actuated().iter().map(channel).collect()
    }

    fn read(&self, body: &dyn BodyView, channel: usize) -> f32 {
        body.joint_angle(channel).to_degrees() / self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use envs_core::conformance::check_sense;
    use ne_core::conformance::Violation;
    use tasks::conformance::{check_movement, check_rules};

    #[test]
    fn movement_rules_and_sensor_keep_their_promises() -> Result<(), Violation> {
        check_movement(&HighKick::default())?;
        check_rules(&CleanKick)?;
        check_sense(&Lift::default())
    }
}
