//! Many runs, each configuration once.

use super::{
    GaitRun,
    kept::{self, Kept, digest},
};
use crate::work::{Ended, Part, Work, WorkOptions};
use creatures::CreatureError;
use gambol_runs::{
    Registry, config::RunConfig, gait::GaitOfChampionError, robust::RobustnessError, shaping::ShapingError,
};
use ne_core::{StopSignal, archive::ArchiveError, digest::Digest};
use std::{
    collections::BTreeSet,
    io,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// Does runs, several at the same time, and remembers what came of them.
pub struct GaitRuns {
    registry: Registry,
    robust: bool,
    at_once: usize,
    threads: usize,
    kept: Kept,
    signal: StopSignal,
}

/// A run could not be done.
#[derive(Debug, thiserror::Error)]
pub enum GaitsError {
    /// A result cannot be kept, or read again.
    #[error(transparent)]
    Kept(#[from] ArchiveError),
    /// A configuration cannot be told from others.
    #[error("the configuration of a run cannot be written: {0}")]
    Config(#[from] serde_json::Error),
    /// There is no place for a run's folder.
    #[error("no temporary folder for a run: {0}")]
    Temporary(#[source] io::Error),
    /// It cannot be trained.
    #[error(transparent)]
    Train(#[from] ShapingError),
    /// Its gait cannot be judged.
    #[error(transparent)]
    Gait(#[from] GaitOfChampionError),
    /// Its creature cannot be built.
    #[error(transparent)]
    Creature(#[from] CreatureError),
    /// It cannot be perturbed.
    #[error(transparent)]
    Robust(#[from] RobustnessError),
    /// The signal was given.
    #[error("interrupted")]
    Interrupted,
}

impl GaitRuns {
    /// `at_once`: runs at the same time, and `threads` of each; 0 means one for each core.
    pub fn new(registry: &Registry, at_once: usize, threads: usize) -> Self {
        let (registry, signal) = (registry.clone(), StopSignal::default());
        Self { registry, robust: false, at_once, threads, kept: Kept::default(), signal }
    }

    /// Ends runs under way, and begins no other, once the signal is given; what has been kept stays.
    #[must_use]
    pub fn until(self, signal: &StopSignal) -> Self {
        Self { signal: signal.clone(), ..self }
    }

    /// Replays every champion in 100 perturbed worlds.
    #[must_use]
    pub fn robust(self, robust: bool) -> Self {
        Self { robust, ..self }
    }

    /// Keeps every result in a folder, a file each, and does not do again what it has. The folder is made if it is not there;
    /// several processes can share it. The results are those of the program that wrote them: empty it when code has changed
    /// that decides what a run finds.
    ///
    /// # Errors
    /// If the folder cannot be made.
    pub fn kept_in(self, folder: &Path) -> Result<Self, GaitsError> {
        Ok(Self { kept: Kept::open(folder)?, ..self })
    }

    /// The file in which a folder keeps what came of a configuration.
    pub(crate) fn file_of(folder: &Path, config: &RunConfig, robust: bool) -> Result<PathBuf, GaitsError> {
        Ok(kept::file(folder, digest(config, robust)?))
    }

    /// What came of a configuration, in the text of its file.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<GaitRun, GaitsError> {
        Ok(kept::parse(path, text)?)
    }

    /// What came of each configuration, in their order.
    ///
    /// # Errors
    /// The first error; runs under way are finished first.
    pub fn of(&mut self, configs: &[RunConfig]) -> Result<Vec<GaitRun>, GaitsError> {
        let digests = configs.iter().map(|config| digest(config, self.robust)).collect::<Result<Vec<Digest>, _>>()?;
        let mut seen = BTreeSet::new();
        let mut jobs: Vec<(Digest, &RunConfig)> = Vec::new();
        for (&digest, config) in digests.iter().zip(configs) {
            if seen.insert(digest.value()) && self.kept.find(digest)?.is_none() {
                jobs.push((digest, config));
            }
        }
        let options = WorkOptions {
            part: Part::ALL,
            at_once: self.at_once,
            threads: self.threads,
            registry: self.registry.clone(),
            signal: self.signal.clone(),
            on_run: &|_| {},
        };
        let kept = Mutex::new(&mut self.kept);
        Work::new(&options, jobs.len()).side_by_side(
            options.workers(),
            &jobs,
            |(digest, _)| digest.to_string(),
            |(digest, config)| {
                let run = GaitRun::measure(config, options.resources(), self.robust)?;
                kept.lock().unwrap_or_else(PoisonError::into_inner).add(*digest, run.clone())?;
                Ok::<_, GaitsError>(Ended::done(Some(run)))
            },
        )?;
        let mut found = Vec::new();
        for digest in digests {
            found.extend(self.kept.find(digest)?);
        }
        Ok(found)
    }
}
