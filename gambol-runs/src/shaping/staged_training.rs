use super::{
    Beginning, Curriculum, PlannedStage, ShapingError, StageProgress, StageRun, Stages,
    source::Source,
    stage_progress::of_the_run,
    stage_runs::{keep_champion, stage_run, total},
    transfer::{PreparedTransfer, TransferOptions},
};
use crate::{
    champion::Champion,
    config::{Origin, RunConfig, Transferred},
    episode_parts::SetupError,
    recorder::check_lines,
    run_folder::{FolderError, FolderLock, RunFolder},
    setup::Setup,
    strategies::AnyStrategy,
    training::{Answers, Outcome, Resources, Step, TrainError, Training},
};
use ne_core::{Generation, Progress, StopConditions, StopReason, promotion::Decision};
use std::{
    path::Path,
    time::{Duration, Instant},
};

/// A run with stages under way, which does one generation at a time, as a [`Training`] does for one without.
pub struct StagedTraining<C> {
    curriculum: C,
    config: RunConfig,
    folder: RunFolder,
    resources: Resources,
    began: Instant,
    /// Those that are over.
    stage_runs: Vec<StageRun>,
    /// Why no further stage begins: the stage just passed had reached the target or the tier.
    reached: Option<StopReason>,
    current: Option<Current>,
    /// Whether the folder's configuration has other stop conditions still: it is written once the stages are known to be whole.
    has_new_stop: bool,
    _lock: FolderLock,
}

/// The stage run under way.
struct Current {
    number: usize,
    planned: PlannedStage,
    training: Training,
}

/// What comes next.
enum Next {
    Stage(Box<Current>),
    End(StopReason),
}

impl StagedTraining<Stages> {
    /// Begins a run with stages in a new folder.
    ///
    /// # Errors
    /// As [`train_stages`](super::train_stages).
    pub fn begin(config: &RunConfig, folder: &Path, resources: Resources) -> Result<Self, ShapingError> {
        let stages = Stages::listed(config, &resources.registry)?;
        Self::begin_curriculum(stages, config, folder, resources)
    }

    /// Goes on with a run with stages from where it stopped.
    ///
    /// # Errors
    /// As [`resume_stages`](super::resume_stages).
    pub fn resume(folder: &Path, stop: Option<StopConditions>, resources: Resources) -> Result<Self, ShapingError> {
        let folder = RunFolder::open(folder)?;
        let mut config = folder.read_config()?;
        config.stop = stop.unwrap_or(config.stop);
        let stages = Stages::listed(&config, &resources.registry)?;
        Self::resume_curriculum(stages, &folder, stop, resources)
    }
}

impl<C: Curriculum> StagedTraining<C> {
    /// As [`begin`](StagedTraining::begin), with a curriculum of your own.
    ///
    /// # Errors
    /// As [`train_curriculum`](super::train_curriculum).
    pub fn begin_curriculum(
        curriculum: C,
        config: &RunConfig,
        folder: &Path,
        resources: Resources,
    ) -> Result<Self, ShapingError> {
        let (folder, lock) = RunFolder::create(folder)?;
        folder.write_config(config)?;
        Ok(Self::new(curriculum, config.clone(), folder, lock, resources))
    }

    /// As [`resume`](StagedTraining::resume), with a curriculum of your own.
    ///
    /// # Errors
    /// As [`resume_curriculum`](super::resume_curriculum).
    pub fn resume_curriculum(
        curriculum: C,
        folder: &RunFolder,
        stop: Option<StopConditions>,
        resources: Resources,
    ) -> Result<Self, ShapingError> {
        let lock = folder.lock()?;
        let mut config = folder.read_config()?;
        let planned = config.stop;
        config.stop = stop.unwrap_or(planned);
        config.stop.validate().map_err(|error| TrainError::from(SetupError::from(error.within("stop"))))?;
        let has_new_stop = config.stop != planned;
        Ok(Self { has_new_stop, ..Self::new(curriculum, config, folder.clone(), lock, resources) })
    }

    fn new(curriculum: C, config: RunConfig, folder: RunFolder, _lock: FolderLock, resources: Resources) -> Self {
        let began = Instant::now();
        let stage_runs = Vec::new();
        let (reached, current) = (None, None);
        Self { curriculum, config, folder, resources, began, stage_runs, reached, current, has_new_stop: false, _lock }
    }

    /// Where it writes.
    pub fn folder(&self) -> &RunFolder {
        &self.folder
    }

    /// Does a generation of the stage under way, or ends a stage, or begins the next. If the run is over, the reason is returned.
    ///
    /// # Errors
    /// If the run breaks off, or the next stage cannot be begun.
    pub fn generation(
        &mut self,
        stage_progress: &mut StageProgress<'_>,
        on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
    ) -> Result<Option<StopReason>, ShapingError> {
        let generation =
            |training: &mut Training| Ok(training.generation(&mut *on_generation)?.map_or(Step::Done, Step::Over));
        match self.step(stage_progress, generation)? {
            Step::Over(reason) => Ok(Some(reason)),
            _ => Ok(None),
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
        self.step(stage_progress, |training| training.generation_by(answers, &mut *on_generation))
    }

    fn step(
        &mut self,
        stage_progress: &mut StageProgress<'_>,
        generation: impl FnOnce(&mut Training) -> Result<Step, TrainError>,
    ) -> Result<Step, ShapingError> {
        let Some(current) = &mut self.current else {
            let next = self.next(stage_progress)?;
            if std::mem::take(&mut self.has_new_stop) {
                self.folder.write_config(&self.config)?;
            }
            return Ok(match next {
                Next::Stage(current) => {
                    self.current = Some(*current);
                    Step::Done
                }
                Next::End(reason) => Step::Over(reason),
            });
        };
        match generation(&mut current.training).map_err(|error| self.of_the_run(error.into()))? {
            Step::Over(reason) => Ok(if self.end_stage_run(reason)? { Step::Done } else { Step::Over(reason) }),
            step => Ok(step),
        }
    }

    /// What its [batches](crate::training::Batch) are evaluated by: the configuration of the stage under way.
    pub fn stage_config(&self) -> Option<&RunConfig> {
        self.current.as_ref().map(|current| current.training.config())
    }

    /// Does generation after generation until it is over, and saves.
    ///
    /// # Errors
    /// As [`generation`](Self::generation) and [`finish`](Self::finish).
    pub fn run(
        mut self,
        mut stage_progress: StageProgress<'_>,
        on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
    ) -> Result<Outcome, ShapingError> {
        loop {
            if let Some(reason) = self.generation(&mut stage_progress, on_generation)? {
                return self.finish(reason);
            }
        }
    }

    /// Saves what there is. `reason`: that of [`generation`](Self::generation), or [`StopReason::Interrupted`] at any moment.
    ///
    /// # Errors
    /// If the folder cannot be written.
    pub fn finish(mut self, reason: StopReason) -> Result<Outcome, ShapingError> {
        self.end_stage_run(reason)?;
        keep_champion(&self.folder, &self.stage_runs)?;
        let path = self.folder.champion();
        let champion = path.is_file().then(|| Champion::read(&path)).transpose().map_err(FolderError::from)?;
        Ok(Outcome { progress: total(&self.stage_runs), folder: self.folder, reason, champion })
    }

    /// Saves the stage run under way, if there is one. Whether another stage comes after it.
    fn end_stage_run(&mut self, reason: StopReason) -> Result<bool, ShapingError> {
        let Some(Current { number, planned, training }) = self.current.take() else { return Ok(false) };
        let stage_folder = training.folder().clone();
        training.finish(reason).map_err(|error| self.of_the_run(error.into()))?;
        let passed = stage_run(&stage_folder, number, planned.stage, &planned.name)?;
        let goes_on = passed.decision != Decision::Stay;
        self.leave(&planned, passed);
        keep_champion(&self.folder, &self.stage_runs)?;
        Ok(goes_on)
    }

    /// Adds a stage run that is over to the others, and notes whether it has reached what the run is for.
    fn leave(&mut self, planned: &PlannedStage, stage_run: StageRun) {
        let StopConditions { target, tier, .. } = self.config.stop;
        let goal = StopConditions { target, tier, ..StopConditions::default() };
        let reached = goal.reached(&stage_run.progress, stage_run.champion, Duration::ZERO);
        self.reached = reached.filter(|_| planned.is_goal);
        self.stage_runs.push(stage_run);
    }

    /// Goes past the stages that are over, and begins the next, or takes it up again.
    fn next(&mut self, stage_progress: &mut StageProgress<'_>) -> Result<Next, ShapingError> {
        while let Some(planned) = self.curriculum.next(&self.stage_runs) {
            let number = self.stage_runs.len() + 1;
            let path = self.folder.stages().join(format!("{number:02}-{}", planned.name));
            let stage_folder = RunFolder::at(&path);
            let is_begun = stage_folder.is_begun();
            if is_begun {
                stage_folder.check_run(&self.config_of(&planned, self.config.stop))?;
            }
            let begun = || stage_run(&stage_folder, number, planned.stage, &planned.name);
            if is_begun && stage_folder.read_standing()?.decision != Decision::Stay {
                check_lines(&stage_folder, &stage_folder.read_config()?)?;
                let passed = begun()?;
                self.leave(&planned, passed);
                continue;
            }
            // A stage that this run had begun under another target goes on.
            if let Some(reason) = self.reached.filter(|_| !is_begun) {
                return Ok(Next::End(reason));
            }
            let stop = limits(self.config.stop, total(&self.stage_runs), &planned);
            if let Some(reason) = exhausted(stop) {
                if is_begun {
                    self.stage_runs.push(begun()?);
                }
                return Ok(Next::End(reason));
            }
            // The process may have been killed before it came to that.
            let latest = is_begun.then(begun).transpose()?;
            keep_champion(&self.folder, self.stage_runs.iter().chain(&latest))?;
            let training = self.take_up(&planned, &stage_folder, stop, is_begun, stage_progress);
            let training = training.map_err(|error| self.of_the_run(error))?;
            return Ok(Next::Stage(Box::new(Current { number, planned, training })));
        }
        Ok(Next::End(self.reached.unwrap_or(StopReason::Promoted)))
    }

    fn take_up(
        &self,
        planned: &PlannedStage,
        stage_folder: &RunFolder,
        stop: StopConditions,
        is_begun: bool,
        stage_progress: &mut StageProgress<'_>,
    ) -> Result<Training, ShapingError> {
        let config = &self.config;
        let left = |minutes: f64| (minutes - self.began.elapsed().as_secs_f64() / 60.0).max(1e-6);
        let now = StopConditions { minutes: config.stop.minutes.map(left), ..stop };
        let path = stage_folder.path();
        let stage_config = self.config_of(planned, stop);
        if is_begun {
            (stage_progress.on_stage_run)(planned, stage_folder.read_config()?.origin.as_ref());
            let promotion = planned.promotion.clone();
            return Ok(Training::resume_stage_run(path, stop, now, promotion, &self.resources)?);
        }
        let before = match planned.begins {
            Beginning::Before => self.stage_runs.last(),
            Beginning::After(number) => self.stage_runs.iter().find(|stage_run| stage_run.number == number),
            Beginning::Nothing => None,
        };
        begin(planned, stage_config, path, before, now, &mut *stage_progress.on_stage_run, &self.resources)
    }

    /// The configuration of the next stage run, without what is transferred to it.
    fn config_of(&self, planned: &PlannedStage, stop: StopConditions) -> RunConfig {
        RunConfig {
            seed: self.config.seed.wrapping_add(SEED_STEP * self.stage_runs.len() as u64),
            stop,
            record: self.config.record.clone(),
            stages: Vec::new(),
            ..planned.config.clone()
        }
    }

    fn of_the_run(&self, error: ShapingError) -> ShapingError {
        of_the_run(error, &self.folder, total(&self.stage_runs))
    }
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
    resources: &Resources,
) -> Result<Training, ShapingError> {
    // Without a checkpoint nothing in it is of this run; but it may be somebody's.
    if !RunFolder::set_aside(path)? {
        return Err(FolderError::Busy { path: path.into() }.into());
    }
    let Some(before) = before else {
        let setup = Setup::new(&config, &resources.registry).map_err(TrainError::from)?;
        on_stage_run(planned, None);
        let strategies = &resources.registry.strategies;
        let strategy = strategies
            .build(&config.strategy, &setup.topology)
            .map_err(|error| TrainError::from(SetupError::from(error)))?;
        let promotion = planned.promotion.clone();
        return Ok(Training::begin_stage_run((strategy, None), &config, setup, path, now, promotion, resources)?);
    };
    // Named as the folders lie beside each other, so that a run may be moved.
    let name = before.folder.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let source = Source::run(name, RunFolder::open(&before.folder)?, &resources.registry)?;
    // A search that has nothing to transfer is no reason to end a run: its champion goes on, as the folder's origin says.
    let transferred = match planned.transfer {
        Some(Transferred::Population) if source.has_nothing_to_transfer()? => None,
        transferred => transferred,
    };
    let how = TransferOptions { transferred, allow_loss: planned.allow_loss };
    let departure = PreparedTransfer::prepare(source, &config, how, &resources.registry)?;
    let config = departure.config.clone();
    on_stage_run(planned, config.origin.as_ref());
    let strategies = &resources.registry.strategies;
    let search = (departure.search(strategies)?, departure.champion(strategies)?);
    let promotion = planned.promotion.clone();
    Ok(Training::begin_stage_run(search, &config, departure.setup, path, now, promotion, resources)?)
}

/// The limits of a stage run: what is left of the budgets. A fitness or a tier ends the run only in a stage that learns what the run is
/// for, and stagnation in one without a rule of its own.
fn limits(stop: StopConditions, used: Progress, planned: &PlannedStage) -> StopConditions {
    let left = |limit: Option<u64>, used: u64| limit.map(|limit| limit.saturating_sub(used));
    StopConditions {
        generations: left(stop.generations, used.generations),
        evaluations: left(stop.evaluations, used.evaluations),
        steps: left(stop.steps, used.steps),
        minutes: stop.minutes,
        target: stop.target.filter(|_| planned.is_goal),
        tier: stop.tier.filter(|_| planned.is_goal),
        stagnation: stop.stagnation.filter(|_| planned.promotion.is_none()),
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
