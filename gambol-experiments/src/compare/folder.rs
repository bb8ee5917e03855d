use super::{
    Plan,
    plan::{Job, PlanError, folder_name},
    result::RunResult,
};
use crate::folder::{ExperimentError, ExperimentFolder, KeptResult, Kind, PlannedRun};
use gambol_runs::config::RunConfig;
use std::path::{Path, PathBuf};

const COMPARISON: Kind = Kind { name: "comparison", version: 2 };

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
    pub(crate) files: ExperimentFolder,
}

/// Why a comparison cannot be made or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// The plan is not one.
    #[error(transparent)]
    Plan(#[from] PlanError),
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
    /// A run, a result or the folder.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
}

impl ComparisonFolder {
    /// A new folder with this plan, or one with this plan that was begun before.
    ///
    /// # Errors
    /// If there is something else in the folder, or it cannot be written.
    pub fn create(path: &Path, plan: &Plan) -> Result<Self, CompareError> {
        let (files, found) = ExperimentFolder::begin(path, COMPARISON, plan)?;
        match plan.difference(&found) {
            None => Ok(Self { files }),
            Some(what) => Err(CompareError::Other { path: path.into(), what }),
        }
    }

    /// A folder with a comparison.
    ///
    /// # Errors
    /// If there is none.
    pub fn open(path: &Path) -> Result<Self, CompareError> {
        Ok(Self { files: ExperimentFolder::open(path, COMPARISON)? })
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        self.files.path()
    }

    /// The plan.
    ///
    /// # Errors
    /// If it cannot be read or is damaged.
    pub fn plan(&self) -> Result<Plan, CompareError> {
        Ok(self.files.plan()?)
    }

    /// The result of a run, if it has ended.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another run or of other settings.
    pub fn result(&self, job: &Job<'_>) -> Result<Option<RunResult>, CompareError> {
        Ok(self.files.result(job)?)
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
        self.path().join("comparison.html")
    }
}

impl PlannedRun for Job<'_> {
    fn name(&self) -> String {
        Job::name(self)
    }

    fn place(&self) -> PathBuf {
        let [method, scenario] = [&self.cell.method, &self.cell.scenario].map(|name| folder_name(name));
        [method, scenario, format!("seed-{}", self.seed)].iter().collect()
    }

    fn config(&self) -> RunConfig {
        Job::config(self)
    }
}

impl KeptResult for RunResult {
    const FORMAT: &'static str = "gambol comparison result";
    const VERSION: u32 = 3;

    fn run(&self) -> String {
        format!("{}, {}, seed {}", self.method, self.scenario, self.seed)
    }

    fn settings(&self) -> &str {
        &self.settings
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
