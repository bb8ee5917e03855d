use super::{Experiment, Failed, digest, nth, read, temporary, write};
use crate::{
    folder::{PlannedRun, parse},
    reproduce::{Job, Plan, ReproductionFolder, RunResult, WorkOptions, work, write_outcome},
};
use gambol_runs::Registry;
use ne_core::digest::Digest;
use std::path::{Path, PathBuf};

/// The runs that count generations: what timed runs find depends on the machine.
fn untimed(plan: &Plan) -> impl Iterator<Item = Job<'_>> {
    plan.jobs().filter(|job| matches!(job, Job::Run { .. }))
}

impl Experiment for Plan {
    fn runs(&self) -> usize {
        untimed(self).count()
    }

    fn name(&self, run: usize) -> String {
        untimed(self).nth(run).map(|job| job.name()).unwrap_or_default()
    }

    fn digest(&self) -> Result<Digest, Failed> {
        digest(&untimed(self).map(|job| (job.name(), job.settings())).collect::<Vec<_>>())
    }

    fn begin(&self, folder: &Path) -> Result<(), Failed> {
        ReproductionFolder::create(folder, self)?;
        Ok(())
    }

    fn is_done(&self, folder: &Path, run: usize) -> Result<bool, Failed> {
        Ok(ReproductionFolder::create(folder, self)?.has(nth(untimed(self), run)?)?)
    }

    fn carry_out(&self, run: usize, registry: &Registry) -> Result<String, Failed> {
        let job = nth(untimed(self), run)?;
        let place = temporary()?;
        let folder = ReproductionFolder::create(place.path(), self)?;
        work(&folder, self, &WorkOptions::of_one(run, self.jobs().count(), registry, &|_| {}))?;
        read(&folder.files.result_file(&job))
    }

    fn place(&self, folder: &Path, run: usize, result: &str) -> Result<PathBuf, Failed> {
        let job = nth(untimed(self), run)?;
        let folder = ReproductionFolder::create(folder, self)?;
        folder.files.parse_result::<RunResult>(&job, result)?;
        write(&folder.files.result_file(&job), result)
    }

    fn agree(&self, one: &str, other: &str) -> Result<bool, Failed> {
        let one: RunResult = parse(Path::new("one"), one)?;
        Ok(one.agrees_with(&parse(Path::new("other"), other)?))
    }

    fn conclude(&self, folder: &Path, _: &Registry) -> Result<Vec<PathBuf>, Failed> {
        let folder = ReproductionFolder::create(folder, self)?;
        write_outcome(&folder, self)?;
        let data = ["results.csv", "times.csv"].map(|name| folder.path().join(name));
        Ok([folder.page()].into_iter().chain(data).collect())
    }
}
