//! Many runs, each configuration once.

use super::{
    GaitRun,
    kept::{Kept, KeptError},
};
use crate::work::{Ended, Part, Work, WorkOptions};
use creatures::CreatureError;
use gambol_runs::{
    Registry, config::RunConfig, gait::GaitOfChampionError, robust::RobustnessError, training::TrainError,
};
use ne_core::digest::Digest;
use std::{collections::BTreeSet, io, path::Path, sync::Mutex};

/// Does runs, several at the same time, and remembers what came of them.
pub struct GaitRuns {
    registry: Registry,
    robust: bool,
    at_once: usize,
    threads: usize,
    kept: Kept,
}

/// A run could not be done.
#[derive(Debug, thiserror::Error)]
pub enum GaitsError {
    /// The file of results.
    #[error(transparent)]
    Kept(#[from] KeptError),
    /// There is no place for a run's folder.
    #[error("no temporary folder for a run: {0}")]
    Temporary(#[source] io::Error),
    /// It cannot be trained.
    #[error(transparent)]
    Train(#[from] TrainError),
    /// Its gait cannot be judged.
    #[error(transparent)]
    Gait(#[from] GaitOfChampionError),
    /// Its creature cannot be built.
    #[error(transparent)]
    Creature(#[from] CreatureError),
    /// It cannot be perturbed.
    #[error(transparent)]
    Robust(#[from] RobustnessError),
}

impl GaitRuns {
    /// `at_once`: runs at the same time, and `threads` of each; 0 means one for each core.
    pub fn new(registry: &Registry, at_once: usize, threads: usize) -> Self {
        Self { registry: registry.clone(), robust: false, at_once, threads, kept: Kept::default() }
    }

    /// Replays every champion in 100 perturbed worlds.
    #[must_use]
    pub fn robust(self, robust: bool) -> Self {
        Self { robust, ..self }
    }

    /// Keeps every result in a file, a line of JSON each, and does not do again what it has. It is made if it is not there.
    /// The results are those of the program that wrote them: another version may find others.
    ///
    /// # Errors
    /// If the file cannot be read or written, holds something else, or another process writes it.
    pub fn kept_in(self, path: &Path) -> Result<Self, GaitsError> {
        Ok(Self { kept: Kept::open(path)?, ..self })
    }

    /// What came of each configuration, in their order. `on_run` is called after each run that had to be done.
    ///
    /// # Errors
    /// The first error; runs under way are finished first.
    pub fn of(
        &mut self,
        configs: &[RunConfig],
        on_run: &(dyn Fn(&GaitRun) + Sync),
    ) -> Result<Vec<GaitRun>, GaitsError> {
        let digests: Vec<Digest> = configs.iter().map(|config| digest(config, self.robust)).collect();
        let mut seen = BTreeSet::new();
        let jobs: Vec<(Digest, &RunConfig)> = digests
            .iter()
            .copied()
            .zip(configs)
            .filter(|(digest, _)| self.kept.get(*digest).is_none() && seen.insert(digest.value()))
            .collect();
        let options = WorkOptions {
            part: Part::ALL,
            at_once: self.at_once,
            threads: self.threads,
            registry: self.registry.clone(),
            signal: Default::default(),
            on_run: &|progress| {
                if let Some(run) = &progress.best {
                    on_run(run);
                }
            },
        };
        let kept = Mutex::new(&mut self.kept);
        Work::new(&options, jobs.len()).side_by_side(
            options.workers(),
            &jobs,
            |(digest, _)| digest.to_string(),
            |(digest, config)| {
                let run = GaitRun::measure(config, &options.registry, options.threads, self.robust)?;
                // No panic leaves the lock poisoned: the results are written whole or not at all.
                kept.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).add(*digest, run.clone())?;
                Ok::<_, GaitsError>(Ended::Done(Some(run)))
            },
        )?;
        Ok(digests.iter().filter_map(|digest| self.kept.get(*digest).cloned()).collect())
    }
}

/// The digest of all that decides what comes of a run.
fn digest(config: &RunConfig, robust: bool) -> Digest {
    // Plain data: serialising cannot fail; were it to, no run would be known again.
    Digest::of_json(&serde_json::to_value((config, robust)).unwrap_or_default())
}
