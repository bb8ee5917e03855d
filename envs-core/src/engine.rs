use crate::{Conditions, EnvironmentError, Ground, PhysicsSettings};
use creatures::Blueprint;
use tasks::PartState;

/// The physics of one creature on its ground: bodies, hinges, motors and contacts, and nothing about tasks or nets.
///
/// [`CreatureEnvironment`](crate::CreatureEnvironment) makes a [`tasks::Environment`] of it. Parts and hinges are told
/// apart by their indices in the [`Blueprint`]. What a [`Blueprint`], checked settings and checked ground can say, an
/// engine need not check again; what it cannot simulate it refuses with [`EnvironmentError::Unsupported`].
///
/// An implementor owes:
/// - what happens is a function of what `new` was given, of the speeds asked for and of the nudges, to the bit, on any
///   thread;
/// - a clone goes on to the bit as the original would, and what happens to one happens to no other;
/// - all but `new` and `clone` allocate nothing that grows with time, and none of them panics, whatever speed is asked
///   for or added, as long as it is a number.
pub trait Engine: Clone + Send + Sync {
    /// Builds ground and creature in its start pose, motors asked for speed 0, not yet settled.
    ///
    /// `settings` are those of the trial: its time step, gravity, iterations, gain, frequencies and damping are in them. The
    /// factors of `conditions` on friction, mass and torque are the engine's to apply. All else of `conditions` is not: turns
    /// come as motor speeds, pushes and the torso's spin as [nudges](Self::nudge).
    ///
    /// # Errors
    /// If the engine cannot simulate this creature or this ground.
    fn new(
        blueprint: &Blueprint,
        settings: &PhysicsSettings,
        ground: &Ground,
        conditions: &Conditions,
    ) -> Result<Self, EnvironmentError>
    where
        Self: Sized;

    /// Asks the motor of a hinge for a speed, rad/s; it holds until the next call. Only asked when the speed changes,
    /// and never for one that is no number.
    fn set_motor_speed(&mut self, hinge: usize, speed: f32);

    /// Adds to the velocity of a part's centre, m/s, and to its spin, rad/s, at once; joints and ground answer in the next
    /// step.
    fn nudge(&mut self, part: usize, velocity: [f32; 2], spin: f32);

    /// Advances by one time step. `false` if a number is no longer finite.
    fn step(&mut self) -> bool;

    /// Writes where every part is and whether it presses on the ground. As many as the creature has parts.
    fn look(&self, parts: &mut [PartState]);

    /// The torque the motor of a hinge gave at the end of the last step, N·m: as solvers have it, on the parent part.
    fn motor_torque(&self, hinge: usize) -> f32;

    /// The distance from a point to the ground along a ray at `angle` (rad, in the world), m; `length` if it is
    /// further.
    fn distance_to_ground(&self, from: [f32; 2], angle: f32, length: f32) -> f32;
}
