//! The body as the senses see it.

use crate::{Character, Command, PartState};
use alloc::vec::Vec;
use creatures::{
    BodyView, Landings, Shape,
    rotation::{angle_from, turned_back},
};

/// A body in the pose in which it starts, and what the senses need to know of it.
#[derive(Clone, Debug)]
pub(crate) struct Rest {
    /// Cosine and sine of the torso's angle.
    torso: [f32; 2],
    hinges: Vec<RestHinge>,
    shapes: Vec<Shape>,
}

#[derive(Clone, Copy, Debug)]
struct RestHinge {
    parent: usize,
    child: usize,
    /// Cosine and sine of the child's angle against the parent.
    angle: [f32; 2],
}

impl Rest {
    /// `character` faces right.
    pub(crate) fn new(character: &Character) -> Self {
        let direction = |angle| [libm::cosf(angle), libm::sinf(angle)];
        let parts = &character.parts;
        let hinges = character.hinges.iter().map(|hinge| {
            let (parent, child) = (usize::from(hinge.parent), usize::from(hinge.child));
            RestHinge { parent, child, angle: direction(parts[child].angle - parts[parent].angle) }
        });
        Self {
            torso: direction(parts[0].angle),
            hinges: hinges.collect(),
            shapes: parts.iter().map(|part| part.shape).collect(),
        }
    }

    /// The angle of each hinge, rad.
    pub(crate) fn joint_angles(&self, parts: &[PartState], angles: &mut [f32]) {
        let direction = |part: usize| [parts[part].cos, parts[part].sin];
        for (angle, hinge) in angles.iter_mut().zip(&self.hinges) {
            *angle = angle_from(hinge.angle, turned_back(direction(hinge.parent), direction(hinge.child)));
        }
    }
}

/// A body now, facing right.
pub(crate) struct Body<'a> {
    pub(crate) rest: &'a Rest,
    pub(crate) parts: &'a [PartState],
    pub(crate) joint_angles: &'a [f32],
    /// Height of the torso's centre at rest, m.
    pub(crate) rest_height: f32,
    pub(crate) time: f32,
    pub(crate) landings: Landings,
    pub(crate) command: Command,
    pub(crate) since_press: f32,
    pub(crate) stride_began: f32,
}

impl BodyView for Body<'_> {
    fn torso_rotation(&self) -> f32 {
        angle_from(self.rest.torso, [self.parts[0].cos, self.parts[0].sin])
    }

    fn torso_spin(&self) -> f32 {
        self.parts[0].spin
    }

    fn joint_angle(&self, hinge: usize) -> f32 {
        self.joint_angles[hinge]
    }

    fn joint_speed(&self, hinge: usize) -> f32 {
        let RestHinge { parent, child, .. } = self.rest.hinges[hinge];
        self.parts[child].spin - self.parts[parent].spin
    }

    fn torso_velocity(&self) -> [f32; 2] {
        [self.parts[0].vx, self.parts[0].vy]
    }

    fn torso_height(&self) -> f32 {
        self.parts[0].y - self.rest_height
    }

    fn touches_ground(&self, part: usize) -> bool {
        self.parts[part].touching != 0
    }

    fn slip(&self, part: usize) -> f32 {
        let (state, shape) = (&self.parts[part], self.rest.shapes[part]);
        match state.touching {
            0 => 0.0,
            // The velocity of the point below the centre.
            _ => state.vx - state.spin * shape.lowest_point(state.cos, state.sin),
        }
    }

    /// Measured by the game.
    fn next_gap(&self, _: f32) -> [f32; 2] {
        [f32::NAN; 2]
    }

    /// Measured by the game.
    fn distance_along_ray(&self, _: f32, _: f32) -> f32 {
        f32::NAN
    }

    fn time(&self) -> f32 {
        self.time
    }

    fn time_since_landing(&self) -> f32 {
        self.landings.since(self.time)
    }

    fn commanded_speed(&self) -> f32 {
        self.command.speed
    }

    fn is_told_to_jump(&self) -> bool {
        self.command.jump != 0
    }

    fn time_since_press(&self) -> f32 {
        self.since_press
    }

    fn stride_time(&self) -> f32 {
        self.time - self.stride_began
    }
}
