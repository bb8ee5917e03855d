//! Tuning a strategy's numeric settings for comparisons, by random search (Bergstra & Bengio, *Random Search for
//! Hyper-Parameter Optimization*, JMLR 13, 2012): the same number of trials for every strategy, on seeds that are not those
//! compared on.
//!
//! A tuning is a comparison of a strategy with itself: each trial is a method, with settings [drawn](draw) around the
//! defaults, and the first has the defaults. So a tuning stops, goes on and is looked at as a comparison is. The best is the
//! trial with the highest interquartile mean over all scenarios.

mod draw;

pub use draw::draw;

use crate::compare::{Analysis, CompareError, ComparisonFolder, Method, Plan, PlanError, PlanRequest, write_outcome};
use crate::work::is_free;
use gambol_runs::{Registry, config::StrategySettings};
use ne_core::archive;
use serde_json::json;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// How often settings of a trial are drawn, until they can run.
const TRIES: u32 = 200;

/// What is to be tuned, and how.
#[derive(Clone, Debug)]
pub struct TuneRequest {
    /// The strategy, by name or alias.
    pub strategy: String,
    /// How many settings are tried, the defaults among them; at least 1.
    pub trials: u32,
    /// The seed that settings are drawn from.
    pub draw_seed: u64,
    /// Numbers are multiplied with a factor from 1/`spread` to `spread`; above 1.
    pub spread: f64,
    /// Everything else; its methods are filled in.
    pub plan: PlanRequest,
}

/// Why nothing can be tuned.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TuneError {
    /// There is no such strategy.
    #[error("{0}")]
    Unknown(String),
    /// It has no numbers, or none of those drawn can run.
    #[error("{strategy}: no settings that can run were found in {tries} draws")]
    Nothing {
        /// The strategy.
        strategy: String,
        /// How many draws.
        tries: u32,
    },
    /// The trials make no plan.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The comparison failed.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// There is another tuning in the folder.
    #[error("{} holds another tuning: {} differs; choose another folder with --out", folder.display(), file.display())]
    Other {
        /// The folder.
        folder: PathBuf,
        /// The file that differs.
        file: PathBuf,
    },
    /// There is something else in the folder.
    #[error("{} is not empty and holds no tuning; choose another folder with --out", folder.display())]
    Exists {
        /// The folder.
        folder: PathBuf,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}

/// The trials of a tuning, and the comparison of them.
#[derive(Clone, Debug)]
pub struct Tuning {
    /// The settings of each trial; the first has the defaults.
    pub trials: Vec<StrategySettings>,
    /// Each trial as a method.
    pub plan: Plan,
}

impl Tuning {
    /// Writes the settings of the trials to `folder/trials`; those that are there already must have the same bytes.
    ///
    /// # Errors
    /// If another tuning was begun in the folder, or a file cannot be written.
    pub fn begin(&self, folder: &Path) -> Result<(), TuneError> {
        let place = folder.join("trials");
        let read = |source| TuneError::Read { path: folder.into(), source };
        if !place.is_dir() && !is_free(folder).map_err(read)? {
            return Err(TuneError::Exists { folder: folder.into() });
        }
        // All are looked at before one is written.
        let mut missing = Vec::new();
        for (settings, name) in self.trials.iter().zip(&self.plan.methods) {
            let path = place.join(format!("{name}.json"));
            match fs::read_to_string(&path) {
                Ok(known) if known != text(settings) => {
                    return Err(TuneError::Other { folder: folder.into(), file: path });
                }
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => missing.push((path, settings)),
                Err(source) => return Err(TuneError::Read { path, source }),
            }
        }
        archive::make_folder(&place).map_err(|source| TuneError::Write { path: place.clone(), source })?;
        missing.into_iter().try_for_each(|(path, settings)| write_tuned(&path, settings))
    }

    /// The folder of the comparison in that of the tuning.
    pub fn comparison(folder: &Path) -> PathBuf {
        folder.join("comparison")
    }

    /// Writes what came of the comparison, and the best settings to `folder/tuned.json`.
    ///
    /// # Errors
    /// If runs are missing, or a file cannot be written.
    pub fn conclude(&self, folder: &Path) -> Result<Tuned, TuneError> {
        let analysis = write_outcome(&ComparisonFolder::open(&Self::comparison(folder))?)?;
        let (best, file) = (best(&analysis), folder.join("tuned.json"));
        write_tuned(&file, &self.trials[best])?;
        Ok(Tuned { analysis, best, file })
    }
}

/// What came of a tuning.
#[derive(Clone, Debug)]
pub struct Tuned {
    /// The trials, compared.
    pub analysis: Analysis,
    /// The place of the best among them.
    pub best: usize,
    /// Its settings, as a configuration file that `compare` takes.
    pub file: PathBuf,
}

impl TuneRequest {
    /// Draws the trials. The same request gives the same.
    ///
    /// # Errors
    /// If there is no such strategy, or no draw can run.
    pub fn tuning(&self, registry: &Registry) -> Result<Tuning, TuneError> {
        let entry = registry.strategies.find(&self.strategy);
        let entry = entry.ok_or_else(|| TuneError::Unknown(registry.strategies.unknown(&self.strategy)))?;
        let place = tempfile::tempdir();
        let place = place.map_err(|source| TuneError::Write { path: std::env::temp_dir(), source })?;
        let (mut trials, mut methods) = (Vec::new(), Vec::new());
        for trial in 0..self.trials {
            let name = format!("trial-{trial:03}");
            let path = place.path().join(format!("{name}.json"));
            let settings = self.trial(&entry.settings(), trial, registry)?;
            write_tuned(&path, &settings)?;
            trials.push(settings);
            methods.push(Method { name, preset: None, strategy: None, config: Some(path) });
        }
        let plan = PlanRequest { methods, ..self.plan.clone() }.plan(registry)?;
        Ok(Tuning { trials, plan })
    }

    /// The settings of a trial: the first draw that can run.
    fn trial(
        &self,
        defaults: &StrategySettings,
        trial: u32,
        registry: &Registry,
    ) -> Result<StrategySettings, TuneError> {
        let scratch = tempfile::NamedTempFile::new();
        let scratch = scratch.map_err(|source| TuneError::Write { path: std::env::temp_dir(), source })?;
        let method =
            Method { name: "trial".into(), preset: None, strategy: None, config: Some(scratch.path().to_owned()) };
        let plan = PlanRequest { methods: vec![method], ..self.plan.clone() };
        for attempt in 0..TRIES {
            let settings = match trial {
                0 => defaults.clone(),
                _ => draw(defaults, self.spread, self.draw_seed, trial, attempt),
            };
            write_tuned(scratch.path(), &settings)?;
            match plan.plan(registry) {
                Ok(_) => return Ok(settings),
                // Out of range; if the defaults are, then not for what was drawn.
                Err(PlanError::Setup { .. } | PlanError::Request { .. }) if trial > 0 => {}
                Err(error) => return Err(error.into()),
            }
        }
        Err(TuneError::Nothing { strategy: defaults.name().into(), tries: TRIES })
    }
}

/// The place of the best trial: with the highest interquartile mean over all scenarios, of equals the first.
fn best(analysis: &Analysis) -> usize {
    let overall = analysis.primary_standings().overall.as_ref();
    let means = overall.map_or(&[][..], |overall| &overall.methods);
    let better = |best: usize, (place, mean): (usize, f64)| if mean > means[best].value { place } else { best };
    means.iter().map(|mean| mean.value).enumerate().fold(0, better)
}

/// Writes the settings as a configuration file that `compare` takes.
///
/// # Errors
/// If the file cannot be written.
fn write_tuned(path: &Path, settings: &StrategySettings) -> Result<(), TuneError> {
    ne_core::archive::write_whole(path, text(settings).as_bytes())
        .map_err(|source| TuneError::Write { path: path.into(), source })
}

/// Settings as they stand in a file.
pub fn text(settings: &StrategySettings) -> String {
    format!("{:#}\n", json!({ "strategy": settings }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::testing::comparison;
    use ne_core::StopConditions;

    fn request(strategy: &str, trials: u32) -> TuneRequest {
        let plan = PlanRequest {
            creatures: vec!["biped-1".into()],
            movements: vec!["jumping".into()],
            seeds: vec![900_001],
            budget: StopConditions { evaluations: Some(50), ..StopConditions::default() },
            preset: Some("plain".into()),
            ..PlanRequest::default()
        };
        TuneRequest { strategy: strategy.into(), trials, draw_seed: 1, spread: 4.0, plan }
    }

    #[test]
    fn every_strategy_has_trials_that_can_run_the_same_each_time() {
        let registry = Registry::default();
        for entry in registry.strategies.entries() {
            let folder = tempfile::tempdir().expect("a folder");
            let Tuning { trials, plan } = request(entry.name(), 4).tuning(&registry).expect("trials");
            assert_eq!(trials[0], entry.settings(), "the first has the defaults");
            assert!(trials[1..].iter().all(|trial| *trial != trials[0]), "{}", entry.name());
            let had: Vec<_> = plan.cells.iter().map(|cell| cell.config.strategy.clone()).collect();
            assert_eq!(had, trials);
            let again = request(entry.name(), 4).tuning(&registry).expect("the same");
            assert_eq!((&again.trials, &again.plan), (&trials, &plan));
            again.begin(folder.path()).expect("a new folder");
            again.begin(folder.path()).expect("the same folder");
            let other = TuneRequest { draw_seed: 2, ..request(entry.name(), 4) };
            let other = other.tuning(&registry).expect("other trials");
            let error = other.begin(folder.path()).expect_err("another tuning").to_string();
            assert!(error.contains("holds another tuning"), "{error}");
        }
    }

    #[test]
    fn the_best_has_the_highest_mean_over_all_scenarios() {
        let (plan, results) = comparison(&["a", "b", "c"], &["s", "t"], 3, |method, scenario, seed| {
            [[1.0, 9.0, 5.0], [2.0, 7.0, 9.0]][scenario][method] + seed as f64 / 10.0
        });
        assert_eq!(best(&crate::compare::analyse(&plan, &results)), 1);
        assert_eq!(best(&crate::compare::analyse(&plan, &[])), 0, "without scores the defaults");
    }

    #[test]
    fn a_misspelt_strategy_is_corrected() {
        let error = request("naet", 1).tuning(&Registry::default()).expect_err("unknown").to_string();
        assert!(error.contains("did you mean \"neat\"?"), "{error}");
    }
}
