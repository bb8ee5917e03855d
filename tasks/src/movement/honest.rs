use super::{Movement, Verdict};
use crate::{Body, BodyHinge, BodyPart, PartState, Snapshot};

/// Fails the evaluation of a body that lives on the errors of its physics: whose joints come apart by more than 6 cm or
/// turn more than 18° beyond their limits, whose parts turn by more than 40° in a step, or sink more than 6 cm into
/// ground that is flat at height 0; or which gains, within 0.5 s, over 7 J plus 0.175 × weight × start height more energy
/// than its motors worked. Its value is 0.
///
/// This is the cheap part of the [audit](crate::gait) that every champion undergoes, looked at every third step, and the energy at
/// every step, so that such bodies are no example to others.
#[derive(Clone, Debug, Default)]
pub struct Honest {
    hinges: Vec<Hinge>,
    parts: Vec<BodyPart>,
    gravity: f32,
    uneven_ground: bool,
    steps: u32,
    time: f32,
    surplus: Surplus,
}

/// Energy beyond the motors' work, J.
#[derive(Clone, Debug, Default)]
struct Surplus {
    /// The most that may be gained.
    most: f32,
    /// The least in the half window before this one, and in this one so far.
    least: [f32; 2],
    /// When this half window began, s.
    began: f32,
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
/// What the audit allows, J and as a share of weight × start height, with a margin.
const GAIN: f32 = 0.7 * 10.0;
const GAIN_SHARE: f32 = 0.7 * 0.25;
/// s; two of them are a push of a leg.
const HALF_WINDOW: f32 = 0.25;

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
        self.gravity = body.gravity;
        self.uneven_ground = body.uneven_ground;
        let mass: f32 = body.parts.iter().map(|part| part.mass).sum();
        self.surplus.most = GAIN + GAIN_SHARE * mass * body.gravity.abs() * body.start_height;
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.steps, self.time) = (0, start.time);
        self.surplus.least = [self.surplus(start); 2];
        self.surplus.began = start.time;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.steps += 1;
        let time_step = now.time - self.time;
        self.time = now.time;
        // A gain may last for a step alone.
        let surplus = self.surplus(now);
        if self.surplus.gained(surplus, now.time) {
            return Verdict::Fail("it gains energy from nowhere");
        }
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
            if !self.uneven_ground && part.lowest_point(state) < -DEEPEST {
                return Verdict::Fail("a part sinks into the ground");
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        0.0
    }
}

impl Honest {
    /// Kinetic and potential energy less the motors' work, J.
    fn surplus(&self, now: &Snapshot) -> f32 {
        let energy = |(part, state): (&BodyPart, &PartState)| {
            let PartState { vx, vy, spin, y, .. } = *state;
            0.5 * part.mass * (vx * vx + vy * vy) + 0.5 * part.inertia * spin * spin + part.mass * self.gravity * y
        };
        let energy: f32 = self.parts.iter().zip(&now.parts).map(energy).sum();
        // The work grows without end: its difference must not be lost in rounding.
        (f64::from(energy) - now.motor_work) as f32
    }
}

impl Surplus {
    /// Whether more was gained within the window than may be.
    fn gained(&mut self, surplus: f32, time: f32) -> bool {
        if time - self.began >= HALF_WINDOW {
            self.least = [self.least[1], surplus];
            self.began = time;
        }
        self.least[1] = self.least[1].min(surplus);
        surplus - self.least[0].min(self.least[1]) > self.most
    }
}

fn in_world(part: &PartState, [x, y]: [f32; 2]) -> [f32; 2] {
    [part.x + part.cos * x - part.sin * y, part.y + part.sin * x + part.cos * y]
}
