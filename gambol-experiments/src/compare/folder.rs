use super::{
    Plan,
    plan::{Job, PlanError, folder_name},
    result::RunResult,
};
use crate::work::is_free;
use gambol_runs::training::TrainError;
use ne_core::archive::{self, ArchiveError, Layout};
use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
};

const PLAN_FORMAT: &str = "gambol comparison";
const RESULT_FORMAT: &str = "gambol comparison result";
const PLAN_VERSION: u32 = 2;
const RESULT_VERSION: u32 = 3;

/// The folder of a comparison.
///
/// | file | what it is |
/// |---|---|
/// | `comparison.json` | the plan: everything needed to repeat it |
/// | `runs/METHOD/SCENARIO/seed-N/` | the folder of a run |
/// | `results/METHOD/SCENARIO/seed-N.json` | what is kept of a run that has ended |
/// | `comparison.html` | to look at |
/// | `medians.csv` | the medians of each strategy on each scenario, and its interquartile mean |
/// | `scores.csv`, `curves.csv` | the raw data |
/// | `settings.csv` | what each method had, and from where |
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ComparisonFolder {
    path: PathBuf,
}

/// Why a comparison cannot be made or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// The plan is not one.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// There is something else in the folder.
    #[error("{} already exists and is no comparison; choose another folder with --out", path.display())]
    Exists {
        /// The folder.
        path: PathBuf,
    },
    /// There is another comparison in the folder.
    #[error(
        "{} holds another comparison ({what}); choose another folder with --out, or repeat the command it was begun with",
        path.display()
    )]
    Other {
        /// The folder.
        path: PathBuf,
        /// What differs first.
        what: &'static str,
    },
    /// It is no folder of a comparison.
    #[error("{} is not the folder of a comparison: it has no comparison.json", path.display())]
    NotOne {
        /// The folder.
        path: PathBuf,
    },
    /// The parts are not of one comparison.
    #[error("{} and {} are not parts of one comparison: they differ in {what}", first.display(), second.display())]
    NotTogether {
        /// A part.
        first: PathBuf,
        /// Another.
        second: PathBuf,
        /// What differs first.
        what: &'static str,
    },
    /// Two parts have another result for the same run.
    #[error("{run}: the results in {} and {} differ, so one was changed or made by another Gambol", first.display(), second.display())]
    Contradiction {
        /// The run.
        run: String,
        /// A part.
        first: PathBuf,
        /// Another.
        second: PathBuf,
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
    /// A result is of a run with other settings.
    #[error("{} is the result of a run with other settings or another budget; remove it to have the run done again", path.display())]
    Settings {
        /// The file.
        path: PathBuf,
    },
    /// Runs are missing.
    #[error("{missing} of {all} runs are missing; the first is: {first}")]
    Incomplete {
        /// How many are missing.
        missing: usize,
        /// How many there are.
        all: usize,
        /// The name of the first.
        first: String,
    },
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
    /// A run could not be done.
    #[error("{run}: {source}")]
    Run {
        /// The run.
        run: String,
        /// What happened.
        source: TrainError,
    },
}

impl ComparisonFolder {
    /// A new folder with this plan, or one with this plan that was begun before.
    ///
    /// # Errors
    /// If there is something else in the folder, or it cannot be written.
    pub fn create(path: &Path, plan: &Plan) -> Result<Self, CompareError> {
        let folder = Self { path: path.into() };
        let is_begun = || folder.plan_file().is_file();
        if !is_begun() {
            let is_free = is_free(path).map_err(|source| ArchiveError::Read { path: path.into(), source })?;
            if !is_free && !is_begun() {
                return Err(CompareError::Exists { path: path.into() });
            }
            archive::make_folder(path).map_err(|source| CompareError::Write { path: path.into(), source })?;
            // Of two that begin at once one waits, where folders can be locked, and finds the plan of the other.
            let alone = File::open(path).ok();
            let _ = alone.as_ref().map(File::lock);
            if !is_begun() {
                archive::write(&folder.plan_file(), PLAN_FORMAT, PLAN_VERSION, plan, Layout::Pretty)?;
            }
        }
        match plan.difference(&folder.plan()?) {
            None => Ok(folder),
            Some(what) => Err(CompareError::Other { path: path.into(), what }),
        }
    }

    /// A folder with a comparison.
    ///
    /// # Errors
    /// If there is none.
    pub fn open(path: &Path) -> Result<Self, CompareError> {
        let folder = Self { path: path.into() };
        if folder.plan_file().is_file() { Ok(folder) } else { Err(CompareError::NotOne { path: path.into() }) }
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The plan.
    ///
    /// # Errors
    /// If it cannot be read or is damaged.
    pub fn plan(&self) -> Result<Plan, CompareError> {
        Ok(archive::read(&self.plan_file(), PLAN_FORMAT, PLAN_VERSION)?)
    }

    /// The result of a run, if it has ended.
    ///
    /// # Errors
    /// If it cannot be read or is damaged.
    pub fn result(&self, job: &Job<'_>) -> Result<Option<RunResult>, CompareError> {
        let path = self.result_file(job);
        if !path.is_file() {
            return Ok(None);
        }
        Ok(Some(Self::check(job, &path, archive::read(&path, RESULT_FORMAT, RESULT_VERSION)?)?))
    }

    /// The result of a run in the text of its file.
    ///
    /// # Errors
    /// If it is damaged, or of another run.
    pub(crate) fn parse_result(&self, job: &Job<'_>, text: &str) -> Result<RunResult, CompareError> {
        let path = self.result_file(job);
        Self::check(job, &path, Self::parse(&path, text)?)
    }

    /// A result in the text of a file, of whichever run.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<RunResult, CompareError> {
        Ok(archive::parse(path, text.as_bytes(), RESULT_FORMAT, RESULT_VERSION)?)
    }

    fn check(job: &Job<'_>, path: &Path, result: RunResult) -> Result<RunResult, CompareError> {
        if (&result.method, &result.scenario, result.seed) != (&job.cell.method, &job.cell.scenario, job.seed) {
            let found = format!("{}, {}, seed {}", result.method, result.scenario, result.seed);
            return Err(CompareError::Misplaced { path: path.into(), found, expected: job.name() });
        }
        match result.settings == job.settings() {
            true => Ok(result),
            false => Err(CompareError::Settings { path: path.into() }),
        }
    }

    /// The results of all runs, in the plan's order.
    ///
    /// # Errors
    /// If a run is missing, or a file cannot be read or is damaged.
    pub fn results(&self, plan: &Plan) -> Result<Vec<RunResult>, CompareError> {
        let (mut results, mut missing) = (Vec::new(), Vec::new());
        for job in plan.jobs() {
            match self.result(&job)? {
                Some(result) => results.push(result),
                None => missing.push(job.name()),
            }
        }
        match missing.first() {
            None => Ok(results),
            Some(first) => {
                Err(CompareError::Incomplete { missing: missing.len(), all: plan.jobs().count(), first: first.clone() })
            }
        }
    }

    /// Path of the page.
    pub fn page(&self) -> PathBuf {
        self.path.join("comparison.html")
    }

    pub(super) fn write_result(&self, job: &Job<'_>, result: &RunResult) -> Result<(), CompareError> {
        let path = self.result_file(job);
        if let Some(parent) = path.parent() {
            archive::make_folder(parent).map_err(|source| CompareError::Write { path: parent.into(), source })?;
        }
        Ok(archive::write(&path, RESULT_FORMAT, RESULT_VERSION, result, Layout::Compact)?)
    }

    pub(super) fn run_folder(&self, job: &Job<'_>) -> PathBuf {
        self.place("runs", job).join(format!("seed-{}", job.seed))
    }

    pub(crate) fn result_file(&self, job: &Job<'_>) -> PathBuf {
        self.place("results", job).join(format!("seed-{}.json", job.seed))
    }

    fn place(&self, folder: &str, job: &Job<'_>) -> PathBuf {
        self.path.join(folder).join(folder_name(&job.cell.method)).join(folder_name(&job.cell.scenario))
    }

    fn plan_file(&self) -> PathBuf {
        self.path.join("comparison.json")
    }
}

impl Plan {
    /// What differs first between two plans.
    pub(super) fn difference(&self, other: &Self) -> Option<&'static str> {
        [
            (self.methods != other.methods, "the strategies"),
            (self.scenarios != other.scenarios, "the creatures or movements"),
            (self.seeds != other.seeds, "the seeds"),
            (self.budget != other.budget, "the budget"),
            (self.cells != other.cells, "the settings of the runs"),
        ]
        .into_iter()
        .find_map(|(differs, what)| differs.then_some(what))
    }
}
