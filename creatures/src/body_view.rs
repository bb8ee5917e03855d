//! What a body tells about itself.

/// What an engine, or a game, tells about a creature's body at a moment. [`Senses`](crate::Senses) asks only for what
/// the creature's sensors need; a value it may ask for must be given as described, and NaN is passed on as NaN.
///
/// Indices are those of the [`Blueprint`](crate::Blueprint).
pub trait BodyView {
    /// Rotation of the torso relative to the start pose, counter-clockwise, rad, in (-π, π].
    fn torso_rotation(&self) -> f32;
    /// Angular speed of the torso, counter-clockwise, rad/s.
    fn torso_spin(&self) -> f32;
    /// Angle of a hinge, child against parent, relative to the start pose, rad.
    fn joint_angle(&self, hinge: usize) -> f32;
    /// Speed of a hinge, child against parent, rad/s.
    fn joint_speed(&self, hinge: usize) -> f32;
    /// Velocity of the torso's centre in the world, forward and up, m/s.
    fn torso_velocity(&self) -> [f32; 2];
    /// Height of the torso's centre above its settled start height, m.
    fn torso_height(&self) -> f32;
    /// Whether a part touches the ground.
    fn touches_ground(&self, part: usize) -> bool;
    /// How fast the lowest point of a part slides forwards, m/s, while the part touches the ground; 0 while it does not.
    fn slip(&self, part: usize) -> f32;
    /// Distance from the torso's centre to the near edge of the next gap that ends ahead of it, at least 0, and the gap's
    /// width, m; `length` and 0 if it begins further ahead than `length`, or there is none.
    fn next_gap(&self, length: f32) -> [f32; 2];
    /// Distance in m from the torso's centre to the first thing, other than the creature, along a ray at `angle` (rad,
    /// in the world: 0 looks forward, negative down); `length` if nothing is hit within it.
    fn distance_along_ray(&self, angle: f32, length: f32) -> f32;
    /// Time since the clock started, s.
    fn time(&self) -> f32;
    /// Time since the body last landed, s: since a part touched the ground again after none had; since the clock started, if
    /// it has not landed yet. What touches within 0.2 s of a landing belongs to that landing. [`Landings`](crate::Landings)
    /// keeps this account for you.
    fn time_since_landing(&self) -> f32;
    /// The speed the body is told to move at, body lengths/s, backwards below 0. By default 0: it is told nothing.
    fn commanded_speed(&self) -> f32 {
        0.0
    }
    /// Whether the body is told to jump. By default it is not.
    fn is_told_to_jump(&self) -> bool {
        false
    }
    /// Time since the body was last told to jump after it had not been, s; infinity, the default, if it never was.
    fn time_since_press(&self) -> f32 {
        f32::INFINITY
    }
    /// Time since the stride clock began, s: since the body was last told to move after it had been told to stand, or to jump
    /// after it had not been; since the clock started, the default, if it never was.
    fn stride_time(&self) -> f32 {
        self.time()
    }
}
