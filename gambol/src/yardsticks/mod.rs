//! The yardsticks: each strategy on the classic tasks, evaluations to a solution, beside what papers report.
//!
//! Nothing here is about creatures. It answers another question: are the strategies implemented right, and how well do
//! they search where others have published numbers?

mod contestants;
mod published;
mod solve;
mod table;

pub use contestants::{Contestant, contestants};
pub use published::{PUBLISHED, Published};
pub use solve::{Attempt, Measured, measure};
pub use table::render;

use ne_core::SettingError;
use serde::Serialize;
use tasks::{Benchmark, CartPole, CartPoleSettings, DoublePole, DoublePoleSettings, OutputRange, Xor, XorSettings};

/// A classic task with a published table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Yardstick {
    /// Exclusive or.
    Xor,
    /// One pole on a cart.
    OnePole,
    /// Two poles of different length on a cart.
    TwoPoles,
    /// The same without velocities among the inputs, with the damping fitness.
    TwoPolesWithoutVelocities,
}

impl Yardstick {
    /// All of them, the easiest first.
    pub const ALL: [Self; 4] = [Self::Xor, Self::OnePole, Self::TwoPoles, Self::TwoPolesWithoutVelocities];

    /// The name users choose it by.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xor => "xor",
            Self::OnePole => "one-pole",
            Self::TwoPoles => "two-poles",
            Self::TwoPolesWithoutVelocities => "two-poles-without-velocities",
        }
    }

    /// The number of inputs of a controller.
    pub fn inputs(self) -> usize {
        match self {
            Self::Xor => 2,
            Self::OnePole => 4,
            Self::TwoPoles => 6,
            Self::TwoPolesWithoutVelocities => 3,
        }
    }

    /// Evaluations after which an attempt is given up.
    pub fn limit(self) -> u64 {
        match self {
            Self::Xor | Self::OnePole => 100_000,
            Self::TwoPoles | Self::TwoPolesWithoutVelocities => 1_000_000,
        }
    }

    /// The task, for controllers whose outputs have this range.
    fn task(self, output_range: OutputRange) -> Result<Box<dyn Benchmark>, SettingError> {
        let poles = |settings: DoublePoleSettings| DoublePole::new(DoublePoleSettings { output_range, ..settings });
        Ok(match self {
            Self::Xor => Box::new(Xor::new(XorSettings { output_range, ..Default::default() })),
            Self::OnePole => Box::new(CartPole::new(CartPoleSettings { output_range, ..Default::default() })?),
            Self::TwoPoles => Box::new(poles(DoublePoleSettings::with_velocities())?),
            Self::TwoPolesWithoutVelocities => Box::new(poles(DoublePoleSettings::without_velocities())?),
        })
    }
}
