//! Training: a run from its configuration to its folder, and on from where it stopped. [`train`] and [`resume`] do the whole; a
//! [`Training`] does one generation at a time, for a program that has something else to do in between.

mod elsewhere;
mod generations;

pub use elsewhere::{Answers, Batch, BatchEvaluator, Step};
pub use generations::Training;

use crate::{
    Registry,
    champion::Champion,
    config::RunConfig,
    episode_parts::SetupError,
    run_folder::{FolderError, RunFolder},
    strategies::AnyStrategy,
};
use ne_core::{
    EvolutionError, Generation, Progress, SettingError, StopConditions, StopReason, StopSignal, ThreadsError,
};
use std::path::Path;

/// What a run has to work with; none of it changes what the run finds.
#[derive(Clone, Debug)]
pub struct Resources {
    /// Threads; 0: one for each core.
    pub threads: usize,
    /// What the configuration can name.
    pub registry: Registry,
    /// Ends the run after the generation under way.
    pub signal: StopSignal,
}

/// How a run is to be carried out; none of it changes what the run finds.
pub struct TrainOptions<'a> {
    /// Threads; 0: one for each core.
    pub threads: usize,
    /// What the configuration can name.
    pub registry: Registry,
    /// Ends the run after the generation under way.
    pub signal: StopSignal,
    /// Called after each generation, once it is written down: for a progress bar, for a viewer. What it does cannot change the run; the
    /// run waits for it.
    pub on_generation: &'a mut dyn FnMut(&Generation<'_, AnyStrategy>),
}

type OnGeneration<'a> = &'a mut dyn FnMut(&Generation<'_, AnyStrategy>);

impl<'a> TrainOptions<'a> {
    pub(crate) fn split(self) -> (Resources, OnGeneration<'a>) {
        let Self { threads, registry, signal, on_generation } = self;
        (Resources { threads, registry, signal }, on_generation)
    }
}

/// How a run ended.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Where everything is.
    pub folder: RunFolder,
    /// Why it ended.
    pub reason: StopReason,
    /// What it used.
    pub progress: Progress,
    /// The best it found; `None` if every evaluation failed.
    pub champion: Option<Champion>,
}

/// Why a run could not be started or could not go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TrainError {
    /// The configuration is not one that can run.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The folder cannot be used, or could not be written.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The threads cannot be started.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
    /// The run broke off.
    #[error(
        "{source}\nthe run stopped in generation {generation}; what was saved before is whole{}",
        resume_hint(folder)
    )]
    BrokeOff {
        /// The generation under way.
        generation: u64,
        /// Where the run is.
        folder: RunFolder,
        /// What happened.
        source: EvolutionError,
    },
    /// The configuration is that of a run that went on from another.
    #[error("the configuration goes on from {from}; say from where it is to go on, with --from {from}")]
    Origin {
        /// Where that run went on from.
        from: String,
    },
    /// The configuration has stages.
    #[error("the configuration has stages; it is trained stage by stage, by shaping::train_stages")]
    Stages,
    /// The run is over and there is nothing left to do.
    #[error(
        "the run in {} has ended: {reason} (generation {generations}){}", folder.path().display(),
        how_to_go_on(*reason, *generations)
    )]
    Over {
        /// Where the run is.
        folder: RunFolder,
        /// Why it ended.
        reason: StopReason,
        /// Generations done.
        generations: u64,
    },
}

fn how_to_go_on(reason: StopReason, generations: u64) -> String {
    let limit = match reason {
        StopReason::Generations | StopReason::Tier => format!("--generations {}", generations + 100),
        StopReason::Evaluations => "more --evaluations".into(),
        StopReason::Steps => "more --steps".into(),
        StopReason::Target => "a higher --target".into(),
        StopReason::Stagnation => "a higher --stagnation".into(),
        _ => return String::new(),
    };
    format!("; to go on, say {limit}")
}

fn resume_hint(folder: &RunFolder) -> String {
    if folder.checkpoint().is_file() || folder.stages().is_dir() {
        format!("; go on with: {} resume {}", crate::program_name(), crate::texts::shell_word(folder.path()))
    } else {
        String::new()
    }
}

impl From<SettingError> for TrainError {
    fn from(error: SettingError) -> Self {
        Self::Setup(error.into())
    }
}

/// Runs a configuration in a new folder.
///
/// # Errors
/// If the configuration is not valid, has stages, or is that of a run that went on from another; if the folder is not
/// empty or cannot be written.
pub fn train(config: &RunConfig, folder: &Path, options: TrainOptions<'_>) -> Result<Outcome, TrainError> {
    let (resources, on_generation) = options.split();
    Training::begin(config, folder, &resources)?.run(on_generation)
}

/// Goes on with a run from its last checkpoint. Other stop conditions, if given, take the place of the planned ones; they
/// are written into the folder, so that the run is again what its configuration says.
///
/// # Errors
/// If the folder is no run, another process works in it, a file is damaged, of another version or of another run
/// (nothing is changed then), or the run is over.
pub fn resume(folder: &Path, stop: Option<StopConditions>, options: TrainOptions<'_>) -> Result<Outcome, TrainError> {
    let (resources, on_generation) = options.split();
    Training::resume(folder, stop, &resources)?.run(on_generation)
}
