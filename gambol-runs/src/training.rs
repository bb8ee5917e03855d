//! Training: a run from its configuration to its folder, and on from where it stopped.

use crate::Registry;
use crate::{
    champion::Champion,
    champion_selection::ReferenceSelection,
    config::RunConfig,
    episode_parts::SetupError,
    recorder::{EarlierLines, Recorder},
    run_folder::{FolderError, RunFolder},
    setup::Setup,
    strategies::{AnyGenome, AnyStrategy},
};
use ne_core::{
    Evolution, EvolutionError, Generation, Genome, Observer, Parallel, Progress, Seed, SettingError, StopConditions,
    StopReason, StopSignal, Task, ThreadsError,
    promotion::{Decision, Promotion, StageState},
    successive_halving::SuccessiveHalving,
};
use std::{path::Path, sync::Arc};

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
    #[error("the configuration has stages; it is trained stage by stage (shaping::train_stages)")]
    Stages,
    /// The run is over and there is nothing left to do.
    #[error(
        "the run in {} has ended: {reason} (generation {generations}); to go on, raise its limit, such as --generations {}",
        folder.path().display(), generations + 100
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
    if !config.stages.is_empty() {
        return Err(TrainError::Stages);
    }
    if let Some(origin) = &config.origin {
        return Err(TrainError::Origin { from: origin.source.clone() });
    }
    let setup = Setup::new(config, &options.registry)?;
    let strategy = options.registry.strategies.build(&config.strategy, &setup.topology).map_err(SetupError::from)?;
    train_stage_run((strategy, None), config, &setup, folder, config.stop, None, options)
}

/// As [`train`], from where a search is to begin, with a champion that it need not find again, the rules of a stage, and limits in
/// place of those in the configuration.
pub(crate) fn train_stage_run(
    (strategy, champion): (AnyStrategy, Option<AnyGenome>),
    config: &RunConfig,
    setup: &Setup,
    folder: &Path,
    stop: StopConditions,
    promotion: Option<Arc<dyn Promotion>>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError> {
    let evaluator = Arc::new(Parallel::new(options.threads)?);
    let (folder, _lock) = RunFolder::create(folder)?;
    let mut evolution = with_rules(Evolution::new(strategy, Seed::of_run(config.seed), stop), promotion);
    if let Some(champion) = champion.filter(|_| setup.reference.is_some()) {
        evolution = evolution.with_candidate(champion);
    }
    // The configuration comes last: what is a run can be resumed, wherever it was killed.
    evolution.write_checkpoint(&folder.checkpoint()).map_err(FolderError::from)?;
    folder.write_config(config)?;
    let earlier = EarlierLines::check(&folder, config, 0)?;
    drive(evolution, config, setup, folder, earlier, evaluator, options)
}

/// Goes on with a run from its last checkpoint. Other stop conditions, if given, take the place of the planned ones; they
/// are written into the folder, so that the run is again what its configuration says.
///
/// # Errors
/// If the folder is no run, another process works in it, a file is damaged, of another version or of another run
/// (nothing is changed then), or the run is over.
pub fn resume(folder: &Path, stop: Option<StopConditions>, options: TrainOptions<'_>) -> Result<Outcome, TrainError> {
    let folder = RunFolder::open(folder)?;
    let config = folder.read_config()?;
    resume_checked(folder, config, (stop, None), None, options)
}

/// As [`resume`], with the rules of a stage; `now` are the limits of this process, where they are other than those to be
/// written down.
pub(crate) fn resume_stage_run(
    folder: &Path,
    stop: StopConditions,
    now: StopConditions,
    promotion: Option<Arc<dyn Promotion>>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError> {
    let folder = RunFolder::open(folder)?;
    let config = folder.read_config()?;
    resume_checked(folder, config, (Some(stop), Some(now)), promotion, options)
}

/// A promotion that several may hold.
struct Shared(Arc<dyn Promotion>);

impl Promotion for Shared {
    fn decide(&self, moment: &StageState<'_>) -> Decision {
        self.0.decide(moment)
    }
}

fn with_rules(evolution: Evolution<AnyStrategy>, promotion: Option<Arc<dyn Promotion>>) -> Evolution<AnyStrategy> {
    match promotion {
        Some(promotion) => evolution.with_promotion(Shared(promotion)),
        None => evolution,
    }
}

fn resume_checked(
    folder: RunFolder,
    mut config: RunConfig,
    (stop, now): (Option<StopConditions>, Option<StopConditions>),
    promotion: Option<Arc<dyn Promotion>>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError> {
    let planned = config.stop;
    config.stop = stop.unwrap_or(planned);
    let setup = Setup::new(&config, &options.registry)?;
    let evaluator = Arc::new(Parallel::new(options.threads)?);
    if !folder.checkpoint().is_file() {
        return Err(FolderError::NotARun { path: folder.path().into(), missing: "checkpoint".into() }.into());
    }
    let _lock = folder.lock()?;
    let entry = options.registry.strategies.of(&config.strategy).map_err(SetupError::from)?;
    let checkpoint = entry.read_checkpoint(&folder.checkpoint()).map_err(FolderError::from)?;
    let foreign = |what| FolderError::Foreign { path: folder.checkpoint(), what };
    if checkpoint.seed != Seed::of_run(config.seed) {
        return Err(foreign("the seed").into());
    }
    if !checkpoint.strategy.has_settings(&config.strategy) {
        return Err(foreign("the strategy's settings").into());
    }
    if !checkpoint.strategy.fits(&setup.topology) {
        return Err(foreign("the body that its nets are for").into());
    }
    if let Some(champion) = &checkpoint.champion
        && setup.episode.check_shape(&champion.genome.express()).is_err()
    {
        return Err(foreign("the inputs and outputs of its champion").into());
    }
    if let Some(champion) = &checkpoint.champion {
        check_repeats(champion, &setup, &folder)?;
    }
    let best = checkpoint.champion.as_ref().map(ne_core::Champion::standing);
    let is_over = config.stop.reached(&checkpoint.progress, best, std::time::Duration::ZERO);
    // One that was killed before its last save still has that to come.
    if let Some(reason) = is_over.filter(|_| promotion.is_none() && checkpoint.last) {
        return Err(TrainError::Over { folder, reason, generations: checkpoint.progress.generations });
    }
    let earlier = EarlierLines::check(&folder, &config, checkpoint.progress.generations)?;
    // From here on the folder is known to be whole.
    if config.stop != planned {
        folder.write_config(&config)?;
    }
    let evolution = with_rules(Evolution::resume(checkpoint, now.unwrap_or(config.stop)), promotion);
    drive(evolution, &config, &setup, folder, earlier, evaluator, options)
}

/// Checks that the champion of a checkpoint is worth what it says.
fn check_repeats(
    champion: &ne_core::Champion<AnyGenome>,
    setup: &Setup,
    folder: &RunFolder,
) -> Result<(), FolderError> {
    let evaluation = match &setup.reference {
        Some(reference) => reference.replay(&champion.genome.express(), champion.seed).1,
        None => setup.task.evaluate(&mut champion.genome.express(), champion.seed),
    };
    if evaluation.fitness() == Some(champion.fitness) {
        return Ok(());
    }
    let found = match evaluation.outcome {
        Ok(fitness) => fitness.to_string(),
        Err(failure) => format!("no fitness ({failure})"),
    };
    Err(FolderError::Unrepeatable { path: folder.checkpoint(), recorded: champion.fitness, found })
}

fn drive(
    evolution: Evolution<AnyStrategy>,
    config: &RunConfig,
    setup: &Setup,
    folder: RunFolder,
    earlier: EarlierLines,
    evaluator: Arc<Parallel>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError> {
    let _span = tracing::debug_span!("run", folder = %folder.path().display()).entered();
    let mut evolution = evolution.with_signal(options.signal);
    if let Some(reference) = &setup.reference {
        evolution = evolution.with_champion_selection(
            config.record.re_evaluations(),
            ReferenceSelection::new(reference, evaluator.clone()),
        );
    }
    let mut recorder = Recorder::new(&folder, config, setup, earlier, options.on_generation)?;
    let ended = {
        let mut observers: [Box<dyn Observer<AnyStrategy> + '_>; 1] = [Box::new(&mut recorder)];
        // The champion selection evaluates its candidates without rungs: all of them are promising.
        evolution.run(&setup.task, &SuccessiveHalving::new(&*evaluator, setup.rungs()), &mut observers)
    };
    let progress = evolution.progress();
    let broke_off = |source| TrainError::BrokeOff { generation: progress.generations, folder: folder.clone(), source };
    let reason = ended.map_err(broke_off)?;
    // Between two re-evaluations the champion file has the one that would be champion now. The checkpoint does not know of it,
    // so that the run goes on as if it had not been asked for.
    let champion = evolution.champion_if_re_evaluated().map_err(broke_off)?;
    recorder.finish(&evolution, champion.as_ref())?;
    let champion = match recorder.has_champion() {
        true => Some(Champion::read(&folder.champion()).map_err(FolderError::from)?),
        false => None,
    };
    Ok(Outcome { folder, reason, progress, champion })
}
