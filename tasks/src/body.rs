//! What a body is made of, as far as the judges of its movement need to know.

/// A body as the judges of movements see it: its legs, hinges and masses, without looks, sensors or an engine.
///
/// Parts are told apart by their index in [`Snapshot::parts`](crate::Snapshot::parts); part 0 is the torso.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// The longer side of the bounding box in the start pose, m.
    pub body_length: f32,
    /// Height of the torso's centre above the lowest point in the start pose, m.
    pub start_height: f32,
    /// The torso's angle as the creature's file draws it, rad, counter-clockwise. Tilt counts from there, so that a body that
    /// topples while it settles is tilted.
    pub start_angle: f32,
    /// Gravity, m/s².
    pub gravity: f32,
    /// What each part is like.
    pub parts: Vec<BodyPart>,
    /// Every hinge; hinge `i` is the same everywhere.
    pub hinges: Vec<BodyHinge>,
    /// The legs: the indices of their parts, from hip to foot. Only legs that move actively are listed, and no arms.
    pub legs: Vec<Vec<usize>>,
    /// Whether it lies on the ground and crawls: its gait is told by its hinges, and not by its footfalls. The legs are
    /// then the chains that hang on its torso.
    pub legless: bool,
    /// Whether the ground it moves on may be higher or lower than 0; no part below 0 is then known to be in the ground.
    pub uneven_ground: bool,
}

/// A rigid part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyPart {
    /// Its name.
    pub name: String,
    /// Mass, kg.
    pub mass: f32,
    /// Moment of inertia about its centre, kg·m².
    pub inertia: f32,
    /// The share of its weight that water bears: 0 on land, above 1 for a part that rises.
    pub buoyancy: f32,
    /// The corners of its shape in its own frame, m: the shape is everything within `radius` of their convex hull.
    pub corners: Vec<[f32; 2]>,
    /// How far the shape reaches beyond its corners, m.
    pub radius: f32,
}

/// A hinge between two parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyHinge {
    /// Index of the part it hangs on.
    pub parent: usize,
    /// Index of the part that hangs on it.
    pub child: usize,
    /// Where it is in the parent's frame, m.
    pub parent_anchor: [f32; 2],
    /// Where it is in the child's frame, m.
    pub child_anchor: [f32; 2],
    /// Angle of the child against the parent when both are as the creature's file draws them, rad.
    pub start_angle: f32,
    /// Smallest and largest angle of the child against the parent, rad, counted from `start_angle`.
    pub limits: [f32; 2],
    /// The motor that the controller moves; `None` for a passive hinge.
    pub motor: Option<BodyMotor>,
}

/// What drives a hinge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyMotor {
    /// rad/s.
    pub top_speed: f32,
    /// N·m.
    pub top_torque: f32,
}

impl Body {
    /// The feet: the last part of each leg.
    pub fn feet(&self) -> impl Iterator<Item = usize> + '_ {
        self.legs.iter().filter_map(|leg| leg.last().copied())
    }

    /// All parts that are no feet, in order; all parts of a body without legs.
    pub fn parts_without_feet(&self) -> Vec<usize> {
        let feet: Vec<usize> = self.feet().collect();
        (0..self.parts.len()).filter(|part| !feet.contains(part)).collect()
    }

    /// The hinges that the controller moves.
    pub fn actuated(&self) -> impl Iterator<Item = &BodyHinge> {
        self.hinges.iter().filter(|hinge| hinge.motor.is_some())
    }

    /// Mass of all parts, kg.
    pub fn mass(&self) -> f32 {
        self.parts.iter().map(|part| part.mass).sum()
    }

    /// What pulls it down as a whole, m/s²: gravity less buoyancy, below 0 for a body that rises.
    pub fn pull(&self) -> f32 {
        let mass = self.mass();
        let unborne: f32 = self.parts.iter().map(BodyPart::unborne_mass).sum();
        if mass > 0.0 { self.gravity * (unborne / mass) } else { self.gravity }
    }

    /// Weight of all parts less what water bears of it, N.
    pub fn weight(&self) -> f64 {
        f64::from(self.mass()) * f64::from(self.pull())
    }
}

impl BodyHinge {
    /// Cosine and sine of the angle of the child against the parent, counted from where both lie parallel.
    pub fn direction(&self, parts: &[crate::PartState]) -> [f32; 2] {
        let (parent, child) = (&parts[self.parent], &parts[self.child]);
        [parent.cos * child.cos + parent.sin * child.sin, parent.cos * child.sin - parent.sin * child.cos]
    }

    /// Its angle, rad, counted from the start pose, above −π and up to π.
    pub fn angle(&self, parts: &[crate::PartState]) -> f32 {
        let [cos, sin] = self.direction(parts);
        let (c, s) = (libm::cosf(self.start_angle), libm::sinf(self.start_angle));
        libm::atan2f(c * sin - s * cos, c * cos + s * sin)
    }
}

impl BodyPart {
    /// Its mass less what water bears of it, kg.
    pub fn unborne_mass(&self) -> f32 {
        self.mass * (1.0 - self.buoyancy)
    }

    /// Its longest side, m: the larger of its extents along the two axes of its own frame.
    pub fn length(&self) -> f32 {
        let extent = |axis: usize| {
            let along = || self.corners.iter().map(|corner| corner[axis]);
            along().fold(f32::NEG_INFINITY, f32::max) - along().fold(f32::INFINITY, f32::min) + 2.0 * self.radius
        };
        if self.corners.is_empty() { 0.0 } else { extent(0).max(extent(1)) }
    }

    /// The height of its lowest point, m, when it is where `state` says.
    pub fn lowest_point(&self, state: &crate::PartState) -> f32 {
        let height = |[x, y]: &[f32; 2]| state.y + state.sin * x + state.cos * y;
        self.corners.iter().map(height).fold(f32::INFINITY, f32::min) - self.radius
    }
}
