//! The ranges that numbers of a creature file must lie in.
//!
//! They are wide: they catch slips (millimetres for metres, a lost minus sign), not taste. An editor can take the ends
//! of its sliders from here.

/// A closed range of numbers and their unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest number allowed.
    pub min: f32,
    /// The largest number allowed.
    pub max: f32,
    /// Unit of both, such as `m`; empty for plain numbers.
    pub unit: &'static str,
}

impl Bounds {
    const fn new(min: f32, max: f32, unit: &'static str) -> Self {
        Self { min, max, unit }
    }

    /// Whether `value` lies in the range, ends included. Never true for NaN.
    pub fn contains(&self, value: f32) -> bool {
        value >= self.min && value <= self.max
    }
}

/// Widths, heights, lengths and radii of parts.
pub const SIZE: Bounds = Bounds::new(0.005, 50.0, "m");
/// Density of a part, mass per area.
pub const DENSITY: Bounds = Bounds::new(0.1, 10_000.0, "kg/m²");
/// Coulomb friction coefficient.
pub const FRICTION: Bounds = Bounds::new(0.0, 10.0, "");
/// Coordinates of parts and anchors in the start pose.
pub const POSITION: Bounds = Bounds::new(-100.0, 100.0, "m");
/// Angles of parts and decorations.
pub const ANGLE: Bounds = Bounds::new(-360.0, 360.0, "°");
/// Top speed of a motor.
pub const TOP_SPEED: Bounds = Bounds::new(0.01, 100.0, "rad/s");
/// Top torque of a motor.
pub const TOP_TORQUE: Bounds = Bounds::new(0.01, 100_000.0, "N·m");
/// How far a joint's anchor may lie outside the shape of each of its parts.
pub const ANCHOR_DISTANCE: Bounds = Bounds::new(0.0, 1.0, "m");
/// Layers of drawing.
pub const LAYER: Bounds = Bounds::new(-100.0, 100.0, "");
/// Opacity of a drawn part.
pub const OPACITY: Bounds = Bounds::new(0.0, 1.0, "");
/// Corner radii of drawn rectangles.
pub const CORNER_RADIUS: Bounds = Bounds::new(0.0, 50.0, "m");
/// Coordinates of decorations, in their part's own frame.
pub const DECORATION: Bounds = Bounds::new(-50.0, 50.0, "m");
/// Sizes of drawn ellipses and rectangles.
pub const DECORATION_SIZE: Bounds = Bounds::new(0.0001, 50.0, "m");
/// Widths of drawn lines.
pub const LINE_WIDTH: Bounds = Bounds::new(0.0001, 10.0, "m");
/// Angles of rangefinder rays: 0 looks forward (+x), negative down.
pub const RAY_ANGLE: Bounds = Bounds::new(-180.0, 180.0, "°");
/// Length of rangefinder rays.
pub const RAY_LENGTH: Bounds = Bounds::new(0.01, 100.0, "m");
/// Period of a clock.
pub const CLOCK_PERIOD: Bounds = Bounds::new(0.02, 100.0, "s");
/// The fastest a body can be told to move.
pub const COMMANDED_TOP: Bounds = Bounds::new(0.1, 20.0, "body lengths/s");
/// How far the sensor of the next gap looks.
pub const GAP_SIGHT: Bounds = Bounds::new(0.01, 100.0, "m");
/// Difficulty of a terrain.
pub const TERRAIN_DIFFICULTY: Bounds = Bounds::new(0.0, 1.0, "");
/// How far from the start a terrain has obstacles.
pub const TERRAIN_LENGTH: Bounds = Bounds::new(1.0, 1000.0, "m");
/// Level ground before the first obstacle.
pub const TERRAIN_RUN_UP: Bounds = Bounds::new(0.0, 100.0, "m");
/// Share by which spacings differ.
pub const TERRAIN_JITTER: Bounds = Bounds::new(0.0, 0.9, "");
/// Level ground between obstacles.
pub const OBSTACLE_SPACING: Bounds = Bounds::new(0.1, 100.0, "m");
/// Width of gaps.
pub const GAP_WIDTH: Bounds = Bounds::new(0.0, 20.0, "m");
/// Height of hurdles.
pub const HURDLE_HEIGHT: Bounds = Bounds::new(0.0, 5.0, "m");
/// Height of steps.
pub const STAIR_RISE: Bounds = Bounds::new(0.0, 2.0, "m");
/// Depth of steps.
pub const STAIR_TREAD: Bounds = Bounds::new(0.05, 10.0, "m");
/// Steepness of slopes.
pub const SLOPE_DEGREES: Bounds = Bounds::new(0.0, 60.0, "°");
/// Where a drawn obstacle begins, ahead of the creature.
pub const DRAWN_PLACE: Bounds = Bounds::new(0.0, 1000.0, "m");
/// Width of drawn boxes.
pub const DRAWN_WIDTH: Bounds = Bounds::new(0.05, 100.0, "m");
/// Width of drawn slopes.
pub const SLOPE_WIDTH: Bounds = Bounds::new(0.3, 100.0, "m");
/// Height of drawn boxes.
pub const DRAWN_HEIGHT: Bounds = Bounds::new(0.01, 5.0, "m");
/// How much higher the ground is behind a drawn slope.
pub const DRAWN_RISE: Bounds = Bounds::new(-20.0, 20.0, "m");
/// Height of the highest blocks of rough ground.
pub const ROUGH_HEIGHT: Bounds = Bounds::new(0.0, 2.0, "m");
/// Size of the range net inputs are scaled to.
pub const INPUT_RANGE: Bounds = Bounds::new(0.001, 1000.0, "");

/// Most parts of a creature.
pub const MOST_PARTS: usize = 256;
/// Most rays of a rangefinder.
pub const MOST_RAYS: usize = 64;
/// Most kinds of obstacles of a terrain.
pub const MOST_OBSTACLE_KINDS: usize = 16;
/// Most drawn obstacles of a terrain.
pub const MOST_DRAWN_OBSTACLES: usize = 200;
/// Most decorations of a part.
pub const MOST_DECORATIONS: usize = 256;
/// Most points of a decoration.
pub const MOST_POINTS: usize = 256;
/// Most sensors of a creature.
pub const MOST_SENSORS: usize = 64;
/// Most characters of a name or a tag.
pub const LONGEST_NAME: usize = 64;
