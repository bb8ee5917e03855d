//! What cannot be shown.

use gambol_runs::episode_parts::SetupError;
use ne_core::Failure;

/// Why something cannot be shown, or not be done to what is shown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ArenaError {
    /// The world cannot be built.
    #[error(transparent)]
    World(#[from] SetupError),
    /// There is no creature to show.
    #[error("there is nothing to show yet")]
    Empty,
    /// A net is not made for the body.
    #[error("a net is not made for this body, which has {inputs} inputs and {outputs} outputs")]
    Shape {
        /// What the body has.
        inputs: usize,
        /// What the body has.
        outputs: usize,
    },
    /// The body does not come to rest.
    #[error("the body does not come to rest: {0}")]
    Start(#[from] Failure),
    /// A push that cannot be.
    #[error("a push must be at a part of the body, of at most 50 m/s")]
    Push,
    /// A gravity that cannot be.
    #[error("gravity can be turned by up to half a turn, and be from 0 to 5 times as strong")]
    Gravity,
    /// A box that cannot be.
    #[error("a box must be from 1 cm to 10 m wide and high, and there can be 100")]
    Obstacle,
}
