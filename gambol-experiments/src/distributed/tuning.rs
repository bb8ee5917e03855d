use super::{Experiment, Failed, comparison::outcome, digest};
use crate::{compare::ComparisonFolder, tune::Tuning};
use gambol_runs::Registry;
use ne_core::digest::Digest;
use std::path::{Path, PathBuf};

/// The runs are those of the comparison of the trials; its folder is in that of the tuning.
impl Experiment for Tuning {
    fn runs(&self) -> usize {
        self.plan.runs()
    }

    fn name(&self, run: usize) -> String {
        self.plan.name(run)
    }

    fn digest(&self) -> Result<Digest, Failed> {
        digest(&(&self.trials, &self.plan))
    }

    fn begin(&self, folder: &Path) -> Result<(), Failed> {
        Tuning::begin(self, folder)?;
        self.plan.begin(&Self::comparison(folder))
    }

    fn is_done(&self, folder: &Path, run: usize) -> Result<bool, Failed> {
        self.plan.is_done(&Self::comparison(folder), run)
    }

    fn carry_out(&self, run: usize, registry: &Registry) -> Result<String, Failed> {
        self.plan.carry_out(run, registry)
    }

    fn place(&self, folder: &Path, run: usize, result: &str) -> Result<PathBuf, Failed> {
        self.plan.place(&Self::comparison(folder), run, result)
    }

    fn agree(&self, one: &str, other: &str) -> Result<bool, Failed> {
        self.plan.agree(one, other)
    }

    fn conclude(&self, folder: &Path, _: &Registry) -> Result<Vec<PathBuf>, Failed> {
        let tuned = Tuning::conclude(self, folder)?;
        let compared = outcome(&ComparisonFolder::open(&Self::comparison(folder))?);
        Ok(std::iter::once(tuned.file).chain(compared).collect())
    }
}
