//! Experiments as runs that machines do which share no files: a run is a pure function of the experiment and the run's number,
//! and what comes of it is the text of a file.
//!
//! A machine [does](Experiment::carry_out) a run in a folder that nothing else sees, and gives back the text. Another
//! [places](Experiment::place) it in the folder of the experiment, which is then as if the run had been done there: it can be
//! placed twice, in any order, and an experiment that was broken off goes on with the runs that are missing.

mod comparison;
mod gait_study;
mod reproduction;
#[cfg(test)]
mod tests;
mod tuning;

pub use gait_study::GaitStudy;

use envs_rapier::RAPIER_VERSION;
use gambol_runs::Registry;
use ne_core::digest::Digest;
use serde::Serialize;
use std::{
    error::Error,
    path::{Path, PathBuf},
};

/// Why a run cannot be done or placed; it says which.
pub type Failed = Box<dyn Error + Send + Sync>;

/// An experiment of many runs that know nothing of each other.
pub trait Experiment: Send + Sync {
    /// How many runs there are.
    fn runs(&self) -> usize;

    /// What a run is called; `run`: from 0, below [`runs`](Self::runs).
    fn name(&self, run: usize) -> String;

    /// What decides all results: machines on which it is the same do the same runs.
    ///
    /// # Errors
    /// If the configuration of a run cannot be written.
    fn digest(&self) -> Result<Digest, Failed>;

    /// Makes the folder of the experiment, or goes on with one.
    ///
    /// # Errors
    /// If there is something else in it, or it cannot be written.
    fn begin(&self, folder: &Path) -> Result<(), Failed>;

    /// Whether the result of a run is in the folder.
    ///
    /// # Errors
    /// If it cannot be read, or is not of this run.
    fn is_done(&self, folder: &Path, run: usize) -> Result<bool, Failed>;

    /// Does a run on one thread, in a temporary folder, and gives the text of its result.
    ///
    /// # Errors
    /// If the run cannot be done.
    fn carry_out(&self, run: usize, registry: &Registry) -> Result<String, Failed>;

    /// Writes the result of a run into the folder of the experiment, and says where.
    ///
    /// # Errors
    /// If it is not of this run, or cannot be written.
    fn place(&self, folder: &Path, run: usize, result: &str) -> Result<PathBuf, Failed>;

    /// Whether two results of a run say the same, but for the seconds it took.
    ///
    /// # Errors
    /// If one of them is no result.
    fn agree(&self, one: &str, other: &str) -> Result<bool, Failed>;

    /// Writes what came of the experiment into its folder, and names the files.
    ///
    /// # Errors
    /// If runs are missing that it needs, or a file cannot be written.
    fn conclude(&self, folder: &Path, registry: &Registry) -> Result<Vec<PathBuf>, Failed>;
}

/// The digest of what an experiment says, and of the versions of Gambol and rapier.
fn digest(says: &impl Serialize) -> Result<Digest, Failed> {
    Ok(Digest::of_json(&serde_json::to_value((says, env!("CARGO_PKG_VERSION"), RAPIER_VERSION))?))
}

/// The run of this number.
fn nth<J>(mut jobs: impl Iterator<Item = J>, run: usize) -> Result<J, Failed> {
    jobs.nth(run).ok_or_else(|| format!("there is no run {run}").into())
}

/// A folder for one run.
fn temporary() -> Result<tempfile::TempDir, Failed> {
    tempfile::tempdir().map_err(|error| format!("no temporary folder for a run: {error}").into())
}

/// Writes a result that has been checked.
fn write(path: &Path, text: &str) -> Result<PathBuf, Failed> {
    if let Some(parent) = path.parent() {
        ne_core::archive::make_folder(parent).map_err(|error| format!("cannot write {}: {error}", parent.display()))?;
    }
    ne_core::archive::write_whole(path, text.as_bytes())
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(path.into())
}

/// The text of a result.
fn read(path: &Path) -> Result<String, Failed> {
    std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()).into())
}
