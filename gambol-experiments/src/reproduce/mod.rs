//! Reproducing the thesis Gambol starts from (Gegendorfer 2017): the same creatures, movements and numbers of runs, its
//! algorithm beside ours, and a page with the counterparts of its figures and tables beside the numbers it reports.
//!
//! A reproduction is a folder, as a run is. Each run has its own run folder under `runs`, and once it has ended a small
//! [`RunResult`] under `results`. So a reproduction goes on where it was killed, its [`Part`]s can be done one by one, and
//! the page is written from whatever is there; what was asked for and is missing it names.
//!
//! Each result holds a digest of the settings it was made with: results of another version's presets are refused, not
//! mixed with new ones.
//!
//! What the thesis reports is data: [`thesis::SCENARIOS`].

mod clock;
mod csv;
mod folder;
mod outcome;
mod page;
mod plan;
mod result;
pub mod thesis;
mod work;

pub use crate::work::{Part, Progress, WorkOptions};
pub use folder::{ReproduceError, ReproductionFolder};
pub use outcome::{CellOutcome, Outcome, write_outcome};
pub use plan::{Cell, Job, Plan, Request, RequestError};
pub use result::{ClockResult, Judged, Mark, RunResult};
pub use work::work;
