//! Parts and hinges as engines want them.

use crate::{Motor, Shape};

/// A rigid body, in the pose in which the creature starts.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyPart {
    /// Its name, unique in the creature.
    pub name: String,
    /// Its tag, such as `torso` or `leg`.
    pub tag: String,
    /// Its shape, centred on (`x`, `y`).
    pub shape: Shape,
    /// Mass per area, kg/m².
    pub density: f32,
    /// Coulomb friction coefficient, 0 to 10.
    pub friction: f32,
    /// Centre, forward, m.
    pub x: f32,
    /// Centre, up, m.
    pub y: f32,
    /// Turned counter-clockwise, rad.
    pub angle: f32,
    /// Whether its tag is an actuated one. Its hinge may still lack a motor: see [`Hinge::actuated`].
    pub actuated: bool,
    /// Whether the chain it belongs to may be a leg: see [`Part::leg`](crate::Part::leg).
    pub leg: bool,
}

/// A hinge between two parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinge {
    /// Index of the part it hangs on; smaller than `child`.
    pub parent: usize,
    /// Index of the part that hangs on it; never 0, the torso.
    pub child: usize,
    /// The hinge in the parent's own frame, m.
    pub parent_anchor: [f32; 2],
    /// The hinge in the child's own frame, m.
    pub child_anchor: [f32; 2],
    /// Smallest and largest angle of the child against the parent, rad, relative to the start pose: at most 0, at
    /// least 0, no more than 2π apart.
    pub limits: [f32; 2],
    /// What drives it; without a motor it is limp. That of a hinge that is not actuated holds still, with its top torque
    /// at most.
    pub motor: Option<Motor>,
    /// Whether its motor is an output of the net: it has one, and its child has an actuated tag.
    pub actuated: bool,
}

impl BodyPart {
    /// Mass, kg.
    pub fn mass(&self) -> f32 {
        self.density * self.shape.area()
    }

    /// Height of its lowest point in the start pose, m.
    pub fn lowest_point(&self) -> f32 {
        self.y + self.shape.lowest_point(libm::cosf(self.angle), libm::sinf(self.angle))
    }

    /// A point of the world, m, in the frame the part has in the start pose.
    pub fn to_local(&self, point: [f32; 2]) -> [f32; 2] {
        to_local([self.x, self.y], self.angle, point)
    }
}

/// A point of the world in the frame at `origin` that is turned by `angle`, rad.
pub(crate) fn to_local(origin: [f32; 2], angle: f32, point: [f32; 2]) -> [f32; 2] {
    let (cos, sin) = (libm::cosf(angle), libm::sinf(angle));
    let (x, y) = (point[0] - origin[0], point[1] - origin[1]);
    [cos * x + sin * y, cos * y - sin * x]
}
