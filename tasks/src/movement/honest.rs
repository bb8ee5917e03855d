use super::{Movement, Verdict};
use crate::{Body, BodyHinge, BodyPart, PartState, Snapshot};

/// Fails the evaluation of a body that lives on the errors of its physics: whose joints come apart by more than 6 cm or
/// turn more than 18° beyond their limits, whose parts turn by more than 40° in a step, or sink more than 6 cm into
/// ground that is flat at height 0. Its value is 0.
///
/// This is the cheap part of the [audit](crate::gait) that every champion undergoes, looked at every third step, so that
/// such bodies are no example to others.
#[derive(Clone, Debug, Default)]
pub struct Honest {
    hinges: Vec<Hinge>,
    parts: Vec<BodyPart>,
    steps: u32,
    time: f32,
}

#[derive(Clone, Debug)]
struct Hinge {
    hinge: BodyHinge,
    /// Cosine and sine of the angle in the middle between the limits.
    middle: [f32; 2],
    /// The cosine of the furthest it may turn from there.
    least_cosine: f32,
}

const EVERY: u32 = 3;
/// m.
const WIDEST: f32 = 0.06;
/// rad.
const TOLERANCE: f32 = 0.314;
/// rad in a step; engines stop at 45°.
const FASTEST: f32 = 0.7;
/// m.
const DEEPEST: f32 = 0.06;

impl Movement for Honest {
    fn name(&self) -> &str {
        "honest"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn meet(&mut self, body: &Body) {
        let hinge = |hinge: &BodyHinge| {
            let [low, high] = hinge.limits;
            let middle = hinge.start_angle + 0.5 * (low + high);
            // Beyond half a turn either way nothing can be told apart.
            let furthest = (0.5 * (high - low) + TOLERANCE).min(std::f32::consts::PI);
            let middle = [libm::cosf(middle), libm::sinf(middle)];
            Hinge { hinge: hinge.clone(), middle, least_cosine: libm::cosf(furthest) }
        };
        self.hinges = body.hinges.iter().map(hinge).collect();
        self.parts = body.parts.clone();
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.steps, self.time) = (0, start.time);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.steps += 1;
        let time_step = now.time - self.time;
        self.time = now.time;
        if !self.steps.is_multiple_of(EVERY) {
            return Verdict::GoOn;
        }
        for Hinge { hinge, middle: [c, s], least_cosine } in &self.hinges {
            let (parent, child) = (&now.parts[hinge.parent], &now.parts[hinge.child]);
            let [px, py] = in_world(parent, hinge.parent_anchor);
            let [qx, qy] = in_world(child, hinge.child_anchor);
            let (x, y) = (qx - px, qy - py);
            if x * x + y * y > WIDEST * WIDEST {
                return Verdict::Fail("a joint comes apart");
            }
            let [cos, sin] = hinge.direction(&now.parts);
            if c * cos + s * sin < *least_cosine {
                return Verdict::Fail("a joint is turned beyond its limits");
            }
        }
        for (part, state) in self.parts.iter().zip(&now.parts) {
            if state.spin.abs() * time_step > FASTEST {
                return Verdict::Fail("a part turns faster than the engine can follow");
            }
            if part.lowest_point(state) < -DEEPEST {
                return Verdict::Fail("a part sinks into the ground");
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        0.0
    }
}

fn in_world(part: &PartState, [x, y]: [f32; 2]) -> [f32; 2] {
    [part.x + part.cos * x - part.sin * y, part.y + part.sin * x + part.cos * y]
}
