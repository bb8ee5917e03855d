//! Trains creatures and judges their gaits: how many are usable, how soon, how good and how robust they are, and what each piece of
//! the default preset is worth ([`VARIANTS`]).
//!
//! A run is a configuration and what came of it ([`GaitRun`]). [`GaitRuns`] does each configuration once, however many rows of a
//! table ask for it, and keeps the results in a folder if it is given one, so that an ablation of hours goes on where it was stopped.

mod kept;
mod run;
mod runs;
mod table;
mod variants;

pub use run::GaitRun;
pub use runs::{GaitRuns, GaitsError};
pub use table::{ABLATION, SCENARIOS, ablation_row, csv, scenario_row};
pub use variants::{VARIANTS, Variant};
