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
    /// Cosine and sine of the lowest and of the highest angle.
    range: Option<[[f32; 2]; 2]>,
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

    fn bind(&mut self, body: &Body) {
        self.joints = body.actuated().map(|hinge| Joint { hinge: hinge.clone(), range: None }).collect();
    }

    fn begin(&mut self, start: &Snapshot) {
        self.begun = start.time;
        self.joints.iter_mut().for_each(|joint| joint.range = None);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if now.time - self.begun >= START {
            for joint in &mut self.joints {
                let now = joint.hinge.direction(&now.parts);
                let [low, high] = joint.range.unwrap_or([now; 2]);
                let lower = if turned(low, now) < 0.0 { now } else { low };
                let higher = if turned(high, now) > 0.0 { now } else { high };
                joint.range = Some([lower, higher]);
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        let idle = |joint: &Joint| {
            let range = joint
                .range
                .map_or(0.0, |[low, high]| libm::atan2f(turned(low, high), low[0] * high[0] + low[1] * high[1]).abs());
            1.0 - f64::from((range / EXPECTED).min(1.0))
        };
        self.joints.iter().map(idle).sum::<f64>() / self.joints.len().max(1) as f64
    }
}

/// The sine of the angle from one direction to another.
fn turned([c, s]: [f32; 2], [cos, sin]: [f32; 2]) -> f32 {
    c * sin - s * cos
}
