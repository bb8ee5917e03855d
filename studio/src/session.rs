//! One run: trained here, or opened from its folder.

use crate::{
    population::{Population, Told},
    protocol::{Opened, RobustnessState, RunState, Verdict},
    work::{Helpers, Workers},
};
use gambol_runs::{
    Registry,
    champion::Champion,
    config::RunConfig,
    run_folder::{FolderError, RunFolder},
    shaping::{self, PlannedStage},
    strategies::AnyStrategy,
    texts::shell_word,
};
use ne_core::{Generation, GenerationReport, StopConditions, StopSignal, promotion::Decision};
use std::{
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak},
    time::SystemTime,
};

/// What the sessions of a studio have in common.
#[derive(Clone)]
pub struct Means {
    /// Who trains and judges.
    pub workers: Arc<dyn Workers>,
    /// Who helps with evaluations, where threads cannot.
    pub helpers: Option<Arc<dyn Helpers>>,
    /// Threads of each training; 0: one for each core.
    pub threads: usize,
    /// Whether a run that has ended gets its report at once, and not only when it is asked for.
    pub writes_reports: bool,
}

/// A run, trained here or not, and what pages see of it.
pub struct Session {
    name: String,
    folder: RunFolder,
    config: RunConfig,
    command: String,
    unit: String,
    registry: Registry,
    means: Means,
    inner: Mutex<Inner>,
    /// Told when it has ended.
    ended: Condvar,
}

/// How a run goes on after a generation.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pace {
    Free,
    /// After so many generations it waits.
    Steps(u64),
}

struct Inner {
    state: RunState,
    signal: StopSignal,
    pace: Pace,
    rows: Vec<GenerationReport>,
    /// The name of each stage, and the row before which it began.
    stages: Vec<(usize, String)>,
    /// The configuration of the stage under way.
    stage_config: RunConfig,
    generation: Option<Arc<Told>>,
    verdict: Option<Verdict>,
    robustness: Option<RobustnessState>,
    /// Whether something judges its champions, and who looks at it.
    is_judged: bool,
    looks: Vec<Weak<()>>,
    /// Whether the stage that comes first has begun before.
    resumes_stage: bool,
    /// When the log of a run that is trained elsewhere was last read.
    read: Option<SystemTime>,
}

/// Why a run cannot be opened or begun here.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The folder cannot be read.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// Its configuration cannot be built.
    #[error("{0}")]
    Setup(String),
    /// It is trained here already.
    #[error("the run is under way")]
    Running,
    /// There is no room for another thread.
    #[error("no thread can be started: {0}")]
    Thread(std::io::Error),
}

impl Session {
    /// Opens a run, as it stands in its folder.
    pub(crate) fn open(
        name: String,
        folder: RunFolder,
        registry: Registry,
        means: Means,
    ) -> Result<Arc<Self>, SessionError> {
        let config = folder.read_config()?;
        let command = format!("{} resume {}", gambol_runs::program_name(), shell_word(folder.path()));
        let session = Self::new(name, folder, config, command, registry, means)?;
        session.read_folder()?;
        Ok(session)
    }

    /// A run that is not trained yet.
    pub(crate) fn new(
        name: String,
        folder: RunFolder,
        config: RunConfig,
        command: String,
        registry: Registry,
        means: Means,
    ) -> Result<Arc<Self>, SessionError> {
        let movement = registry.movements.build(&config.movement);
        let unit = movement.map_err(|error| SessionError::Setup(error.to_string()))?.unit().to_owned();
        let inner = Inner {
            state: saved(0),
            signal: StopSignal::default(),
            pace: Pace::Free,
            rows: Vec::new(),
            stages: Vec::new(),
            stage_config: RunConfig { stages: Vec::new(), ..config.clone() },
            generation: None,
            verdict: None,
            robustness: None,
            is_judged: false,
            looks: Vec::new(),
            resumes_stage: false,
            read: None,
        };
        let (inner, ended) = (Mutex::new(inner), Condvar::new());
        Ok(Arc::new(Self { name, folder, config, command, unit, registry, means, inner, ended }))
    }

    /// The name of its folder.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where it is.
    pub fn folder(&self) -> &RunFolder {
        &self.folder
    }

    /// How it stands.
    pub fn state(&self) -> RunState {
        self.inner().state.clone()
    }

    /// Whether it is trained here, be it that it waits.
    pub fn is_training(&self) -> bool {
        matches!(self.inner().state, RunState::Running | RunState::Paused)
    }

    /// What a page is told first.
    pub fn opened(&self) -> Opened {
        let (run, config, unit) = (self.name.clone(), self.config.clone(), self.unit.clone());
        Opened { run, config, unit, command: self.command.clone(), state: self.state() }
    }

    /// The rows of its history from one on, and the stages that began since another.
    pub(crate) fn since(&self, row: usize, stage: usize) -> (Vec<GenerationReport>, Vec<(usize, String)>) {
        let inner = self.inner();
        let tail = |rows: &[GenerationReport]| rows.get(row..).unwrap_or_default().to_vec();
        (tail(&inner.rows), inner.stages.get(stage..).unwrap_or_default().to_vec())
    }

    /// The verdict on the latest champion that was judged.
    pub(crate) fn verdict(&self) -> Option<Verdict> {
        self.inner().verdict.clone()
    }

    /// The champion in its folder.
    pub(crate) fn champion(&self) -> Option<Champion> {
        Champion::read(&self.folder.champion()).ok()
    }

    /// The latest generation; of a run that was opened the latest that its gallery has.
    pub(crate) fn population(&self) -> Option<Population> {
        let (told, config) = {
            let inner = self.inner();
            (inner.generation.clone(), inner.stage_config.clone())
        };
        match told {
            Some(told) => Some(Population::of(told, config)),
            None => {
                let (folder, config) = self.latest_stage()?;
                Population::read(&folder, config)
            }
        }
    }

    /// The folder and configuration of the latest stage; of a run without stages its own.
    fn latest_stage(&self) -> Option<(RunFolder, RunConfig)> {
        if self.config.stages.is_empty() {
            return Some((self.folder.clone(), self.config.clone()));
        }
        let last = shaping::stage_runs(&self.folder).ok()?.pop()?;
        let folder = RunFolder::at(&last.folder);
        let config = folder.read_config().ok()?;
        Some((folder, config))
    }

    /// Lets it wait before the next generation.
    pub fn pause(&self) {
        self.set_pace(Pace::Steps(0));
    }

    /// Lets one generation pass, then wait.
    pub fn step(&self) {
        self.set_pace(Pace::Steps(1));
    }

    /// Lets it go on from a pause.
    pub(crate) fn release(&self) {
        self.set_pace(Pace::Free);
    }

    /// Stop conditions by which it does so many generations more than it has done.
    pub(crate) fn longer_by(&self, generations: u64) -> StopConditions {
        let done = self.inner().rows.len() as u64;
        let generations = Some(done.saturating_add(generations));
        self.config.stop.resumed_with(StopConditions { generations, ..StopConditions::default() })
    }

    /// Saves and ends it.
    pub fn stop(&self) {
        self.inner().signal.stop();
        self.means.workers.wake();
    }

    /// Waits until its training has ended.
    pub fn join(&self) {
        let mut inner = self.inner();
        while matches!(inner.state, RunState::Running | RunState::Paused) {
            inner = self.ended.wait(inner).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn set_pace(&self, pace: Pace) {
        {
            let mut inner = self.inner();
            inner.pace = pace;
            // So that a page hears of each step, however soon it is done.
            if inner.state == RunState::Paused && pace != Pace::Steps(0) {
                inner.state = RunState::Running;
            }
        }
        self.means.workers.wake();
    }

    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads what another process has written since.
    pub(crate) fn refresh(&self) {
        if self.is_training() {
            return;
        }
        let changed = self.latest_stage().and_then(|(folder, _)| std::fs::metadata(folder.log()).ok()?.modified().ok());
        if changed.is_some() && changed != self.inner().read {
            // What is half written is read the next time.
            let _ = self.read_folder();
        }
    }

    fn read_folder(&self) -> Result<(), FolderError> {
        let (mut rows, mut stages) = (Vec::new(), Vec::new());
        let read = self.latest_stage().and_then(|(folder, _)| std::fs::metadata(folder.log()).ok()?.modified().ok());
        if self.config.stages.is_empty() {
            rows = self.folder.read_log()?;
        } else {
            for stage_run in shaping::stage_runs(&self.folder)? {
                stages.push((rows.len(), stage_run.name.clone()));
                rows.extend(RunFolder::at(&stage_run.folder).read_log()?);
            }
        }
        let latest = self.latest_stage();
        let mut inner = self.inner();
        // What ended here says why; of what another process trains it is said how far it is.
        let is_from_elsewhere = inner.state == saved(inner.rows.len());
        (inner.rows, inner.stages, inner.read) = (rows, stages, read);
        if let Some((_, config)) = latest {
            inner.stage_config = config;
        }
        if is_from_elsewhere {
            inner.state = saved(inner.rows.len());
        }
        Ok(())
    }

    /// Its training begins.
    pub(crate) fn begin(&self) -> Result<(), SessionError> {
        let latest = shaping::stage_runs(&self.folder).ok().and_then(|mut stage_runs| stage_runs.pop());
        let mut inner = self.inner();
        if matches!(inner.state, RunState::Running | RunState::Paused) {
            return Err(SessionError::Running);
        }
        (inner.state, inner.pace, inner.signal) = (RunState::Running, Pace::Free, StopSignal::default());
        inner.resumes_stage = latest.is_some_and(|stage_run| stage_run.decision == Decision::Stay);
        Ok(())
    }

    pub(crate) fn config(&self) -> &RunConfig {
        &self.config
    }

    pub(crate) fn registry(&self) -> &Registry {
        &self.registry
    }

    pub(crate) fn means(&self) -> &Means {
        &self.means
    }

    pub(crate) fn signal(&self) -> StopSignal {
        self.inner().signal.clone()
    }

    /// Whether its training is to wait.
    pub(crate) fn waits(&self) -> bool {
        let mut inner = self.inner();
        let waits = inner.pace == Pace::Steps(0) && !inner.signal.is_set();
        inner.state = if waits { RunState::Paused } else { RunState::Running };
        waits
    }

    /// Its training has ended.
    pub(crate) fn end(&self, state: RunState) {
        self.inner().state = state;
        self.ended.notify_all();
    }

    /// Notes that a stage begins, or is taken up again.
    pub(crate) fn see_stage(&self, planned: &PlannedStage) {
        let mut inner = self.inner();
        let row = inner.rows.len();
        // A stage may be tried again: the name does not tell.
        if !std::mem::take(&mut inner.resumes_stage) {
            inner.stages.push((row, planned.name.clone()));
        }
        inner.stage_config = planned.config.clone();
        inner.generation = None;
    }

    /// Notes a generation.
    pub(crate) fn see(&self, generation: &Generation<'_, AnyStrategy>) {
        let number = generation.report.generation;
        let before = self.inner().generation.clone();
        let told = Told::new(generation, before.as_deref());
        let mut inner = self.inner();
        // One that is resumed does its last generations again.
        let first = inner.stages.last().map_or(0, |stage| stage.0);
        let place = usize::try_from(number - 1).unwrap_or(usize::MAX).saturating_add(first);
        inner.rows.truncate(place);
        inner.rows.push(generation.report.clone());
        inner.generation = Some(Arc::new(told));
        if let Pace::Steps(steps) = &mut inner.pace {
            *steps = steps.saturating_sub(1);
        }
    }

    /// Its champions are to be judged as long as this looks; `false`: they are already.
    pub(crate) fn begin_judging(&self, look: Weak<()>) -> bool {
        let mut inner = self.inner();
        inner.looks.push(look);
        !std::mem::replace(&mut inner.is_judged, true)
    }

    /// Whether a page still looks; if none does, nothing judges it any more.
    pub(crate) fn is_looked_at(&self) -> bool {
        let mut inner = self.inner();
        inner.looks.retain(|look| look.strong_count() > 0);
        inner.is_judged = !inner.looks.is_empty();
        inner.is_judged
    }

    /// Nothing judges it any more.
    pub(crate) fn end_judging(&self) {
        self.inner().is_judged = false;
    }

    pub(crate) fn set_verdict(&self, verdict: Verdict) {
        self.inner().verdict = Some(verdict);
    }

    /// How far its champion was replayed in other worlds; `None`: nothing was asked for.
    pub(crate) fn robustness(&self) -> Option<RobustnessState> {
        self.inner().robustness.clone()
    }

    pub(crate) fn set_robustness(&self, state: RobustnessState) {
        self.inner().robustness = Some(state);
    }
}

/// A run that is not trained here.
fn saved(generations: usize) -> RunState {
    RunState::Ended { reason: format!("saved, after {generations} generations") }
}
