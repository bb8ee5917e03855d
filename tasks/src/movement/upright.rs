use super::{Movement, Verdict};
use crate::{PartState, Snapshot};
use std::f32::consts::FRAC_PI_4;

/// Ends the episode when the torso has turned too far from its start: by more than 60°, or by an angle of yours. Its
/// value is 1 if that happened and 0 if not, so that a weight can also charge for it.
///
/// Turns are added up, so a somersault does not come round to upright again.
#[derive(Clone, Debug)]
pub struct Upright {
    most: f32,
    turn: Turn,
    fallen: bool,
}

/// By how much something has turned since it was first looked at, full turns included.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turn {
    cos: f32,
    sin: f32,
    /// rad.
    pub(crate) angle: f32,
}

impl Turn {
    pub(crate) fn from(part: &PartState) -> Self {
        Self { cos: part.cos, sin: part.sin, angle: 0.0 }
    }

    pub(crate) fn follow(&mut self, part: &PartState) {
        let cos = self.cos * part.cos + self.sin * part.sin;
        let sin = self.cos * part.sin - self.sin * part.cos;
        self.angle += libm::atan2f(sin, cos);
        (self.cos, self.sin) = (part.cos, part.sin);
    }

    /// How upright it still is, 0 to 1: less by the square of the angle, nothing from 45° on.
    pub(crate) fn uprightness(&self) -> f32 {
        1.0 - (self.angle / FRAC_PI_4).powi(2).min(1.0)
    }
}

impl Upright {
    /// For a torso that may turn by so much, rad.
    pub fn within(most: f32) -> Self {
        Self { most, turn: Turn::default(), fallen: false }
    }
}

impl Default for Upright {
    fn default() -> Self {
        Self::within(std::f32::consts::FRAC_PI_3)
    }
}

impl Movement for Upright {
    fn name(&self) -> &str {
        "upright"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn begin(&mut self, start: &Snapshot) {
        self.turn = Turn::from(start.torso());
        self.fallen = false;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.turn.follow(now.torso());
        self.fallen |= self.turn.angle.abs() > self.most;
        if self.fallen { Verdict::End } else { Verdict::GoOn }
    }

    fn value(&self) -> f64 {
        f64::from(u8::from(self.fallen))
    }
}
