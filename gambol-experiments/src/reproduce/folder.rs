use super::{
    Cell, Job, Plan,
    result::{ClockResult, RunResult},
};
use crate::folder::{ExperimentError, ExperimentFolder, KeptResult, Kind, PlannedRun};
use gambol_runs::config::RunConfig;
use ne_core::StopConditions;
use serde::{Deserialize, Serialize};
use std::{
    fs, io,
    path::{Path, PathBuf},
};

const REPRODUCTION: Kind = Kind { name: "reproduction", version: 2 };

/// The folder of a reproduction.
///
/// | file | what it is |
/// |---|---|
/// | `reproduction.json` | what all its runs have in common: the number of generations, the minutes of timed runs |
/// | `runs/PRESET/CREATURE-MOVEMENT/seed-N/`, `.../timed/` | the folder of a run |
/// | `results/PRESET/CREATURE-MOVEMENT/seed-N.json`, `.../timed.json` | what is kept of a run that has ended |
/// | `index.html` | to look at |
/// | `results.csv` | a row for each run: the same whenever and however it was done |
/// | `times.csv`, `timed.csv` | seconds of each run; the timed runs |
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReproductionFolder {
    pub(crate) files: ExperimentFolder,
}

/// What all runs of a folder have in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Terms {
    generations: u64,
    /// Once there are timed runs.
    clock_minutes: Option<Vec<f64>>,
}

/// Why a reproduction cannot be made or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReproduceError {
    /// There is a reproduction with other runs in the folder.
    #[error(
        "{} was begun with {option} {found}, not {asked}; choose another folder with --out, or say {option} {found}",
        path.display()
    )]
    Other {
        /// The folder.
        path: PathBuf,
        /// The option that differs.
        option: &'static str,
        /// What the folder has.
        found: String,
        /// What was asked for.
        asked: String,
    },
    /// A creature that should be shipped is not.
    #[error(transparent)]
    Creature(#[from] creatures::UnknownCreature),
    /// A run, a result or the folder.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
}

impl ReproductionFolder {
    /// A new folder for this plan, or one that was begun before with as many generations. Its creatures, movements, presets
    /// and numbers of runs may be others: what is there stays.
    ///
    /// # Errors
    /// If there is something else in the folder, or it cannot be written.
    pub fn create(path: &Path, plan: &Plan) -> Result<Self, ReproduceError> {
        let asked = Terms { generations: plan.generations, clock_minutes: plan.clock_minutes.clone() };
        let (files, found) = ExperimentFolder::begin(path, REPRODUCTION, &asked)?;
        let other = |option, found, asked| Err(ReproduceError::Other { path: path.into(), option, found, asked });
        if found.generations != asked.generations {
            return other("--generations", found.generations.to_string(), asked.generations.to_string());
        }
        match (&found.clock_minutes, &asked.clock_minutes) {
            (Some(found), Some(asked)) if found != asked => {
                let list = |minutes: &[f64]| minutes.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
                return other("--clock-minutes", list(found), list(asked));
            }
            (None, Some(_)) => files.write_plan(&asked)?,
            _ => {}
        }
        Ok(Self { files })
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        self.files.path()
    }

    /// Path of the page.
    pub fn page(&self) -> PathBuf {
        self.path().join("index.html")
    }

    /// The result of a run, if it has ended.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another run or of other settings.
    pub fn run_result(&self, cell: &Cell, seed: u64) -> Result<Option<RunResult>, ReproduceError> {
        Ok(self.files.result(&Job::Run { cell, seed })?)
    }

    /// The result of a timed run, if it has ended.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another run or of other settings.
    pub fn clock_result(&self, cell: &Cell) -> Result<Option<ClockResult>, ReproduceError> {
        Ok(self.files.result(&Job::Clock { cell })?)
    }

    /// Whether a run has ended.
    ///
    /// # Errors
    /// If its result cannot be read.
    pub(crate) fn has(&self, job: Job<'_>) -> Result<bool, ReproduceError> {
        Ok(match job {
            Job::Run { cell, seed } => self.run_result(cell, seed)?.is_some(),
            Job::Clock { cell } => self.clock_result(cell)?.is_some(),
        })
    }

    /// The seeds of a cell whose runs have ended, rising.
    pub(super) fn seeds(&self, cell: &Cell) -> Result<Vec<u64>, ReproduceError> {
        let path = self.path().join("results").join(cell.place());
        let entries = match fs::read_dir(&path) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(source) => return Err(ExperimentError::Read { path, source }.into()),
        };
        let seed = |name: &str| name.strip_prefix("seed-")?.strip_suffix(".json")?.parse::<u64>().ok();
        let mut seeds: Vec<u64> = entries.flatten().filter_map(|entry| seed(entry.file_name().to_str()?)).collect();
        seeds.sort_unstable();
        Ok(seeds)
    }
}

impl Cell {
    /// Where the files of its runs are.
    fn place(&self) -> PathBuf {
        let scenario = format!("{}-{}", self.scenario.creature, self.scenario.movement);
        [self.preset.name.clone(), scenario].iter().collect()
    }
}

impl PlannedRun for Job<'_> {
    fn name(&self) -> String {
        Job::name(self)
    }

    fn place(&self) -> PathBuf {
        self.cell().place().join(match self {
            Self::Run { seed, .. } => format!("seed-{seed}"),
            Self::Clock { .. } => "timed".into(),
        })
    }

    fn config(&self) -> RunConfig {
        match *self {
            Self::Run { cell, seed } => RunConfig { seed, ..cell.config.clone() },
            // Minutes depend on how long each of its moments took.
            Self::Clock { cell } => RunConfig { seed: 1, stop: StopConditions::default(), ..cell.config.clone() },
        }
    }
}

impl KeptResult for RunResult {
    const FORMAT: &'static str = "gambol reproduction result";
    const VERSION: u32 = 3;

    fn run(&self) -> String {
        format!("{}, {} {}, seed {}", self.preset, self.creature, self.movement, self.seed)
    }

    fn settings(&self) -> &str {
        &self.settings
    }
}

impl KeptResult for ClockResult {
    const FORMAT: &'static str = "gambol reproduction timed result";
    const VERSION: u32 = 3;

    fn run(&self) -> String {
        format!("{}, {} {}, timed", self.preset, self.creature, self.movement)
    }

    fn settings(&self) -> &str {
        &self.settings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Request;
    use gambol_runs::Registry;

    #[test]
    fn a_result_of_another_versions_preset_is_refused() {
        let place = tempfile::tempdir().expect("a folder");
        let plan = Request { runs: 1, ..Request::default() }.plan(&Registry::default()).expect("a plan");
        let folder = ReproductionFolder::create(place.path(), &plan).expect("a new folder");
        let job = plan.jobs().next().expect("a run");
        let Job::Run { cell, seed } = job else { panic!("timed runs come last") };
        let mut result = RunResult {
            preset: cell.preset.name.clone(),
            creature: cell.scenario.creature.into(),
            movement: cell.scenario.movement.into(),
            seed,
            settings: job.settings(),
            best: vec![Some(1.0), None],
            mean: vec![Some(0.5), None],
            champion: None,
            threads: 1,
            seconds: 0.25,
        };
        assert!(!folder.has(job).expect("nothing is wrong"));
        folder.files.write_result(&job, &result).expect("can be written");
        assert_eq!(folder.run_result(cell, seed).expect("it is as it was"), Some(result.clone()));
        assert_eq!(folder.seeds(cell).expect("can be read"), [1]);
        result.settings = "of old".into();
        folder.files.write_result(&job, &result).expect("can be written");
        let error = folder.run_result(cell, seed).expect_err("the settings differ").to_string();
        assert!(error.contains("seed-1.json is the result of a run with other settings"), "{error}");
    }
}
