//! Training: a run from its configuration to its folder, and on from where it stopped.

use crate::{
    champion::Champion,
    config::{RunConfig, StrategySettings},
    jury::NominalJury,
    recorder::{EarlierLines, Recorder},
    run_folder::{FolderError, RunFolder},
    search::{Search, SearchVisitor},
    setup::{Setup, SetupError},
};
use ne_core::{
    Checkpoint, Decision, Evolution, EvolutionError, GenerationReport, Genome, Heats, Moment, Observer, Parallel,
    Progress, Promotion, Seed, SettingError, StopConditions, StopReason, StopSignal, Strategy, Task, ThreadsError,
};
use ne_net::Network;
use std::{path::Path, sync::Arc};
use tasks::MovementCatalogue;

/// How a run is to be carried out; none of it changes what the run finds.
pub struct TrainOptions<'a> {
    /// Threads; 0: one for each core.
    pub threads: usize,
    /// The movements there are.
    pub catalogue: MovementCatalogue,
    /// Ends the run after the generation under way.
    pub signal: StopSignal,
    /// Called after each generation, for a progress bar.
    pub on_generation: &'a mut dyn FnMut(&GenerationReport),
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
    /// The strategy belongs to another program.
    #[error("the strategy \"{strategy}\" is not one of Gambol's; the program that has it trains and resumes it")]
    Foreign {
        /// Its name.
        strategy: String,
    },
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
        format!("; go on with: gambol resume {}", folder.path().display())
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
    let setup = Setup::new(config, &options.catalogue)?;
    config.strategy.visit(Train { config, setup, folder, options })
}

/// Starts a run with whichever strategy the configuration names.
struct Train<'a, 'b> {
    config: &'a RunConfig,
    setup: Setup,
    folder: &'a Path,
    options: TrainOptions<'b>,
}

impl SearchVisitor for Train<'_, '_> {
    type Output = Result<Outcome, TrainError>;

    fn visit<S: Search>(self, settings: &S::Settings) -> Self::Output {
        let strategy = S::build(settings, &self.setup.topology)?;
        train_with(strategy, self.config, &self.setup, self.folder, self.options)
    }

    fn foreign(self, name: &str) -> Self::Output {
        Err(TrainError::Foreign { strategy: name.into() })
    }
}

/// Runs a configuration with a strategy of your own in place of the one it names; the folder's configuration then has
/// its name, as [`StrategySettings::Custom`].
///
/// # Errors
/// As [`train`].
pub fn train_with<S: Strategy>(
    strategy: S,
    config: &RunConfig,
    setup: &Setup,
    folder: &Path,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError>
where
    <S::Genome as Genome>::Phenotype: Into<Network>,
{
    train_leg(strategy, config, setup, folder, config.stop, None, options)
}

/// As [`train_with`], with the rules of a stage, and limits in place of those in the configuration.
pub(crate) fn train_leg<S: Strategy>(
    strategy: S,
    config: &RunConfig,
    setup: &Setup,
    folder: &Path,
    stop: StopConditions,
    promotion: Option<Arc<dyn Promotion>>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError>
where
    <S::Genome as Genome>::Phenotype: Into<Network>,
{
    let evaluator = Arc::new(Parallel::new(options.threads)?);
    let mut config = config.clone();
    if strategy.name() != config.strategy.name() {
        config.strategy = StrategySettings::Custom(strategy.name().into());
    }
    let config = &config;
    let (folder, _lock) = RunFolder::create(folder, config)?;
    let earlier = EarlierLines::check(&folder, config, 0)?;
    let evolution = with_rules(Evolution::new(strategy, Seed::of_run(config.seed), stop), promotion);
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
    let strategy = config.strategy.clone();
    strategy.visit(Resume { folder, config, stop, now: None, promotion: None, options })
}

/// As [`resume`], with the rules of a stage; `now` are the limits of this process, where they are other than those to be
/// written down.
pub(crate) fn resume_leg(
    folder: &Path,
    stop: StopConditions,
    now: StopConditions,
    promotion: Option<Arc<dyn Promotion>>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError> {
    let folder = RunFolder::open(folder)?;
    let config = folder.read_config()?;
    let strategy = config.strategy.clone();
    strategy.visit(Resume { folder, config, stop: Some(stop), now: Some(now), promotion, options })
}

/// A promotion that several may hold.
struct Shared(Arc<dyn Promotion>);

impl Promotion for Shared {
    fn decide(&self, moment: &Moment<'_>) -> Decision {
        self.0.decide(moment)
    }
}

fn with_rules<S: Strategy>(evolution: Evolution<S>, promotion: Option<Arc<dyn Promotion>>) -> Evolution<S> {
    match promotion {
        Some(promotion) => evolution.with_promotion(Shared(promotion)),
        None => evolution,
    }
}

/// Goes on with a run of whichever strategy its configuration names.
struct Resume<'a> {
    folder: RunFolder,
    config: RunConfig,
    stop: Option<StopConditions>,
    now: Option<StopConditions>,
    promotion: Option<Arc<dyn Promotion>>,
    options: TrainOptions<'a>,
}

impl SearchVisitor for Resume<'_> {
    type Output = Result<Outcome, TrainError>;

    fn visit<S: Search>(self, settings: &S::Settings) -> Self::Output {
        let same = |strategy: &S| strategy.settings() == settings;
        let Self { folder, config, stop, now, promotion, options } = self;
        resume_checked(folder, config, (stop, now), promotion, options, same)
    }

    fn foreign(self, name: &str) -> Self::Output {
        Err(TrainError::Foreign { strategy: name.into() })
    }
}

/// Goes on with a run that was started by [`train_with`].
///
/// # Errors
/// As [`resume`].
pub fn resume_with<S: Strategy>(
    folder: RunFolder,
    config: RunConfig,
    stop: Option<StopConditions>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError>
where
    <S::Genome as Genome>::Phenotype: Into<Network>,
{
    resume_checked::<S>(folder, config, (stop, None), None, options, |_| true)
}

fn resume_checked<S: Strategy>(
    folder: RunFolder,
    mut config: RunConfig,
    (stop, now): (Option<StopConditions>, Option<StopConditions>),
    promotion: Option<Arc<dyn Promotion>>,
    options: TrainOptions<'_>,
    same_settings: impl FnOnce(&S) -> bool,
) -> Result<Outcome, TrainError>
where
    <S::Genome as Genome>::Phenotype: Into<Network>,
{
    let planned = config.stop;
    config.stop = stop.unwrap_or(planned);
    let setup = Setup::new(&config, &options.catalogue)?;
    let evaluator = Arc::new(Parallel::new(options.threads)?);
    if !folder.checkpoint().is_file() {
        return Err(FolderError::NotARun { path: folder.path().into(), missing: "checkpoint".into() }.into());
    }
    let _lock = folder.lock()?;
    let checkpoint = Checkpoint::<S>::read(&folder.checkpoint()).map_err(FolderError::from)?;
    let foreign = |what| FolderError::Foreign { path: folder.checkpoint(), what };
    if checkpoint.seed != Seed::of_run(config.seed) {
        return Err(foreign("the seed").into());
    }
    if !same_settings(&checkpoint.strategy) {
        return Err(foreign("the strategy's settings").into());
    }
    if let Some(champion) = &checkpoint.champion
        && setup.episode.check_shape(&champion.genome.express()).is_err()
    {
        return Err(foreign("the inputs and outputs of its champion").into());
    }
    let best = checkpoint.champion.as_ref().map(ne_core::Champion::standing);
    let is_over = config.stop.reached(&checkpoint.progress, best, std::time::Duration::ZERO);
    if let Some(reason) = is_over.filter(|_| promotion.is_none()) {
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

fn drive<S: Strategy>(
    evolution: Evolution<S>,
    config: &RunConfig,
    setup: &Setup,
    folder: RunFolder,
    earlier: EarlierLines,
    evaluator: Arc<Parallel>,
    options: TrainOptions<'_>,
) -> Result<Outcome, TrainError>
where
    <S::Genome as Genome>::Phenotype: Into<Network>,
{
    let mut evolution = evolution.with_signal(options.signal);
    if let Some(nominal) = &setup.nominal {
        evolution = evolution.with_jury(config.record.hearings(), NominalJury::new(nominal, evaluator.clone()));
    }
    let generations = evolution.progress().generations;
    let mut recorder = Recorder::new(&folder, config, setup, earlier, options.on_generation)?;
    if generations == 0 {
        // So that a run killed in its first generations can be resumed too.
        recorder.save(&evolution)?;
    }
    let ended = {
        let mut observers: [Box<dyn Observer<S> + '_>; 1] = [Box::new(&mut recorder)];
        // The jury evaluates its finalists without heats: all of them are promising.
        evolution.run(&setup.task, &Heats::new(&*evaluator, setup.heats()), &mut observers)
    };
    let progress = evolution.progress();
    let reason = ended.map_err(|source| TrainError::BrokeOff {
        generation: progress.generations,
        folder: folder.clone(),
        source,
    })?;
    recorder.save(&evolution)?;
    let champion = match recorder.has_champion() {
        true => Some(Champion::read(&folder.champion()).map_err(FolderError::from)?),
        false => None,
    };
    Ok(Outcome { folder, reason, progress, champion })
}
