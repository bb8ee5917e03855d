use crate::Command;

/// Where every part of a body is after a step, and what its motors have done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Seconds since the clock started (after the body has settled).
    pub time: f32,
    /// The parts; the first is the torso. Never empty in a snapshot an environment shows.
    pub parts: Vec<PartState>,
    /// Work of all motors since the clock started, in J: the sum of |torque × relative speed| × time step, so that
    /// braking costs as much as driving. Of a step of more than two substeps a part of it is guessed, since solvers do not tell it.
    pub motor_work: f64,
    /// Energy that pushes from outside have given the body since the clock started, in J; below 0 where they slowed it down.
    pub push_work: f64,
    /// What the body is told to do from this moment on; to stand, where it is told nothing.
    pub command: Command,
}

/// One part of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartState {
    /// Horizontal position of the centre, m; forward is positive.
    pub x: f32,
    /// Vertical position of the centre, m; the ground's surface is near 0, up is positive.
    pub y: f32,
    /// Cosine of the angle against the world, counter-clockwise.
    pub cos: f32,
    /// Sine of that angle.
    pub sin: f32,
    /// Horizontal speed of the centre, m/s.
    pub vx: f32,
    /// Vertical speed of the centre, m/s.
    pub vy: f32,
    /// Angular speed, rad/s, counter-clockwise.
    pub spin: f32,
    /// Whether the part presses on the ground.
    pub touching: bool,
}

impl PartState {
    /// The angle against the world, rad, above −π and up to π. Portable: the same bits everywhere.
    pub fn angle(&self) -> f32 {
        libm::atan2f(self.sin, self.cos)
    }
}

impl Snapshot {
    /// The torso: the first part.
    ///
    /// # Panics
    /// If the snapshot has no parts, which no environment shows.
    pub fn torso(&self) -> &PartState {
        &self.parts[0]
    }

    /// Whether no part touches the ground.
    pub fn aloft(&self) -> bool {
        self.parts.iter().all(|part| !part.touching)
    }
}
