use super::{Movement, Verdict};
use crate::{Body, PartState, Snapshot};

/// Watches that every leg is used: that its foot comes down, and leaves the ground, at least every 0.9 s. Its value is the
/// way the torso made while legs were idle, m, forwards or backwards, in proportion to how many: all of it counts where a
/// third of the legs are idle. With a weight of −1 such way earns nothing. It ends the episode when half of the legs are idle.
///
/// A foot counts as off the ground once it is 3 cm, or 2.5 % of the body length if that is more, above ground that is flat at height 0, or on uneven ground as high above
/// where it last stood: feet that shiver or drag do not count as stepping, and feet that are lifted do not stumble over
/// every bump. Creatures without legs are left alone.
#[derive(Clone, Debug, Default)]
pub struct Footfalls {
    legs: Vec<Leg>,
    uneven_ground: bool,
    /// m.
    clearance: f32,
    x: f32,
    way: f32,
}

#[derive(Clone, Debug, Default)]
struct Leg {
    foot: usize,
    corners: Vec<[f32; 2]>,
    radius: f32,
    down: bool,
    /// How high the ground is on which it last stood, m.
    ground: f32,
    last_down: f32,
    last_up: f32,
}

/// Of the legs: if so many are idle no way counts.
const WORTHLESS: f32 = 1.0 / 3.0;
/// Of the legs: if so many are idle the body has stopped walking.
const STOPPED: f32 = 0.5;
/// s.
const PATIENCE: f32 = 0.9;
/// m.
const CLEARANCE: f32 = 0.03;
/// Body lengths.
const RELATIVE_CLEARANCE: f32 = 0.025;

impl Movement for Footfalls {
    fn name(&self) -> &str {
        "footfalls"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        let leg = |foot: usize| Leg {
            foot,
            corners: body.parts[foot].corners.clone(),
            radius: body.parts[foot].radius,
            ..Leg::default()
        };
        self.clearance = CLEARANCE.max(RELATIVE_CLEARANCE * body.body_length);
        self.uneven_ground = body.uneven_ground;
        self.legs = if body.legless { Vec::new() } else { body.feet().map(leg).collect() };
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.x, self.way) = (start.torso().x, 0.0);
        for leg in &mut self.legs {
            leg.down = start.parts[leg.foot].touching;
            leg.ground = 0.0;
            (leg.last_down, leg.last_up) = (start.time, start.time);
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let mut idle = 0.0;
        for leg in &mut self.legs {
            let part = &now.parts[leg.foot];
            if part.touching && self.uneven_ground {
                leg.ground = leg.lowest_point(part);
            }
            if part.touching && !leg.down {
                leg.down = true;
                leg.last_down = now.time;
            } else if !part.touching && leg.down && leg.lowest_point(part) > leg.ground + self.clearance {
                leg.down = false;
                leg.last_up = now.time;
            }
            if now.time - leg.last_down.min(leg.last_up) > PATIENCE {
                idle += 1.0;
            }
        }
        let way = (now.torso().x - self.x).abs();
        self.x = now.torso().x;
        if idle == 0.0 {
            return Verdict::GoOn;
        }
        let share = idle / self.legs.len() as f32;
        self.way += (share / WORTHLESS).min(1.0) * way;
        if share >= STOPPED { Verdict::End } else { Verdict::GoOn }
    }

    fn value(&self) -> f64 {
        self.way.into()
    }
}

impl Leg {
    /// Of its foot, m.
    fn lowest_point(&self, foot: &PartState) -> f32 {
        let height = |[x, y]: &[f32; 2]| foot.y + foot.sin * x + foot.cos * y;
        self.corners.iter().map(height).fold(f32::INFINITY, f32::min) - self.radius
    }
}
