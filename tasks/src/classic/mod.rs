//! The classic tasks of neuroevolution, on which strategies are compared with published figures.
//!
//! | task | what it asks of a strategy |
//! |---|---|
//! | [`Xor`] | a structure with a hidden neuron |
//! | [`CartPole`] | little; a strategy that works at all solves it |
//! | [`DoublePole`] with velocities | weights that fit each other |
//! | [`DoublePole`] without velocities | a memory, and patience with a fitness full of traps |
//!
//! Each is a [`Task`](ne_core::Task), and a [`Benchmark`]: it can tell when it is solved. The decision behind them: **a
//! figure can be compared only if the protocol is the same**, so the protocol is fixed and what the literature varies is
//! a setting: the start angle, the fitness, the constant input, and the [`OutputRange`], since some nets answer from 0
//! to 1 and others from −1 to 1.
//!
//! Carts with any number of poles share their equations: [`Dynamics`].

mod balancing;
mod benchmark;
mod cart_pole;
mod damping;
mod double_pole;
mod dynamics;
mod generalization;
mod output_range;
mod xor;

pub use benchmark::Benchmark;
pub use cart_pole::{CartPole, CartPoleSettings};
pub use double_pole::{DoublePole, DoublePoleSettings, PoleFitness};
pub use dynamics::{Dynamics, Pole, State};
pub use generalization::Generalization;
pub use output_range::OutputRange;
pub use xor::{Xor, XorSettings};

use ne_core::Failure;

/// The one output of a controller, if it is a number: clamping would turn NaN or an infinity into one.
fn number([output]: [f32; 1]) -> Result<f32, Failure> {
    if output.is_finite() { Ok(output) } else { Err(Failure::NonFinite { what: "output 0".into() }) }
}
