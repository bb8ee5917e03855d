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

    /// The mean power of the motor of a hinge in the last step, W; braking counts as driving.
    ///
    /// Its torque at the end of the step, times its speed there. Solvers tell the torque of the last substep alone. Of two
    /// substeps that is enough; of more, a motor may have had its speed long before. What that leaves out is guessed: where the
    /// mean torque is more than that of the last substep, the difference times the mean of the speeds before and after the step.
    /// In the mean torque the last substep counts by its [share](last_substep_share), and for the rest stands the torque by which
    /// the motor answers the mean of the speeds.
    fn motor_power(&self, hinge: usize) -> f32;

    /// The distance from a point to the ground along a ray at `angle` (rad, in the world), m; `length` if it is
    /// further.
    fn distance_to_ground(&self, from: [f32; 2], angle: f32, length: f32) -> f32;
}

/// The share of a step that the last of so many substeps speaks for in [`Engine::motor_power`]: of one and two all of it.
///
/// Legs of biped-1 that get up to 10 rad/s in a step of 1/50 s without gravity, both hips at 250 N·m: what is booked makes 2.2
/// and 1.1 to 1.5 times the energy that they gain of one and two substeps, and 1.9 to 2.5 times of three to eight (by the last
/// substep alone 0.7 times of three).
pub fn last_substep_share(substeps: u32) -> f32 {
    if substeps > 2 { 1.0 / substeps as f32 } else { 1.0 }
}
