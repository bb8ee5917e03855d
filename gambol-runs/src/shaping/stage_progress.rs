//! The way through the stages: each stage run is a run folder that begins where the one before ended.

use super::{
    Beginning, Curriculum, PlannedStage, StageError, StageRun, Stages,
    source::{Source, leading_stage_run},
    stage_runs::{keep_champion, stage_run, stage_runs, total},
    transfer::{PreparedTransfer, TransferError, TransferOptions},
};
use crate::{
    champion::Champion,
    config::{Origin, RunConfig, Transferred},
    episode_parts::SetupError,
    run_folder::{FolderError, FolderLock, RunFolder},
    setup::Setup,
    training::{self, Outcome, TrainError, TrainOptions},
};
use ne_core::{Progress, StopConditions, StopReason, promotion::Decision};
use std::{path::Path, time::Instant};

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
    let source = Source::open(source, &options.registry)?;
    let departure =
        PreparedTransfer::prepare(source, config, TransferOptions { transferred, allow_loss }, &options.registry)?;
    let config = departure.config.clone();
    if !config.stages.is_empty() {
        return Err(ShapingError::Stages);
    }
    let strategies = &options.registry.strategies;
    let search = (departure.search(strategies)?, departure.champion(strategies)?);
    Ok(training::train_stage_run(search, &config, &departure.setup, folder, config.stop, None, options)?)
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
    let stages = listed(config, &options)?;
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
    let stages = listed(&folder.read_config()?, &options)?;
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
    let (folder, lock) = RunFolder::create(folder)?;
    folder.write_config(config)?;
    travel(curriculum, config, &folder, lock, stage_progress, options)
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
    let mut config = folder.read_config()?;
    let lock = folder.lock()?;
    if let Some(stop) = stop.filter(|&stop| stop != config.stop) {
        config.stop = stop;
        folder.write_config(&config)?;
    }
    travel(curriculum, &config, folder, lock, stage_progress, options)
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

fn listed(config: &RunConfig, options: &TrainOptions<'_>) -> Result<Stages, ShapingError> {
    match config.stages.is_empty() {
        true => Err(ShapingError::NoStages),
        false => Ok(Stages::new(config, &options.registry)?),
    }
}

/// Goes through the stages, from the first that is not passed.
fn travel(
    curriculum: &dyn Curriculum,
    config: &RunConfig,
    folder: &RunFolder,
    _lock: FolderLock,
    stage_progress: StageProgress<'_>,
    options: TrainOptions<'_>,
) -> Result<Outcome, ShapingError> {
    let began = Instant::now();
    let mut stage_runs: Vec<StageRun> = Vec::new();
    while let Some(planned) = curriculum.next(&stage_runs) {
        let number = stage_runs.len() + 1;
        let path = folder.stages().join(format!("{number:02}-{}", planned.name));
        let stage_folder = RunFolder::at(&path);
        let is_begun = stage_folder.is_begun();
        if is_begun && stage_folder.read_standing()?.decision != Decision::Stay {
            stage_runs.push(stage_run(&stage_folder, number, planned.stage, &planned.name)?);
            continue;
        }
        let used = total(&stage_runs);
        let stop = limits(config.stop, used, planned.promotion.is_some());
        if let Some(reason) = exhausted(stop) {
            if is_begun {
                stage_runs.push(stage_run(&stage_folder, number, planned.stage, &planned.name)?);
            }
            return finish(folder, reason, total(&stage_runs), &stage_runs);
        }
        let mut now = stop;
        now.minutes = config.stop.minutes.map(|minutes| (minutes - began.elapsed().as_secs_f64() / 60.0).max(1e-6));
        let stage_config = RunConfig {
            seed: config.seed.wrapping_add(SEED_STEP * stage_runs.len() as u64),
            stop,
            record: config.record.clone(),
            stages: Vec::new(),
            ..planned.config.clone()
        };
        // The process may have been killed before it came to that.
        let begun = is_begun.then(|| stage_run(&stage_folder, number, planned.stage, &planned.name)).transpose()?;
        keep_champion(folder, stage_runs.iter().chain(&begun))?;
        let options = TrainOptions {
            threads: options.threads,
            registry: options.registry.clone(),
            signal: options.signal.clone(),
            on_generation: &mut *options.on_generation,
        };
        let outcome = if is_begun {
            (stage_progress.on_stage_run)(&planned, stage_folder.read_config()?.origin.as_ref());
            training::resume_stage_run(&path, stop, now, planned.promotion.clone(), options).map_err(ShapingError::from)
        } else {
            let before = match planned.begins {
                Beginning::Before => stage_runs.last(),
                Beginning::After(number) => stage_runs.iter().find(|stage_run| stage_run.number == number),
                Beginning::Nothing => None,
            };
            begin(&planned, stage_config, &path, before, now, &mut *stage_progress.on_stage_run, options)
        };
        let outcome = outcome.map_err(|error| of_the_run(error, folder, used))?;
        let passed = stage_run(&stage_folder, number, planned.stage, &planned.name)?;
        let goes_on = passed.decision != Decision::Stay;
        stage_runs.push(passed);
        keep_champion(folder, &stage_runs)?;
        if !goes_on {
            return finish(folder, outcome.reason, total(&stage_runs), &stage_runs);
        }
    }
    let used = total(&stage_runs);
    finish(folder, StopReason::Promoted, used, &stage_runs)
}

/// Seeds of the stage runs of a run lie so far apart.
const SEED_STEP: u64 = 1_000_000;

/// Begins a stage run: from nothing, or from where the stage run before ended.
fn begin(
    planned: &PlannedStage,
    config: RunConfig,
    path: &Path,
    before: Option<&StageRun>,
    now: StopConditions,
    on_stage_run: &mut dyn FnMut(&PlannedStage, Option<&Origin>),
    options: TrainOptions<'_>,
) -> Result<Outcome, ShapingError> {
    // Without a checkpoint nothing in it is of this run; but it may be somebody's.
    if !RunFolder::set_aside(path)? {
        return Err(FolderError::Busy { path: path.into() }.into());
    }
    let Some(before) = before else {
        let setup = Setup::new(&config, &options.registry).map_err(TrainError::from)?;
        on_stage_run(planned, None);
        let strategies = &options.registry.strategies;
        let strategy = strategies
            .build(&config.strategy, &setup.topology)
            .map_err(|error| TrainError::from(SetupError::from(error)))?;
        let promotion = planned.promotion.clone();
        return Ok(training::train_stage_run((strategy, None), &config, &setup, path, now, promotion, options)?);
    };
    // Named as the folders lie beside each other, so that a run may be moved.
    let name = before.folder.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let source = Source::run(name, RunFolder::open(&before.folder)?, &options.registry)?;
    // A search that has nothing to transfer is no reason to end a run: its champion goes on, as the folder's origin says.
    let transferred = match planned.transfer {
        Some(Transferred::Population) if source.has_nothing_to_transfer()? => None,
        transferred => transferred,
    };
    let how = TransferOptions { transferred, allow_loss: planned.allow_loss };
    let departure = PreparedTransfer::prepare(source, &config, how, &options.registry)?;
    let config = departure.config.clone();
    on_stage_run(planned, config.origin.as_ref());
    let strategies = &options.registry.strategies;
    let search = (departure.search(strategies)?, departure.champion(strategies)?);
    let promotion = planned.promotion.clone();
    Ok(training::train_stage_run(search, &config, &departure.setup, path, now, promotion, options)?)
}

/// The limits of a stage run: what is left of the budgets. A fitness, a tier or stagnation ends the run only in a stage without
/// a rule of its own.
fn limits(stop: StopConditions, used: Progress, has_rule: bool) -> StopConditions {
    let left = |limit: Option<u64>, used: u64| limit.map(|limit| limit.saturating_sub(used));
    StopConditions {
        generations: left(stop.generations, used.generations),
        evaluations: left(stop.evaluations, used.evaluations),
        steps: left(stop.steps, used.steps),
        minutes: stop.minutes,
        target: stop.target.filter(|_| !has_rule),
        tier: stop.tier.filter(|_| !has_rule),
        stagnation: stop.stagnation.filter(|_| !has_rule),
    }
}

fn exhausted(stop: StopConditions) -> Option<StopReason> {
    [
        (stop.generations, StopReason::Generations),
        (stop.evaluations, StopReason::Evaluations),
        (stop.steps, StopReason::Steps),
    ]
    .into_iter()
    .find_map(|(left, reason)| (left == Some(0)).then_some(reason))
}

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

fn finish(
    folder: &RunFolder,
    reason: StopReason,
    progress: Progress,
    stage_runs: &[StageRun],
) -> Result<Outcome, ShapingError> {
    keep_champion(folder, stage_runs)?;
    let path = folder.champion();
    let champion = path.is_file().then(|| Champion::read(&path)).transpose().map_err(FolderError::from)?;
    Ok(Outcome { folder: folder.clone(), reason, progress, champion })
}
