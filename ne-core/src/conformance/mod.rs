//! Checks that plug-in authors run in their own tests: does my implementation keep what its contract promises?
//!
//! A trait says what an implementor owes; most of it no compiler sees. Each check here takes an implementation, tries
//! what usually goes wrong, and returns the first [`Promise`] that was not kept as a [`Violation`], with the numbers:
//!
//! | check | of |
//! |---|---|
//! | `check_genome` | [`Genome`](crate::Genome): expresses the same again, as a clone, and from a file |
//! | `check_phenotype` | [`Phenotype`](crate::Phenotype): shape, reset, every output written, finite |
//! | `check_task` | [`Task`](crate::Task): same score again, from two threads, in any batch; failures are values |
//! | `check_selector` | [`Selector`](crate::Selector): count, range, failures last, better not less often than worse |
//! | `check_strategy` | [`Strategy`](crate::Strategy): resumes to the bit, keeps its size, outlives total failure |
//!
//! The decision behind them: **a check needs no knowledge of what it checks.** What a genome means is what its phenotype
//! does with a fixed battery of inputs; what a task means is what it says of a few phenotypes. So the same check serves
//! every implementation, and every list of promises is data (`genome::PROMISES` and so on) that tests can go through.
//!
//! A check that passes is no proof: it has looked at a few hundred numbers. It does not panic where the implementation
//! does; the panic becomes the violation's text (unless the program is built to abort on panics).
//!
//! ```
//! # #[cfg(feature = "evolution")] {
//! use ne_core::{Seed, Tournament, conformance::check_selector};
//!
//! check_selector(&Tournament { size: 3 }, Seed::of_run(1))?;
//! # }
//! # Ok::<(), ne_core::conformance::Violation>(())
//! ```

mod promise;

#[cfg(feature = "evolution")]
pub mod genome;
#[cfg(feature = "evolution")]
pub mod phenotype;
#[cfg(feature = "evolution")]
mod probe;
#[cfg(feature = "evolution")]
mod puppet;
#[cfg(feature = "evolution")]
pub mod selector;
#[cfg(feature = "evolution")]
mod spy;
#[cfg(feature = "evolution")]
pub mod strategy;
#[cfg(feature = "evolution")]
mod strategy_run;
#[cfg(feature = "evolution")]
pub mod task;

pub use promise::{Promise, Violation};

#[cfg(feature = "evolution")]
pub use {
    genome::check_genome,
    phenotype::check_phenotype,
    puppet::Puppet,
    selector::check_selector,
    strategy::{StrategyOptions, check_strategy},
    task::check_task,
};
