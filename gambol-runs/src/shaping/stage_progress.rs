//! The way through the stages: each stage run is a run folder that begins where the one before ended.

use super::{
    Curriculum, PlannedStage, StageError, StagedTraining, Stages,
    source::{Source, leading_stage_run},
    stage_runs::{leading, stage_runs, total},
    transfer::{PreparedTransfer, TransferError, TransferOptions},
};
use crate::{
    Registry,
    champion::Champion,
    config::{Origin, RunConfig, Transferred},
    run_folder::{FolderError, RunFolder},
    training::{Outcome, Resources, TrainError, TrainOptions, Training},
};
use ne_core::{Progress, StopConditions, StopReason};
use std::path::{Path, PathBuf};

/// How a run with stages is watched.
pub struct StageProgress<'a> {
    /// Called when a stage run begins, or is taken up again: its folder is there, and its stage is about to be trained.
    pub on_stage_run: &'a mut dyn FnMut(&PlannedStage, Option<&Origin>),
}

/// Why a run could not go on from another, or through its stages.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShapingError {
    /// A stage is wrong; nothing was trained.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// What was learned cannot be transferred.
    #[error(transparent)]
    Transfer(#[from] TransferError),
    /// A run could not be carried out.
    #[error(transparent)]
    Train(#[from] TrainError),
    /// A folder cannot be used, or could not be written.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A run with stages begins with the first of them.
    #[error(
        "a configuration with stages begins with its first, from nothing; leave out the stages, or what to go on from"
    )]
    Stages,
    /// What is to go on is a stage, and would go on without the rules of its run.
    #[error(
        "{} is a stage of the run in {}, which goes on as a whole: {} resume {}", stage.display(), run.display(),
        crate::program_name(), crate::texts::shell_word(run)
    )]
    StageOfARun {
        /// The folder of the stage.
        stage: PathBuf,
        /// That of the run.
        run: PathBuf,
    },
    /// There is nothing to go through.
    #[error("the configuration has no stages")]
    NoStages,
}

/// Trains a configuration in a new folder, from what a run or a champion has learned: on another task, another terrain, a
/// body that has changed. The folder's configuration says where it came from, and what was kept.
///
/// # Errors
/// If the source cannot be read, nothing can be transferred to this configuration, or as [`train`](crate::training::train).
pub fn train_from(
    config: &RunConfig,
    source: &Path,
    transferred: Option<Transferred>,
    allow_loss: bool,
    folder: &Path,
    options: TrainOptions<'_>,
) -> Result<Outcome, ShapingError> {
    let (resources, on_generation) = options.split();
    Ok(begin_from(config, source, transferred, allow_loss, folder, &resources)?.run(on_generation)?)
}

/// As [`train_from`], before its first generation.
///
/// # Errors
/// As [`train_from`].
pub fn begin_from(
    config: &RunConfig,
    source: &Path,
    transferred: Option<Transferred>,
    allow_loss: bool,
    folder: &Path,
    resources: &Resources,
) -> Result<Training, ShapingError> {
    let departure = prepare(config, source, TransferOptions { transferred, allow_loss }, &resources.registry)?;
    let strategies = &resources.registry.strategies;
    let search = (departure.search(strategies)?, departure.champion(strategies)?);
    let PreparedTransfer { config, setup, .. } = departure;
    Ok(Training::begin_stage_run(search, &config, setup, folder, config.stop, None, resources)?)
}

/// What [`train_from`] would begin with, nothing being given up: its configuration. Nothing is written.
///
/// # Errors
/// As [`train_from`], before anything is trained.
pub fn configured_from(config: &RunConfig, source: &Path, registry: &Registry) -> Result<RunConfig, ShapingError> {
    Ok(prepare(config, source, TransferOptions::default(), registry)?.config)
}

fn prepare(
    config: &RunConfig,
    source: &Path,
    how: TransferOptions,
    registry: &Registry,
) -> Result<PreparedTransfer, ShapingError> {
    let departure = PreparedTransfer::prepare(Source::open(source, registry)?, config, how, registry)?;
    if departure.config.stages.is_empty() { Ok(departure) } else { Err(ShapingError::Stages) }
}

/// The configuration with the sensors and the controller of a run (of one with stages, of the last) or a champion: what a
/// net must hear and drive to go on.
///
/// # Errors
/// If the run or the champion cannot be read.
pub fn adopt(config: &RunConfig, source: &Path) -> Result<RunConfig, ShapingError> {
    let mut config = config.clone();
    if source.is_dir() {
        let learned = leading_stage_run(RunFolder::open(source)?)?.read_config()?;
        config.sensors = Some(learned.sensors.unwrap_or(learned.creature.sensors));
        config.controller = learned.controller;
    } else {
        let champion = crate::champion::Champion::read(source).map_err(FolderError::from)?;
        config.sensors = Some(champion.sensors);
        config.controller.input_range = champion.input_range;
        config.controller.actuation = champion.actuation;
    }
    Ok(config)
}

/// Trains a configuration with stages in a new folder, one stage after the other.
///
/// # Errors
/// If a stage is wrong, which is found before anything is trained, or as [`train`](crate::training::train).
pub fn train_stages(
    config: &RunConfig,
    folder: &Path,
    stage_progress: StageProgress<'_>,
    options: TrainOptions<'_>,
) -> Result<Outcome, ShapingError> {
    let stages = Stages::listed(config, &options.registry)?;
    train_curriculum(&stages, config, folder, stage_progress, options)
}

/// Goes on with a run with stages from where it stopped. Other stop conditions, if given, take the place of the planned
/// ones.
///
/// # Errors
/// As [`train_stages`] and [`resume`](crate::training::resume).
pub fn resume_stages(
    folder: &Path,
    stop: Option<StopConditions>,
    stage_progress: StageProgress<'_>,
    options: TrainOptions<'_>,
) -> Result<Outcome, ShapingError> {
    let folder = RunFolder::open(folder)?;
    let stages = Stages::listed(&folder.read_config()?, &options.registry)?;
    resume_curriculum(&stages, &folder, stop, stage_progress, options)
}

/// As [`train_stages`], with a curriculum of your own: the configuration has the seed, the limits and what is recorded of the
/// whole run.
///
/// # Errors
/// As [`train_stages`].
pub fn train_curriculum(
    curriculum: &dyn Curriculum,
    config: &RunConfig,
    folder: &Path,
    stage_progress: StageProgress<'_>,
    options: TrainOptions<'_>,
) -> Result<Outcome, ShapingError> {
    let (resources, on_generation) = options.split();
    StagedTraining::begin_curriculum(curriculum, config, folder, resources)?.run(stage_progress, on_generation)
}

/// As [`resume_stages`], with the curriculum of [`train_curriculum`].
///
/// # Errors
/// As [`resume_stages`].
pub fn resume_curriculum(
    curriculum: &dyn Curriculum,
    folder: &RunFolder,
    stop: Option<StopConditions>,
    stage_progress: StageProgress<'_>,
    options: TrainOptions<'_>,
) -> Result<Outcome, ShapingError> {
    let (resources, on_generation) = options.split();
    StagedTraining::resume_curriculum(curriculum, folder, stop, resources)?.run(stage_progress, on_generation)
}

/// What came of a run that has ended, from its folder; of one with stages, from all of them.
///
/// # Errors
/// If a file of the run cannot be read.
pub fn outcome_of(folder: &RunFolder, reason: StopReason) -> Result<Outcome, FolderError> {
    let progress = match folder.checkpoint().is_file() {
        true => folder.read_standing()?.progress,
        false => total(&stage_runs(folder)?),
    };
    let champion = folder.champion().is_file().then(|| Champion::read(&folder.champion())).transpose()?;
    Ok(Outcome { folder: folder.clone(), reason, progress, champion })
}

/// Whether the champion of a run has learned what the whole run is for: always where its configuration lists no stages; else if it is
/// from a stage that [learns that](Stages::is_goal). What a curriculum of one's own learns is not written down.
///
/// # Errors
/// If a file of the run cannot be read, or its configuration is none that can run.
pub fn is_of_goal(folder: &RunFolder, registry: &Registry) -> Result<bool, ShapingError> {
    let config = folder.read_config()?;
    if config.stages.is_empty() {
        return Ok(true);
    }
    let stages = Stages::new(&config, registry)?;
    Ok(leading(&stage_runs(folder)?).is_some_and(|stage_run| stages.is_goal(stage_run.stage)))
}

/// What is said of a champion that is usable, and not [of the goal](is_of_goal).
pub const ENDED_EARLY: &str = "the run ended in a stage before the one that learns what the run is for";

/// The error of a stage run, told of the whole run: its folder, and the generations of all stage runs; `used` is what those before have
/// used.
pub(super) fn of_the_run(error: ShapingError, run: &RunFolder, used: Progress) -> ShapingError {
    let folder = run.clone();
    match error {
        ShapingError::Train(TrainError::Over { reason, generations, .. }) => {
            TrainError::Over { folder, reason, generations: used.generations + generations }.into()
        }
        ShapingError::Train(TrainError::BrokeOff { generation, source, .. }) => {
            TrainError::BrokeOff { folder, generation: used.generations + generation, source }.into()
        }
        other => other,
    }
}
