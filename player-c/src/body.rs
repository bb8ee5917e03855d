//! What to build in an engine, as C lays it out.

use player::{Character, Hinge, Medium, Outside, Part, Shape};

/// A rigid body in the pose in which the character starts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct GambolPart {
    /// 0: a box, 1: a circle, 2: a capsule, upright in its own frame.
    pub shape: u32,
    /// Box: full width and height. Circle: radius and 0. Capsule: distance between the centres of its half discs, and their
    /// radius. m.
    pub size: [f32; 2],
    /// Centre, forward, m.
    pub x: f32,
    /// Centre, up, m; the ground is at 0.
    pub y: f32,
    /// Turned counter-clockwise, rad.
    pub angle: f32,
    /// Mass per area, kg/m².
    pub density: f32,
    /// Coulomb friction coefficient; that of a contact is the product with the ground's.
    pub friction: f32,
    /// 1 for a foot: the last part of a leg.
    pub foot: u32,
}

/// What holds two parts together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct GambolHinge {
    /// The part it hangs on.
    pub parent: u32,
    /// The part that hangs on it.
    pub child: u32,
    /// The hinge in the parent's own frame, m.
    pub parent_anchor: [f32; 2],
    /// The hinge in the child's own frame, m.
    pub child_anchor: [f32; 2],
    /// Smallest and largest angle of the child against the parent, rad, against that of the start pose.
    pub limits: [f32; 2],
    /// 1 if a motor drives it; 0: it turns freely. A motor that no output moves is asked for speed 0 for ever.
    pub motor: u32,
    /// The fastest the motor turns, rad/s.
    pub top_speed: f32,
    /// The most the motor gives, N·m.
    pub top_torque: f32,
}

/// The world a character has learned in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct GambolWorld {
    /// Time of a step, s.
    pub time_step: f32,
    /// Downwards, m/s².
    pub gravity: f32,
    /// Friction coefficient of the ground.
    pub ground_friction: f32,
    /// Torque of a motor, per speed that it lacks, N·m per rad/s, up to its top torque.
    pub motor_gain: f32,
    /// The length in which speeds are commanded, m.
    pub body_length: f32,
    /// Height of the torso's centre above the ground, at rest, m.
    pub rest_height: f32,
    /// 1 if the parts of the body collide with each other; two that share a hinge never do.
    pub self_collision: u32,
    /// 1 if there is water all around in place of the ground.
    pub water: u32,
    /// Of the water: mass per area, kg/m²; drag coefficients across and along the long side of a part.
    pub water_density: f32,
    /// Drag coefficient across the long side of a part.
    pub water_drag: f32,
    /// Drag coefficient along the long side of a thin part.
    pub water_slip: f32,
}

/// Something that the game itself has to measure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct GambolOutside {
    /// 0: the distance from the torso's centre to the first thing that is not the character, along a ray. 1: the distance from the
    /// torso's centre to the near edge of the next gap ahead, at least 0. 2: the width of that gap, or 0.
    pub kind: u32,
    /// Of a ray, in the world, counter-clockwise, rad; 0 looks towards greater x.
    pub angle: f32,
    /// What a distance is if there is nothing within it, m.
    pub length: f32,
}

impl From<&Part> for GambolPart {
    fn from(part: &Part) -> Self {
        let (shape, size) = match part.shape {
            Shape::Box { width, height } => (0, [width, height]),
            Shape::Circle { radius } => (1, [radius, 0.0]),
            Shape::Capsule { length, radius } => (2, [length, radius]),
        };
        let Part { x, y, angle, density, friction, foot, .. } = *part;
        Self { shape, size, x, y, angle, density, friction, foot: u32::from(foot) }
    }
}

impl From<&Hinge> for GambolHinge {
    fn from(hinge: &Hinge) -> Self {
        let Hinge { parent, child, parent_anchor, child_anchor, limits, motor } = *hinge;
        Self {
            parent: parent.into(),
            child: child.into(),
            parent_anchor,
            child_anchor,
            limits,
            motor: u32::from(motor.is_some()),
            top_speed: motor.map_or(0.0, |motor| motor.top_speed),
            top_torque: motor.map_or(0.0, |motor| motor.top_torque),
        }
    }
}

impl From<&Character> for GambolWorld {
    fn from(character: &Character) -> Self {
        let world = &character.world;
        let (water, [water_density, water_drag, water_slip]) = match world.medium {
            Medium::Air => (0, [0.0; 3]),
            Medium::Water { density, drag, slip } => (1, [density, drag, slip]),
        };
        Self {
            time_step: world.time_step,
            gravity: world.gravity,
            ground_friction: world.ground_friction,
            motor_gain: world.motor_gain,
            body_length: world.body_length,
            rest_height: world.rest_height,
            self_collision: u32::from(world.self_collision),
            water,
            water_density,
            water_drag,
            water_slip,
        }
    }
}

impl From<Outside> for GambolOutside {
    fn from(outside: Outside) -> Self {
        match outside {
            Outside::Ray { angle, length } => Self { kind: 0, angle, length },
            Outside::GapDistance { length } => Self { kind: 1, angle: 0.0, length },
            Outside::GapWidth { length } => Self { kind: 2, angle: 0.0, length },
        }
    }
}
