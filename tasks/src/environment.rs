use crate::{Body, Snapshot};
use ne_core::{Failure, Seed};

/// A body in a world, one step at a time: reset, then (sense, act, step, snapshot) again and again.
///
/// Cloning an environment gives an independent one in the same state: an [`Episode`](crate::Episode) keeps one as a
/// prototype and clones it for each evaluation, so what is costly to build (a settled world) is built once.
///
/// An implementor owes:
/// - after `reset` everything is a function of the seed and the actions: nothing of an earlier episode is left;
/// - `sense`, `act`, `step` and `snapshot` allocate nothing;
/// - a body that explodes or turns NaN is a [`Failure`] from `step`, not a number.
///
/// Check yours with [`check_environment`](crate::conformance::check_environment).
pub trait Environment: Clone + Send + Sync {
    /// How many numbers [`sense`](Self::sense) writes.
    fn inputs(&self) -> usize;

    /// How many numbers [`act`](Self::act) reads.
    fn outputs(&self) -> usize;

    /// Seconds one step takes. Only `reset` may change it: a varied trial can have steps of its own.
    fn time_step(&self) -> f32;

    /// What the body is made of, for movements that want to know; `None`, the default, where there is nothing to tell. Only
    /// `reset` may change it: a varied trial can have masses and gravity of its own.
    fn body(&self) -> Option<&Body> {
        None
    }

    /// Puts the body in its start pose and the clock to zero. Variation between trials comes from the seed.
    ///
    /// # Errors
    /// If the body cannot come to rest in its start pose.
    fn reset(&mut self, seed: Seed) -> Result<(), Failure>;

    /// Writes what the controller is to see, scaled as controllers want it.
    fn sense(&self, inputs: &mut [f32]);

    /// Takes what the controller wants, each from −1 to 1, for the steps to come.
    fn act(&mut self, outputs: &[f32]);

    /// Lets one time step pass.
    ///
    /// # Errors
    /// If a number is no longer finite or the simulation has left its valid range.
    fn step(&mut self) -> Result<(), Failure>;

    /// Where everything is now.
    fn snapshot(&self) -> &Snapshot;
}
