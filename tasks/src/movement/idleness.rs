use super::{Movement, Verdict};
use crate::{Body, BodyHinge, Snapshot};

/// How much of the motion that is expected of them joints leave out: 0 if every actuated joint has moved through 30° or
/// more since the first second, 1 if none has moved at all. Weigh it negatively.
#[derive(Clone, Debug, Default)]
pub struct Idleness {
    joints: Vec<Joint>,
    begun: f32,
}

#[derive(Clone, Debug, Default)]
struct Joint {
    hinge: BodyHinge,
    range: Option<[f32; 2]>,
}

/// rad.
const EXPECTED: f32 = 0.524;
/// s.
const START: f32 = 1.0;

impl Movement for Idleness {
    fn name(&self) -> &str {
        "idleness"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn meet(&mut self, body: &Body) {
        self.joints = body.actuated().map(|hinge| Joint { hinge: hinge.clone(), range: None }).collect();
    }

    fn begin(&mut self, start: &Snapshot) {
        self.begun = start.time;
        self.joints.iter_mut().for_each(|joint| joint.range = None);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if now.time - self.begun >= START {
            for joint in &mut self.joints {
                let angle = joint.hinge.angle(&now.parts);
                let [low, high] = joint.range.unwrap_or([angle; 2]);
                joint.range = Some([low.min(angle), high.max(angle)]);
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        let idle = |joint: &Joint| {
            let [low, high] = joint.range.unwrap_or_default();
            1.0 - f64::from(((high - low) / EXPECTED).min(1.0))
        };
        self.joints.iter().map(idle).sum::<f64>() / self.joints.len().max(1) as f64
    }
}
