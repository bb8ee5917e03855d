//! What a game tells every frame.

/// Where a part of the body is and how it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct PartState {
    /// Centre, forward, m.
    pub x: f32,
    /// Centre, up, m.
    pub y: f32,
    /// Cosine of its angle against the world, counter-clockwise.
    pub cos: f32,
    /// Sine of that angle.
    pub sin: f32,
    /// Velocity of the centre, forward, m/s.
    pub vx: f32,
    /// Velocity of the centre, up, m/s.
    pub vy: f32,
    /// Angular speed, counter-clockwise, rad/s.
    pub spin: f32,
    /// Whether it touches the ground: 1 or 0. A number, so that C and Rust lay it out alike.
    pub touching: u32,
}

impl PartState {
    /// A part that rests at a place, turned by an angle, rad.
    pub fn at(x: f32, y: f32, angle: f32) -> Self {
        Self { x, y, cos: libm::cosf(angle), sin: libm::sinf(angle), ..Self::default() }
    }

    /// As seen by one that looks the other way.
    pub(crate) fn mirrored(self) -> Self {
        Self { x: -self.x, sin: -self.sin, vx: -self.vx, spin: -self.spin, ..self }
    }

    /// Whether every number of it is finite.
    pub fn is_finite(&self) -> bool {
        [self.x, self.y, self.cos, self.sin, self.vx, self.vy, self.spin].iter().all(|number| number.is_finite())
    }
}

/// What the character is told to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Command {
    /// How fast to go, body lengths/s, the way the character faces; backwards below 0. Values beyond what it was trained
    /// for count as the fastest.
    pub speed: f32,
    /// Whether the button that means jump is held: 1 or 0.
    pub jump: u32,
}

impl Command {
    /// To stand.
    pub const STAND: Self = Self { speed: 0.0, jump: 0 };

    /// To go at this speed, body lengths/s.
    pub fn run(speed: f32) -> Self {
        Self { speed, ..Self::STAND }
    }

    /// The same, and to jump.
    #[must_use]
    pub fn jumping(self) -> Self {
        Self { jump: 1, ..self }
    }
}
