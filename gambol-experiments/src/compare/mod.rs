//! Comparing strategies: every strategy on every creature and movement with the same seeds and the same budget, and what
//! can be said of the outcome.
//!
//! A comparison is a folder, as a run is. `comparison.json` is the [`Plan`]: everything needed to repeat it. Each run has
//! its own run folder under `runs`, and once it has ended a small [`RunResult`] under `results`. So a comparison goes on
//! where it was killed, its [`Part`]s can be done by machines that know nothing of each other, and [`merge`] needs nothing
//! but the results.
//!
//! When all runs are there, [`write_outcome`] says what came of it: a page, a [`table`] for the terminal, and raw data.
//!
//! Strategies of other crates take part by their names, once they are in the [registry](gambol_runs::Registry).

pub mod analysis;
mod csv;
mod figures;
mod folder;
mod merge;
mod outcome;
mod page;
mod plan;
mod provenance;
mod result;
pub mod table;
#[cfg(test)]
pub(crate) mod testing;
mod work;

pub use crate::work::{Part, Progress, WorkOptions};
pub use analysis::{Analysis, analyse};
pub use folder::{CompareError, ComparisonFolder};
pub use merge::merge;
pub use outcome::write_outcome;
pub use plan::{Cell, Job, Method, Plan, PlanError, PlanRequest, is_seed_or_budget};
pub use provenance::Provenance;
pub use result::{Point, RunResult};
pub use work::work;
