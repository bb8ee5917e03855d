//! The folder of an experiment: a file with its plan, and for each run a run folder and a file with what is kept of it.

use crate::work::{WorkOptions, is_free};
use gambol_runs::{config::RunConfig, run_folder::RunFolder, training::TrainError};
use ne_core::{
    archive::{self, ArchiveError, Layout},
    digest::Digest,
};
use serde::{Serialize, de::DeserializeOwned};
use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
};

/// What the folders of a kind of experiment have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Kind {
    /// What it is called: its plan is `NAME.json`, a file of the format `gambol NAME`.
    pub(crate) name: &'static str,
    /// The version of the plan's format.
    pub(crate) version: u32,
}

/// A run that an experiment plans.
pub(crate) trait PlannedRun {
    /// What it is called in messages.
    fn name(&self) -> String;

    /// Where its files are, in `runs` and in `results`.
    fn place(&self) -> PathBuf;

    /// Its configuration.
    fn config(&self) -> RunConfig;

    /// The digest of its configuration.
    fn settings(&self) -> String {
        // Plain data: serialising cannot fail; were it to, all settings would be alike.
        Digest::of_json(&serde_json::to_value(self.config()).unwrap_or_default()).to_string()
    }
}

/// What an experiment keeps of a run that has ended.
pub(crate) trait KeptResult: Serialize + DeserializeOwned {
    /// The format of its file.
    const FORMAT: &'static str;
    /// The version of the format.
    const VERSION: u32;

    /// The [name](PlannedRun::name) of the run it is of.
    fn run(&self) -> String;

    /// The [digest](PlannedRun::settings) of that run's configuration.
    fn settings(&self) -> &str;
}

/// The folder of an experiment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ExperimentFolder {
    path: PathBuf,
    kind: Kind,
}

/// Why an experiment cannot be begun or go on in a folder.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// There is something else in the folder.
    #[error("{} already exists and is no {kind}; choose another folder with --out", path.display())]
    Exists {
        /// The folder.
        path: PathBuf,
        /// What was looked for.
        kind: &'static str,
    },
    /// It is no folder of such an experiment.
    #[error("{} is not the folder of a {kind}: it has no {kind}.json", path.display())]
    NotOne {
        /// The folder.
        path: PathBuf,
        /// What was looked for.
        kind: &'static str,
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
    #[error(
        "{} is the result of a run with other settings or another budget than {run} has in this Gambol; remove it to have the \
         run done again",
        path.display()
    )]
    Settings {
        /// The file.
        path: PathBuf,
        /// The run.
        run: String,
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
    /// A folder cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The folder.
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
        source: Box<TrainError>,
    },
}

impl ExperimentError {
    /// A run that could not be done.
    pub(crate) fn run(run: &impl PlannedRun, source: impl Into<TrainError>) -> Self {
        Self::Run { run: run.name(), source: Box::new(source.into()) }
    }
}

impl ExperimentFolder {
    /// A new folder with this plan, or one that was begun before; and the plan in it.
    ///
    /// # Errors
    /// If there is something else in the folder, or it cannot be written.
    pub(crate) fn begin<P: Serialize + DeserializeOwned>(
        path: &Path,
        kind: Kind,
        plan: &P,
    ) -> Result<(Self, P), ExperimentError> {
        let folder = Self { path: path.into(), kind };
        let is_begun = || folder.plan_file().is_file();
        if !is_begun() {
            let is_free = is_free(path).map_err(|source| ExperimentError::Read { path: path.into(), source })?;
            if !is_free && !is_begun() {
                return Err(ExperimentError::Exists { path: path.into(), kind: kind.name });
            }
            make(path)?;
            // Of two that begin at once one waits, where folders can be locked, and finds the plan of the other.
            let alone = File::open(path).ok();
            let _ = alone.as_ref().map(File::lock);
            if !is_begun() {
                folder.write_plan(plan)?;
            }
        }
        let found = folder.plan()?;
        Ok((folder, found))
    }

    /// A folder with such an experiment.
    ///
    /// # Errors
    /// If there is none.
    pub(crate) fn open(path: &Path, kind: Kind) -> Result<Self, ExperimentError> {
        let folder = Self { path: path.into(), kind };
        match folder.plan_file().is_file() {
            true => Ok(folder),
            false => Err(ExperimentError::NotOne { path: path.into(), kind: kind.name }),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The plan.
    ///
    /// # Errors
    /// If it cannot be read or is damaged.
    pub(crate) fn plan<P: DeserializeOwned>(&self) -> Result<P, ExperimentError> {
        Ok(archive::read(&self.plan_file(), &self.plan_format(), self.kind.version)?)
    }

    pub(crate) fn write_plan(&self, plan: &impl Serialize) -> Result<(), ExperimentError> {
        Ok(archive::write(&self.plan_file(), &self.plan_format(), self.kind.version, plan, Layout::Pretty)?)
    }

    /// The result of a run, if it has ended.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another run or of other settings.
    pub(crate) fn result<R: KeptResult>(&self, run: &impl PlannedRun) -> Result<Option<R>, ExperimentError> {
        let path = self.result_file(run);
        if !path.is_file() {
            return Ok(None);
        }
        let result = archive::read(&path, R::FORMAT, R::VERSION)?;
        check(run, &path, result).map(Some)
    }

    /// The result of a run in the text of its file.
    ///
    /// # Errors
    /// If it is damaged, or is of another run or of other settings.
    pub(crate) fn parse_result<R: KeptResult>(&self, run: &impl PlannedRun, text: &str) -> Result<R, ExperimentError> {
        let path = self.result_file(run);
        check(run, &path, parse(&path, text)?)
    }

    pub(crate) fn write_result<R: KeptResult>(&self, run: &impl PlannedRun, result: &R) -> Result<(), ExperimentError> {
        let path = self.result_file(run);
        make(path.parent().unwrap_or(&self.path))?;
        Ok(archive::write(&path, R::FORMAT, R::VERSION, result, Layout::Compact)?)
    }

    /// The result of a run: the one that is there, or that of the run, which is done, or gone on with, and then read. `None`: it was
    /// interrupted, or another process is at work on it.
    ///
    /// # Errors
    /// If the run cannot be done, or a file cannot be read or written.
    pub(crate) fn result_or_do<R: KeptResult, B>(
        &self,
        run: &impl PlannedRun,
        options: &WorkOptions<'_, B>,
        read: impl FnOnce(&RunFolder) -> Result<R, TrainError>,
    ) -> Result<Option<R>, ExperimentError> {
        if let Some(result) = self.result(run)? {
            return Ok(Some(result));
        }
        let failed = |source| ExperimentError::run(run, source);
        let ended = options.run(&run.config(), &self.run_folder(run)).map_err(failed)?;
        let Some(ended) = ended else { return Ok(None) };
        let result = read(&ended).map_err(failed)?;
        self.write_result(run, &result)?;
        Ok(Some(result))
    }

    /// The folder in which a run is done.
    pub(crate) fn run_folder(&self, run: &impl PlannedRun) -> PathBuf {
        self.path.join("runs").join(run.place())
    }

    /// The file with the result of a run.
    pub(crate) fn result_file(&self, run: &impl PlannedRun) -> PathBuf {
        let mut path = self.path.join("results").join(run.place()).into_os_string();
        path.push(".json");
        path.into()
    }

    /// Writes what came of the experiment: the name of each file, and its text.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub(crate) fn write_files(&self, files: &[(&str, String)]) -> Result<(), ExperimentError> {
        files.iter().try_for_each(|(name, text)| {
            let path = self.path.join(name);
            archive::write_whole(&path, text.as_bytes()).map_err(|source| ExperimentError::Write { path, source })
        })
    }

    fn plan_file(&self) -> PathBuf {
        self.path.join(format!("{}.json", self.kind.name))
    }

    fn plan_format(&self) -> String {
        format!("gambol {}", self.kind.name)
    }
}

/// A result in the text of a file, of whichever run.
///
/// # Errors
/// If it is damaged.
pub(crate) fn parse<R: KeptResult>(path: &Path, text: &str) -> Result<R, ExperimentError> {
    Ok(archive::parse(path, text.as_bytes(), R::FORMAT, R::VERSION)?)
}

/// Makes a folder, if it is not there.
pub(crate) fn make(path: &Path) -> Result<(), ExperimentError> {
    archive::make_folder(path).map_err(|source| ExperimentError::Write { path: path.into(), source })
}

/// The result, if it is of this run.
fn check<R: KeptResult>(run: &impl PlannedRun, path: &Path, result: R) -> Result<R, ExperimentError> {
    let (found, expected) = (result.run(), run.name());
    if found != expected {
        return Err(ExperimentError::Misplaced { path: path.into(), found, expected });
    }
    match result.settings() == run.settings() {
        true => Ok(result),
        false => Err(ExperimentError::Settings { path: path.into(), run: expected }),
    }
}
