use super::{
    Outcome, Resources, TrainError,
    elsewhere::{Answers, Remembering, Step},
};
use crate::{
    champion::Champion,
    champion_selection::ReferenceSelection,
    config::RunConfig,
    episode_parts::SetupError,
    recorder::{EarlierLines, Recorded, Recorder, Recording, read_champion},
    run_folder::{FolderError, FolderLock, RunFolder},
    setup::Setup,
    strategies::{AnyGenome, AnyStrategy},
};
use ne_core::{
    Checkpoint, Evaluator, Evolution, EvolutionError, Generation, Genome, Observer, Parallel, Progress, Seed,
    StopConditions, StopReason, Strategy, Task,
    promotion::{Decision, Promotion, StageState},
    successive_halving::SuccessiveHalving,
};
use std::{
    cell::{Cell, RefCell},
    path::Path,
    sync::Arc,
    time::{Duration, Instant},
};

/// A run under way, which does one generation at a time. Between two generations everything may happen that takes whatever time:
/// the run does not notice.
///
/// One that is dropped before it was [finished](Self::finish) is like one that was killed: it can be resumed.
pub struct Training {
    evolution: Evolution<AnyStrategy>,
    config: RunConfig,
    setup: Setup,
    folder: RunFolder,
    recorder: Recorder,
    evaluator: SuccessiveHalving<Arc<Parallel>>,
    /// Read only where time is a limit.
    began: Option<Instant>,
}

/// Where a search begins: a strategy, and a champion that it need not find again.
pub(crate) type Search = (AnyStrategy, Option<AnyGenome>);

impl Training {
    /// Begins a run in a new folder.
    ///
    /// # Errors
    /// As [`train`](super::train).
    pub fn begin(config: &RunConfig, folder: &Path, resources: &Resources) -> Result<Self, TrainError> {
        if !config.stages.is_empty() {
            return Err(TrainError::Stages);
        }
        if let Some(origin) = &config.origin {
            return Err(TrainError::Origin { from: origin.source.clone() });
        }
        let setup = Setup::new(config, &resources.registry)?;
        let strategy =
            resources.registry.strategies.build(&config.strategy, &setup.topology).map_err(SetupError::from)?;
        Self::begin_stage_run((strategy, None), config, setup, folder, config.stop, None, resources)
    }

    /// Goes on with a run from its last checkpoint.
    ///
    /// # Errors
    /// As [`resume`](super::resume).
    pub fn resume(folder: &Path, stop: Option<StopConditions>, resources: &Resources) -> Result<Self, TrainError> {
        let folder = RunFolder::open(folder)?;
        let config = folder.read_config()?;
        Self::resume_checked(folder, config, (stop, None), None, resources)
    }

    /// As [`begin`](Self::begin), from where a search is to begin, with the rules of a stage, and limits in place of those in the
    /// configuration.
    pub(crate) fn begin_stage_run(
        (strategy, champion): Search,
        config: &RunConfig,
        setup: Setup,
        folder: &Path,
        stop: StopConditions,
        promotion: Option<Arc<dyn Promotion>>,
        resources: &Resources,
    ) -> Result<Self, TrainError> {
        let evaluator = Arc::new(Parallel::new(resources.threads)?);
        let (folder, lock) = RunFolder::create(folder)?;
        let evolution = Evolution::new(strategy, Seed::of_run(config.seed), stop).with_label(config.label());
        let mut evolution = with_rules(evolution, promotion);
        if let Some(champion) = champion.filter(|_| setup.reference.is_some()) {
            evolution = evolution.with_candidate(champion);
        }
        // The configuration comes last: what is a run can be resumed, wherever it was killed.
        evolution.write_checkpoint(&folder.checkpoint()).map_err(FolderError::from)?;
        folder.write_config(config)?;
        let earlier = EarlierLines::check(&folder, config, &Progress::default(), None)?;
        Self::new(evolution, config.clone(), setup, (folder, lock), earlier, evaluator, resources)
    }

    /// As [`resume`](Self::resume), with the rules of a stage; `now` are the limits of this process, where they are other than those
    /// to be written down.
    pub(crate) fn resume_stage_run(
        folder: &Path,
        stop: StopConditions,
        now: StopConditions,
        promotion: Option<Arc<dyn Promotion>>,
        resources: &Resources,
    ) -> Result<Self, TrainError> {
        let folder = RunFolder::open(folder)?;
        let config = folder.read_config()?;
        Self::resume_checked(folder, config, (Some(stop), Some(now)), promotion, resources)
    }

    fn resume_checked(
        folder: RunFolder,
        mut config: RunConfig,
        (stop, now): (Option<StopConditions>, Option<StopConditions>),
        promotion: Option<Arc<dyn Promotion>>,
        resources: &Resources,
    ) -> Result<Self, TrainError> {
        let planned = config.stop;
        config.stop = stop.unwrap_or(planned);
        let setup = Setup::new(&config, &resources.registry)?;
        let evaluator = Arc::new(Parallel::new(resources.threads)?);
        if !folder.checkpoint().is_file() {
            return Err(FolderError::NotARun { path: folder.path().into(), missing: "checkpoint".into() }.into());
        }
        let lock = folder.lock()?;
        let entry = resources.registry.strategies.of(&config.strategy).map_err(SetupError::from)?;
        let checkpoint = entry.read_checkpoint(&folder.checkpoint()).map_err(FolderError::from)?;
        let foreign = |what| FolderError::Foreign { path: folder.checkpoint(), what };
        if checkpoint.seed != Seed::of_run(config.seed) {
            return Err(foreign("the seed").into());
        }
        if !checkpoint.strategy.has_settings(&config.strategy) {
            return Err(foreign("the strategy's settings").into());
        }
        if !checkpoint.strategy.fits(&setup.topology) {
            return Err(foreign("the nets that it searches").into());
        }
        if checkpoint.label != config.label() {
            return Err(foreign("its settings").into());
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
        let is_saved = checkpoint.last && !lacks_files(&folder, &config, &checkpoint);
        if let Some(reason) = is_over.filter(|_| promotion.is_none() && is_saved) {
            return Err(TrainError::Over { folder, reason, generations: checkpoint.progress.generations });
        }
        let earlier = EarlierLines::check(&folder, &config, &checkpoint.progress, best)?;
        let evolution = with_rules(Evolution::resume(checkpoint, now.unwrap_or(config.stop)), promotion);
        let training = Self::new(evolution, config, setup, (folder, lock), earlier, evaluator, resources)?;
        // By now the folder is known to be whole, and files of lines to be writable.
        if training.config.stop != planned {
            training.folder.write_config(&training.config)?;
        }
        Ok(training)
    }

    fn new(
        evolution: Evolution<AnyStrategy>,
        config: RunConfig,
        setup: Setup,
        (folder, lock): (RunFolder, FolderLock),
        earlier: EarlierLines,
        evaluator: Arc<Parallel>,
        resources: &Resources,
    ) -> Result<Self, TrainError> {
        let mut evolution = evolution.with_signal(resources.signal.clone());
        if let Some(reference) = &setup.reference {
            evolution = evolution.with_champion_selection(
                setup.re_evaluations(&config),
                ReferenceSelection::new(reference, config.origin.is_some(), evaluator.clone()),
            );
        }
        let recorder = Recorder::new(folder.clone(), lock, earlier)?;
        // The champion selection evaluates its candidates without rungs: all of them are promising.
        let evaluator = SuccessiveHalving::new(evaluator, setup.rungs());
        let began = config.stop.minutes.map(|_| Instant::now());
        Ok(Self { evolution, config, setup, folder, recorder, evaluator, began })
    }

    /// Where it writes.
    pub fn folder(&self) -> &RunFolder {
        &self.folder
    }

    /// What it has used so far.
    pub fn progress(&self) -> Progress {
        self.evolution.progress()
    }

    /// Does a generation, and writes it down; then `on_generation` is called. If it is over, nothing is done and the reason returned.
    ///
    /// # Errors
    /// If the run breaks off: what was saved before is whole.
    pub fn generation(
        &mut self,
        on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
    ) -> Result<Option<StopReason>, TrainError> {
        let evaluator = self.evaluator.clone();
        let (over, done) = self.generation_with(&evaluator, on_generation);
        done.map_err(|source| self.broke_off(source))?;
        Ok(over)
    }

    /// As [`generation`](Self::generation), with evaluations from elsewhere: as often as it [wants](Step::Wants) some, they are evaluated
    /// by a [`BatchEvaluator`](super::BatchEvaluator), given, and it is called again. What the run finds is the same.
    ///
    /// Candidates for the champion are judged here as ever.
    ///
    /// # Errors
    /// As [`generation`](Self::generation); and if the answers are not one for each net that was wanted.
    pub fn generation_by(
        &mut self,
        answers: &mut Answers,
        on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
    ) -> Result<Step, TrainError> {
        let (asked, wanted) = (Cell::new(0), RefCell::new(None));
        let rungs = self.evaluator.clone();
        let remembering = Remembering { answers, rungs: rungs.rungs(), asked, wanted };
        let (over, done) = self.generation_with(&rungs.with_inner(&remembering), on_generation);
        match (over, done, remembering.wanted.into_inner()) {
            (Some(reason), ..) => Ok(Step::Over(reason)),
            (_, Err(EvolutionError::EvaluationCount { .. }), Some(batch)) => Ok(Step::Wants(batch)),
            (_, Err(source), _) => Err(self.broke_off(source)),
            (_, Ok(()), _) => {
                answers.clear();
                Ok(Step::Done)
            }
        }
    }

    /// Does a generation, unless it is over: then the reason.
    fn generation_with(
        &mut self,
        evaluator: &impl Evaluator,
        on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
    ) -> (Option<StopReason>, Result<(), EvolutionError>) {
        let _span = tracing::debug_span!("run", folder = %self.folder.path().display()).entered();
        let elapsed = self.began.map_or(Duration::ZERO, |began| began.elapsed());
        if let Some(reason) = self.evolution.stop_reason(elapsed) {
            return (Some(reason), Ok(()));
        }
        let run = Recorded { config: &self.config, setup: &self.setup };
        let recording = Recording { recorder: &mut self.recorder, run, called: on_generation };
        let mut observers: [Box<dyn Observer<AnyStrategy> + '_>; 1] = [Box::new(recording)];
        (None, self.evolution.generation(&self.setup.task, evaluator, &mut observers).map(drop))
    }

    /// What its [batches](super::Batch) are evaluated by.
    pub fn config(&self) -> &RunConfig {
        &self.config
    }

    /// Does generation after generation until it is over, and saves.
    ///
    /// # Errors
    /// As [`generation`](Self::generation) and [`finish`](Self::finish).
    pub fn run(mut self, on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>)) -> Result<Outcome, TrainError> {
        loop {
            if let Some(reason) = self.generation(on_generation)? {
                return self.finish(reason);
            }
        }
    }

    /// Saves what there is. `reason`: that of [`generation`](Self::generation), or [`StopReason::Interrupted`] at any moment.
    ///
    /// # Errors
    /// If the folder cannot be written.
    pub fn finish(mut self, reason: StopReason) -> Result<Outcome, TrainError> {
        // Between two re-evaluations the champion file has the one that would be champion now. The checkpoint does not know of it,
        // so that the run goes on as if it had not been asked for.
        let champion = self.evolution.champion_if_re_evaluated().map_err(|source| self.broke_off(source))?;
        let run = Recorded { config: &self.config, setup: &self.setup };
        self.recorder.finish(run, &self.evolution, champion.as_ref())?;
        let champion = match self.recorder.has_champion() {
            true => Some(Champion::read(&self.folder.champion()).map_err(FolderError::from)?),
            false => None,
        };
        Ok(Outcome { folder: self.folder, reason, progress: self.evolution.progress(), champion })
    }

    fn broke_off(&self, source: EvolutionError) -> TrainError {
        let generation = source.generation().unwrap_or(self.evolution.progress().generations);
        TrainError::BrokeOff { generation, folder: self.folder.clone(), source }
    }
}

/// Whether a file that the last save had written is gone, damaged, or of another run.
fn lacks_files(folder: &RunFolder, config: &RunConfig, checkpoint: &Checkpoint<AnyStrategy>) -> bool {
    let has_champion = checkpoint.champion.is_some() || !checkpoint.candidates.is_empty();
    let lacks_champion = has_champion && !matches!(read_champion(folder, config), Ok(Some(_)));
    lacks_champion || (checkpoint.strategy.front().is_some() && !folder.front().is_file())
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
