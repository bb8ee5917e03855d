use super::{Experiment, Failed, digest, nth, read, temporary, write};
use crate::{
    compare::{ComparisonFolder, Plan, RunResult, WorkOptions, work, write_outcome},
    folder::parse,
};
use gambol_runs::Registry;
use ne_core::digest::Digest;
use std::path::{Path, PathBuf};

impl Experiment for Plan {
    fn runs(&self) -> usize {
        self.jobs().count()
    }

    fn name(&self, run: usize) -> String {
        self.jobs().nth(run).map(|job| job.name()).unwrap_or_default()
    }

    fn digest(&self) -> Result<Digest, Failed> {
        digest(self)
    }

    fn begin(&self, folder: &Path) -> Result<(), Failed> {
        ComparisonFolder::create(folder, self)?;
        Ok(())
    }

    fn is_done(&self, folder: &Path, run: usize) -> Result<bool, Failed> {
        Ok(ComparisonFolder::open(folder)?.result(&nth(self.jobs(), run)?)?.is_some())
    }

    fn carry_out(&self, run: usize, registry: &Registry) -> Result<String, Failed> {
        let job = nth(self.jobs(), run)?;
        let place = temporary()?;
        let folder = ComparisonFolder::create(place.path(), self)?;
        work(&folder, self, &WorkOptions::of_one(run, self.jobs().count(), registry, &|_| {}))?;
        read(&folder.files.result_file(&job))
    }

    fn place(&self, folder: &Path, run: usize, result: &str) -> Result<PathBuf, Failed> {
        let job = nth(self.jobs(), run)?;
        let folder = ComparisonFolder::open(folder)?;
        folder.files.parse_result::<RunResult>(&job, result)?;
        write(&folder.files.result_file(&job), result)
    }

    fn agree(&self, one: &str, other: &str) -> Result<bool, Failed> {
        let one: RunResult = parse(Path::new("one"), one)?;
        Ok(one.agrees_with(&parse(Path::new("other"), other)?))
    }

    fn conclude(&self, folder: &Path, _: &Registry) -> Result<Vec<PathBuf>, Failed> {
        let folder = ComparisonFolder::open(folder)?;
        write_outcome(&folder)?;
        Ok(outcome(&folder))
    }
}

/// The files that say what came of a comparison.
pub(super) fn outcome(folder: &ComparisonFolder) -> Vec<PathBuf> {
    let data = ["medians.csv", "scores.csv", "curves.csv", "settings.csv"].map(|name| folder.path().join(name));
    [folder.page()].into_iter().chain(data).collect()
}
