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
    /// Whether it has moved as far as is expected: what is more than half a turn apart looks closer again.
    moved: bool,
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
        self.joints = body.actuated().map(|hinge| Joint { hinge: hinge.clone(), range: None, moved: false }).collect();
    }

    fn begin(&mut self, start: &Snapshot) {
        self.begun = start.time;
        self.joints.iter_mut().for_each(|joint| (joint.range, joint.moved) = (None, false));
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if now.time - self.begun >= START {
            for joint in self.joints.iter_mut().filter(|joint| !joint.moved) {
                let now = joint.hinge.direction(&now.parts);
                let [low, high] = joint.range.unwrap_or([now; 2]);
                let lower = if turned(low, now) < 0.0 { now } else { low };
                let higher = if turned(high, now) > 0.0 { now } else { high };
                joint.range = Some([lower, higher]);
                joint.moved = joint.moved_by() >= EXPECTED;
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        let idle = |joint: &Joint| 1.0 - f64::from((joint.moved_by() / EXPECTED).min(1.0));
        self.joints.iter().map(idle).sum::<f64>() / self.joints.len().max(1) as f64
    }
}

impl Joint {
    /// The angle from the lowest to the highest, rad.
    fn moved_by(&self) -> f32 {
        let angle =
            |[low, high]: [[f32; 2]; 2]| libm::atan2f(turned(low, high), low[0] * high[0] + low[1] * high[1]).abs();
        self.range.map_or(0.0, angle)
    }
}

/// The sine of the angle from one direction to another.
fn turned([c, s]: [f32; 2], [cos, sin]: [f32; 2]) -> f32 {
    c * sin - s * cos
}
