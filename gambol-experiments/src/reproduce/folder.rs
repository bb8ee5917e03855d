use super::{
    Cell, Job, Plan,
    plan::settings_digest,
    result::{ClockResult, RunResult},
};
use crate::work::is_free;
use gambol_runs::{Registry, run_folder::FolderError, training::TrainError};
use ne_core::{
    StopConditions,
    archive::{self, ArchiveError, Layout},
};
use serde::{Deserialize, Serialize};
use std::{
    fs, io,
    path::{Path, PathBuf},
};

const TERMS_FORMAT: &str = "gambol reproduction";
const RUN_FORMAT: &str = "gambol reproduction result";
const CLOCK_FORMAT: &str = "gambol reproduction timed result";
const VERSION: u32 = 2;

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
#[derive(Clone, Debug)]
pub struct ReproductionFolder {
    path: PathBuf,
    /// What the presets are made of.
    registry: Registry,
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
    /// There is something else in the folder.
    #[error("{} already exists and is no reproduction; choose another folder with --out", path.display())]
    Exists {
        /// The folder.
        path: PathBuf,
    },
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
    /// A result is not of the run its place is for.
    #[error("{} is the result of another run ({found}), not of {expected}", path.display())]
    Misplaced {
        /// The file.
        path: PathBuf,
        /// Which run it is of.
        found: String,
        /// Which run it should be of.
        expected: String,
    },
    /// A run was made with other settings than the preset has now.
    #[error(
        "{} was made with other settings than the preset \"{preset}\" of this Gambol has; choose another folder with --out, \
         or remove it to have the run done again",
        path.display()
    )]
    Settings {
        /// The result or the run folder.
        path: PathBuf,
        /// The preset.
        preset: String,
    },
    /// A run folder that cannot be read.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file cannot be read or written, or is damaged.
    #[error(transparent)]
    File(#[from] ArchiveError),
    /// A folder or a page cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A folder cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The folder.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A creature that should be shipped is not.
    #[error(transparent)]
    Creature(#[from] creatures::UnknownCreature),
    /// A run could not be done.
    #[error("{run}: {source}")]
    Run {
        /// The run.
        run: String,
        /// What happened.
        source: Box<TrainError>,
    },
}

impl ReproduceError {
    pub(super) fn run(run: String, source: TrainError) -> Self {
        Self::Run { run, source: Box::new(source) }
    }
}

impl ReproductionFolder {
    /// A new folder for this plan, or one that was begun before with as many generations. Its creatures, movements, presets
    /// and numbers of runs may be others: what is there stays.
    ///
    /// # Errors
    /// If there is something else in the folder, or it cannot be written.
    pub fn create(path: &Path, plan: &Plan) -> Result<Self, ReproduceError> {
        let folder = Self { path: path.into(), registry: plan.registry.clone() };
        let mut terms = Terms { generations: plan.generations, clock_minutes: plan.clock_minutes.clone() };
        if folder.terms_file().is_file() {
            let found: Terms = archive::read(&folder.terms_file(), TERMS_FORMAT, VERSION)?;
            folder.check(&found, &terms)?;
            if found.clock_minutes.is_some() || terms.clock_minutes.is_none() {
                return Ok(folder);
            }
            terms.generations = found.generations;
        } else if !is_free(path).map_err(|source| ReproduceError::Read { path: path.into(), source })? {
            return Err(ReproduceError::Exists { path: path.into() });
        }
        make(path)?;
        archive::write(&folder.terms_file(), TERMS_FORMAT, VERSION, &terms, Layout::Pretty)?;
        Ok(folder)
    }

    fn check(&self, found: &Terms, asked: &Terms) -> Result<(), ReproduceError> {
        let other = |option, found, asked| Err(ReproduceError::Other { path: self.path.clone(), option, found, asked });
        if found.generations != asked.generations {
            return other("--generations", found.generations.to_string(), asked.generations.to_string());
        }
        match (&found.clock_minutes, &asked.clock_minutes) {
            (Some(found), Some(asked)) if found != asked => {
                let list = |minutes: &[f64]| minutes.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
                other("--clock-minutes", list(found), list(asked))
            }
            _ => Ok(()),
        }
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Path of the page.
    pub fn page(&self) -> PathBuf {
        self.path.join("index.html")
    }

    /// The result of a run, if it has ended.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another run or of other settings.
    pub fn run_result(&self, cell: &Cell, seed: u64) -> Result<Option<RunResult>, ReproduceError> {
        let job = Job::Run { cell: cell.clone(), seed };
        let path = self.result_file(&job);
        if !path.is_file() {
            return Ok(None);
        }
        let result: RunResult = archive::read(&path, RUN_FORMAT, VERSION)?;
        self.check_run(&job, path, &result)?;
        Ok(Some(result))
    }

    /// Checks that a result is of this run, and of today's settings.
    pub(crate) fn check_run(&self, job: &Job, path: PathBuf, result: &RunResult) -> Result<(), ReproduceError> {
        let found = format!("{}, {} {}, seed {}", result.preset, result.creature, result.movement, result.seed);
        self.check_result(job, path, found, &result.settings)
    }

    /// The result of a run in the text of a file.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<RunResult, ReproduceError> {
        Ok(archive::parse(path, text.as_bytes(), RUN_FORMAT, VERSION)?)
    }

    /// The result of a timed run, if it has ended.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another run or of other settings.
    pub fn clock_result(&self, cell: &Cell) -> Result<Option<ClockResult>, ReproduceError> {
        let job = Job::Clock { cell: cell.clone() };
        let path = self.result_file(&job);
        if !path.is_file() {
            return Ok(None);
        }
        let result: ClockResult = archive::read(&path, CLOCK_FORMAT, VERSION)?;
        let found = format!("{}, {} {}, timed", result.preset, result.creature, result.movement);
        self.check_result(&job, path, found, &result.settings)?;
        Ok(Some(result))
    }

    /// Whether a run has ended.
    ///
    /// # Errors
    /// If its result cannot be read.
    pub(crate) fn has(&self, job: &Job) -> Result<bool, ReproduceError> {
        Ok(match job {
            Job::Run { cell, seed } => self.run_result(cell, *seed)?.is_some(),
            Job::Clock { cell } => self.clock_result(cell)?.is_some(),
        })
    }

    /// The seeds of a cell whose runs have ended, rising.
    pub(super) fn seeds(&self, cell: &Cell) -> Result<Vec<u64>, ReproduceError> {
        let path = self.place("results", cell);
        let entries = match fs::read_dir(&path) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(source) => return Err(ReproduceError::Read { path, source }),
        };
        let seed = |name: &str| name.strip_prefix("seed-")?.strip_suffix(".json")?.parse::<u64>().ok();
        let mut seeds: Vec<u64> = entries.flatten().filter_map(|entry| seed(entry.file_name().to_str()?)).collect();
        seeds.sort_unstable();
        Ok(seeds)
    }

    pub(super) fn write_run(&self, job: &Job, result: &RunResult) -> Result<(), ReproduceError> {
        self.write(job, RUN_FORMAT, result)
    }

    pub(super) fn write_clock(&self, job: &Job, result: &ClockResult) -> Result<(), ReproduceError> {
        self.write(job, CLOCK_FORMAT, result)
    }

    fn write(&self, job: &Job, format: &str, result: &impl Serialize) -> Result<(), ReproduceError> {
        make(&self.place("results", job.cell()))?;
        Ok(archive::write(&self.result_file(job), format, VERSION, result, Layout::Compact)?)
    }

    pub(super) fn run_folder(&self, job: &Job) -> PathBuf {
        self.place("runs", job.cell()).join(leaf(job))
    }

    pub(crate) fn result_file(&self, job: &Job) -> PathBuf {
        self.place("results", job.cell()).join(format!("{}.json", leaf(job)))
    }

    fn place(&self, folder: &str, cell: &Cell) -> PathBuf {
        let scenario = format!("{}-{}", cell.scenario.creature, cell.scenario.movement);
        self.path.join(folder).join(&cell.preset.name).join(scenario)
    }

    /// Checks that a result is of this run, and of today's settings.
    fn check_result(&self, job: &Job, path: PathBuf, found: String, settings: &str) -> Result<(), ReproduceError> {
        let (cell, expected) = (job.cell(), job.name());
        if found != expected {
            return Err(ReproduceError::Misplaced { path, found, expected });
        }
        let config = cell.config(0, StopConditions::default(), &self.registry)?;
        if settings_digest(&config) != settings {
            return Err(ReproduceError::Settings { path, preset: cell.preset.name.clone() });
        }
        Ok(())
    }

    fn terms_file(&self) -> PathBuf {
        self.path.join("reproduction.json")
    }
}

fn leaf(job: &Job) -> String {
    match job {
        Job::Run { seed, .. } => format!("seed-{seed}"),
        Job::Clock { .. } => "timed".into(),
    }
}

fn make(path: &Path) -> Result<(), ReproduceError> {
    archive::make_folder(path).map_err(|source| ReproduceError::Write { path: path.into(), source })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Request;

    #[test]
    fn a_result_of_another_versions_preset_is_refused() {
        let place = tempfile::tempdir().expect("a folder");
        let plan = Request { runs: 1, ..Request::default() }.plan(&Registry::default()).expect("a plan");
        let folder = ReproductionFolder::create(place.path(), &plan).expect("a new folder");
        let job = plan.jobs().next().expect("a run");
        let Job::Run { cell, seed } = job.clone() else { panic!("timed runs come last") };
        let config = cell.config(seed, StopConditions::default(), &plan.registry).expect("a shipped creature");
        let mut result = RunResult {
            preset: cell.preset.name.clone(),
            creature: cell.scenario.creature.into(),
            movement: cell.scenario.movement.into(),
            seed,
            settings: settings_digest(&config),
            best: vec![Some(1.0), None],
            mean: vec![Some(0.5), None],
            champion: None,
            threads: 1,
            seconds: 0.25,
        };
        assert!(!folder.has(&job).expect("nothing is wrong"));
        folder.write_run(&job, &result).expect("can be written");
        assert_eq!(folder.run_result(&cell, seed).expect("it is as it was"), Some(result.clone()));
        assert_eq!(folder.seeds(&cell).expect("can be read"), [1]);
        result.settings = "of old".into();
        folder.write_run(&job, &result).expect("can be written");
        let error = folder.run_result(&cell, seed).expect_err("the settings differ").to_string();
        assert!(error.contains("seed-1.json was made with other settings than the preset \"thesis\""), "{error}");
    }
}
