use super::{
    Movement, Verdict,
    foot::{Foot, FootChange},
};
use crate::{Body, Snapshot};

/// Watches that every leg is used: that its foot comes down, and leaves the ground, at least every 0.9 s. Its value is the
/// way the torso made while legs were idle, m, forwards or backwards, in proportion to how many: all of it counts where a
/// third of the legs are idle. With a weight of −1 such way earns nothing. It ends the episode when half of the legs are idle.
///
/// A foot counts as off the ground once it is 3 cm above it, or 2.5 % of the body length if that is more, and on uneven ground as high above
/// where it last stood: feet that shiver or drag do not step. Creatures without legs are left alone.
#[derive(Clone, Debug, Default)]
pub struct Footfalls {
    legs: Vec<Leg>,
    x: f32,
    way: f32,
}

#[derive(Clone, Debug)]
struct Leg {
    foot: Foot,
    last_down: f32,
    last_up: f32,
}

/// Of the legs: if so many are idle no way counts.
const WORTHLESS: f32 = 1.0 / 3.0;
/// Of the legs: if so many are idle the body has stopped walking.
const STOPPED: f32 = 0.5;
/// s.
const PATIENCE: f32 = 0.9;

impl Movement for Footfalls {
    fn name(&self) -> &str {
        "footfalls"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        let leg = |part: usize| Leg { foot: Foot::new(body, part), last_down: 0.0, last_up: 0.0 };
        self.legs = if body.legless { Vec::new() } else { body.feet().map(leg).collect() };
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.x, self.way) = (start.torso().x, 0.0);
        for leg in &mut self.legs {
            leg.foot.begin(start);
            (leg.last_down, leg.last_up) = (start.time, start.time);
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let mut idle = 0.0;
        for leg in &mut self.legs {
            match leg.foot.observe(now) {
                Some(FootChange::CameDown) => leg.last_down = now.time,
                Some(FootChange::Lifted) => leg.last_up = now.time,
                None => {}
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
