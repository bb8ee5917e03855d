use crate::{Body, PartState, Snapshot};

/// Tells when a foot comes down and when it is lifted.
///
/// It is lifted once it is 3 cm, or 2.5 % of the body length if that is more, above ground that is flat at height 0, or on uneven ground
/// as high above where it last stood: feet that shiver or drag do not step, and feet that are lifted do not stumble over every bump.
#[derive(Clone, Debug, Default)]
pub(super) struct Foot {
    part: usize,
    corners: Vec<[f32; 2]>,
    radius: f32,
    /// m.
    clearance: f32,
    uneven_ground: bool,
    down: bool,
    /// How high the ground is on which it last stood, m.
    ground: f32,
}

/// What has happened to a foot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FootChange {
    CameDown,
    Lifted,
}

/// m.
const CLEARANCE: f32 = 0.03;
/// Body lengths.
const RELATIVE_CLEARANCE: f32 = 0.025;

impl Foot {
    /// This part of the body.
    pub(super) fn new(body: &Body, part: usize) -> Self {
        Self {
            part,
            corners: body.parts[part].corners.clone(),
            radius: body.parts[part].radius,
            clearance: CLEARANCE.max(RELATIVE_CLEARANCE * body.body_length),
            uneven_ground: body.uneven_ground,
            ..Self::default()
        }
    }

    pub(super) fn begin(&mut self, start: &Snapshot) {
        (self.down, self.ground) = (start.parts[self.part].touching, 0.0);
    }

    pub(super) fn observe(&mut self, now: &Snapshot) -> Option<FootChange> {
        let part = &now.parts[self.part];
        if part.touching && self.uneven_ground {
            self.ground = self.lowest_point(part);
        }
        if part.touching && !self.down {
            self.down = true;
            Some(FootChange::CameDown)
        } else if !part.touching && self.down && self.lowest_point(part) > self.ground + self.clearance {
            self.down = false;
            Some(FootChange::Lifted)
        } else {
            None
        }
    }

    /// m.
    fn lowest_point(&self, part: &PartState) -> f32 {
        let height = |[x, y]: &[f32; 2]| part.y + part.sin * x + part.cos * y;
        self.corners.iter().map(height).fold(f32::INFINITY, f32::min) - self.radius
    }
}
