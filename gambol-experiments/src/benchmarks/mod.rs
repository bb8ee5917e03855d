//! The benchmarks: each strategy on the classic tasks, evaluations to a solution, beside what papers report.
//!
//! Nothing here is about creatures. It answers another question: are the strategies implemented right, and how well do
//! they search where others have published numbers?

mod csv;
mod entrants;
mod published;
mod solve;
mod table;

pub use csv::attempts_csv;
pub use entrants::{Entrant, entrants};
pub use published::{PUBLISHED, Published};
pub use solve::{Attempt, Counting, Measured, measure};
pub use table::render;

use ne_core::SettingError;
use serde::Serialize;
use tasks::{Benchmark, CartPole, CartPoleSettings, DoublePole, DoublePoleSettings, OutputRange, Xor, XorSettings};

/// A classic task with a published table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BenchmarkTask {
    /// Exclusive or.
    Xor,
    /// One pole on a cart.
    OnePole,
    /// Two poles of different length on a cart.
    TwoPoles,
    /// The same without velocities among the inputs, with the damping fitness.
    TwoPolesWithoutVelocities,
    /// The same, and a solution has to hold the poles from 200 of 625 other starts too. So Stanley & Miikkulainen, 2002, had it, by the paper from 1° in place of 4°.
    GeneralTwoPoles,
}

impl BenchmarkTask {
    /// All of them, the easiest first.
    pub const ALL: [Self; 5] =
        [Self::Xor, Self::OnePole, Self::TwoPoles, Self::TwoPolesWithoutVelocities, Self::GeneralTwoPoles];

    /// The name users choose it by.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xor => "xor",
            Self::OnePole => "one-pole",
            Self::TwoPoles => "two-poles",
            Self::TwoPolesWithoutVelocities => "two-poles-without-velocities",
            Self::GeneralTwoPoles => "general-two-poles",
        }
    }

    /// The number of inputs of a controller, a constant one not counted.
    pub fn inputs(self) -> usize {
        match self {
            Self::Xor => 2,
            Self::OnePole => 4,
            Self::TwoPoles => 6,
            Self::TwoPolesWithoutVelocities | Self::GeneralTwoPoles => 3,
        }
    }

    /// Whether a candidate has to pass a test that is not an evaluation and is not counted as one: 100,000 decisions, other
    /// starts.
    pub fn has_uncounted_test(self) -> bool {
        matches!(self, Self::TwoPolesWithoutVelocities | Self::GeneralTwoPoles)
    }

    /// Evaluations after which an attempt is given up.
    pub fn limit(self) -> u64 {
        match self {
            Self::Xor | Self::OnePole => 100_000,
            Self::TwoPoles | Self::TwoPolesWithoutVelocities | Self::GeneralTwoPoles => 200_000,
        }
    }

    /// The task, with the inputs and outputs a entrant wants.
    fn task(self, output_range: OutputRange, bias_input: bool) -> Result<Box<dyn Benchmark>, SettingError> {
        Ok(match self {
            Self::Xor => Box::new(Xor::new(XorSettings { output_range, bias_input })),
            Self::OnePole => {
                Box::new(CartPole::new(CartPoleSettings { output_range, bias_input, ..Default::default() })?)
            }
            _ => Box::new(self.poles(output_range, bias_input)?),
        })
    }

    /// Two poles, as [`task`](Self::task) has them.
    fn poles(self, output_range: OutputRange, bias_input: bool) -> Result<DoublePole, SettingError> {
        let settings = match self {
            Self::TwoPolesWithoutVelocities | Self::GeneralTwoPoles => DoublePoleSettings::without_velocities(),
            _ => DoublePoleSettings::with_velocities(),
        };
        DoublePole::new(DoublePoleSettings { output_range, bias_input, ..settings })
    }
}
