//! A run under way, with stages or without.

use crate::{
    config::RunConfig,
    run_folder::RunFolder,
    shaping::{self, ShapingError, StageProgress, StagedTraining, Stages},
    strategies::AnyStrategy,
    training::{Answers, Outcome, Resources, Step, Training},
};
use ne_core::{Generation, StopConditions, StopReason};
use std::path::Path;

/// A run that does one generation at a time, whatever its configuration asks for: for programs that have something else to do in
/// between, such as to show it.
///
/// One that is dropped before it was [finished](Self::finish) is like one that was killed: it can be resumed.
pub enum Run {
    /// Without stages.
    Plain(Box<Training>),
    /// With stages.
    Staged(Box<StagedTraining<Stages>>),
}

impl Run {
    /// Begins a run in a new folder.
    ///
    /// # Errors
    /// As [`train`](crate::training::train) and [`train_stages`](crate::shaping::train_stages).
    pub fn begin(config: &RunConfig, folder: &Path, resources: Resources) -> Result<Self, ShapingError> {
        Ok(match config.stages.is_empty() {
            true => Self::Plain(Box::new(Training::begin(config, folder, &resources)?)),
            false => Self::Staged(Box::new(StagedTraining::begin(config, folder, resources)?)),
        })
    }

    /// Begins a run in a new folder, from what another run or a champion has learned: as much as can be.
    ///
    /// # Errors
    /// As [`train_from`](crate::shaping::train_from), where nothing may be lost.
    pub fn begin_from(
        config: &RunConfig,
        source: &Path,
        folder: &Path,
        resources: &Resources,
    ) -> Result<Self, ShapingError> {
        Ok(Self::Plain(Box::new(shaping::begin_from(config, source, None, false, folder, resources)?)))
    }

    /// Goes on with a run from where it stopped; not with a stage of one. Other stop conditions, if given, take the place of the planned ones.
    ///
    /// # Errors
    /// As [`resume`](crate::training::resume) and [`resume_stages`](crate::shaping::resume_stages).
    pub fn resume(folder: &Path, stop: Option<StopConditions>, resources: Resources) -> Result<Self, ShapingError> {
        let config = RunFolder::open(folder)?.read_config()?;
        shaping::check_whole(folder)?;
        Ok(match config.stages.is_empty() {
            true => Self::Plain(Box::new(Training::resume(folder, stop, &resources)?)),
            false => Self::Staged(Box::new(StagedTraining::resume(folder, stop, resources)?)),
        })
    }

    /// Does a generation, or goes from one stage to the next. If the run is over, the reason is returned.
    ///
    /// # Errors
    /// If the run breaks off: what was saved before is whole.
    pub fn generation(
        &mut self,
        stage_progress: &mut StageProgress<'_>,
        on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
    ) -> Result<Option<StopReason>, ShapingError> {
        match self {
            Self::Plain(training) => Ok(training.generation(on_generation)?),
            Self::Staged(training) => training.generation(stage_progress, on_generation),
        }
    }

    /// As [`generation`](Self::generation), with evaluations from elsewhere: see [`Training::generation_by`].
    ///
    /// # Errors
    /// As [`generation`](Self::generation) and [`Training::generation_by`].
    pub fn generation_by(
        &mut self,
        answers: &mut Answers,
        stage_progress: &mut StageProgress<'_>,
        on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
    ) -> Result<Step, ShapingError> {
        match self {
            Self::Plain(training) => Ok(training.generation_by(answers, on_generation)?),
            Self::Staged(training) => training.generation_by(answers, stage_progress, on_generation),
        }
    }

    /// What its batches are evaluated by; `None` between two stages.
    pub fn stage_config(&self) -> Option<&RunConfig> {
        match self {
            Self::Plain(training) => Some(training.config()),
            Self::Staged(training) => training.stage_config(),
        }
    }

    /// Saves what there is. `reason`: that of [`generation`](Self::generation), or [`StopReason::Interrupted`] at any moment.
    ///
    /// # Errors
    /// If the folder cannot be written.
    pub fn finish(self, reason: StopReason) -> Result<Outcome, ShapingError> {
        match self {
            Self::Plain(training) => Ok(training.finish(reason)?),
            Self::Staged(training) => training.finish(reason),
        }
    }
}
