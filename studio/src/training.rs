//! The training of a session, one generation after the other.

use crate::{
    protocol::RunState,
    session::{Session, SessionError},
    work::{Job, Next, PATIENCE, Ticket},
};
use gambol_runs::{
    config::RunConfig,
    run::Run,
    run_folder::NewFolder,
    shaping::{PlannedStage, ShapingError, StageProgress},
    strategies::AnyStrategy,
    training::{Answers, BatchEvaluator, Outcome, Resources, Step, TrainError},
};
use ne_core::{Generation, StopConditions, StopReason};
use std::{path::PathBuf, sync::Arc};

/// How a training begins.
pub(crate) enum Plan {
    /// In a new folder, perhaps from what another run has learned.
    Begin {
        folder: NewFolder,
        /// The folder of that run.
        from: Option<PathBuf>,
    },
    /// Where it stopped, perhaps with other stop conditions.
    Resume(Option<StopConditions>),
}

/// Begins to train a session's run.
///
/// # Errors
/// If it is being trained, or there is nothing to train it with.
pub(crate) fn start(session: &Arc<Session>, plan: Plan) -> Result<(), SessionError> {
    session.begin()?;
    let name = format!("training of {}", session.name());
    let job = TrainingJob {
        session: Arc::clone(session),
        plan: Some(plan),
        run: None,
        folder: None,
        has_ended: false,
        answers: Answers::default(),
        offered: None,
        evaluator: None,
    };
    session.means().workers.start(&name, Box::new(job)).map_err(SessionError::Thread)
}

/// Lets it go on: from a pause, or from where it had ended, by so many generations more than it has done.
///
/// # Errors
/// As [`start`].
pub(crate) fn go_on(session: &Arc<Session>, generations: Option<u64>) -> Result<(), SessionError> {
    if session.is_training() {
        session.release();
        return Ok(());
    }
    start(session, Plan::Resume(generations.map(|more| session.longer_by(more))))
}

/// Whether a training goes on.
enum Going {
    On,
    Over(StopReason),
}

/// Whatever becomes of it, the session hears of its end.
struct TrainingJob {
    session: Arc<Session>,
    plan: Option<Plan>,
    run: Option<Run>,
    /// Goes again if nothing came into it.
    folder: Option<NewFolder>,
    has_ended: bool,
    /// What helpers have evaluated of the generation under way.
    answers: Answers,
    /// What they evaluate now.
    offered: Option<Ticket>,
    /// Evaluates what is left by helpers, and the configuration that it is for.
    evaluator: Option<(RunConfig, BatchEvaluator)>,
}

impl TrainingJob {
    fn begin(&mut self, plan: Plan) -> Result<Run, ShapingError> {
        let session = &self.session;
        let resources = Resources {
            threads: session.means().threads,
            registry: session.registry().clone(),
            signal: session.signal(),
        };
        let path = session.folder().path();
        match plan {
            Plan::Begin { folder, from } => {
                self.folder = Some(folder);
                match from {
                    Some(from) => Run::begin_from(session.config(), &from, path, &resources),
                    None => Run::begin(session.config(), path, resources),
                }
            }
            Plan::Resume(stop) => Run::resume(path, stop, resources),
        }
    }

    /// Does a generation, with helpers a part of one.
    fn generation(&mut self) -> Result<Going, ShapingError> {
        let Some(run) = &mut self.run else { return Ok(Going::Over(StopReason::Interrupted)) };
        let session = &self.session;
        let mut on_stage_run = |planned: &PlannedStage, _: Option<&_>| session.see_stage(planned);
        let mut stage_progress = StageProgress { on_stage_run: &mut on_stage_run };
        let mut on_generation = |generation: &Generation<'_, AnyStrategy>| session.see(generation);
        let helpers = session.means().helpers.as_ref();
        // A generation that was begun with helpers is brought to its end with their answers.
        let Some(helpers) = helpers.filter(|helpers| helpers.are_there() || self.answers.are_there()) else {
            let over = run.generation(&mut stage_progress, &mut on_generation)?;
            return Ok(over.map_or(Going::On, Going::Over));
        };
        match run.generation_by(&mut self.answers, &mut stage_progress, &mut on_generation)? {
            Step::Done => Ok(Going::On),
            Step::Over(reason) => Ok(Going::Over(reason)),
            Step::Wants(batch) => {
                self.offered = run.stage_config().map(|config| helpers.offer(config, batch));
                Ok(Going::On)
            }
        }
    }

    /// Collects what was offered, or evaluates a piece of it.
    fn help(&mut self, ticket: Ticket) -> Result<Next, ShapingError> {
        let Some(helpers) = self.session.means().helpers.clone() else { return Ok(Next::Now) };
        if let Some(evaluations) = helpers.collect(ticket) {
            self.answers.give(evaluations);
            self.offered = None;
            return Ok(Next::Now);
        }
        let Some((piece, batch)) = helpers.take(ticket) else { return Ok(Next::After(PATIENCE)) };
        let Some(config) = self.run.as_ref().and_then(Run::stage_config) else { return Ok(Next::Now) };
        let (of, evaluator) = match self.evaluator.take().filter(|(of, _)| of == config) {
            Some(known) => known,
            None => (config.clone(), BatchEvaluator::new(config, self.session.registry()).map_err(TrainError::from)?),
        };
        helpers.give(ticket, piece, evaluator.evaluate(batch));
        self.evaluator = Some((of, evaluator));
        Ok(Next::Now)
    }

    fn finish(&mut self, reason: StopReason) -> Result<(), Box<dyn std::error::Error>> {
        let Some(run) = self.run.take() else { return Ok(()) };
        let Outcome { folder, reason, .. } = run.finish(reason)?;
        if self.session.means().writes_reports {
            let reason = Some(reason).filter(|reason| *reason != StopReason::Interrupted);
            gambol_reports::report::write_report(&folder, self.session.registry(), reason)?;
        }
        Ok(())
    }

    fn end(&mut self, state: RunState) -> Next {
        self.has_ended = true;
        self.folder = None;
        self.session.end(state);
        Next::Done
    }

    fn break_off(&mut self, error: &dyn std::fmt::Display) -> Next {
        // What is saved can be resumed.
        self.run = None;
        self.end(RunState::Broken { reason: error.to_string() })
    }
}

impl Job for TrainingJob {
    fn go_on(&mut self) -> Next {
        if let Some(plan) = self.plan.take() {
            return match self.begin(plan) {
                Ok(run) => {
                    self.run = Some(run);
                    Next::Now
                }
                // There was nothing left to do.
                Err(ShapingError::Train(TrainError::Over { reason, .. })) => {
                    self.end(RunState::Ended { reason: reason.to_string() })
                }
                Err(error) => self.break_off(&error),
            };
        }
        if let Some(ticket) = self.offered {
            return self.help(ticket).unwrap_or_else(|error| self.break_off(&error));
        }
        // Between two batches of a generation is no place to wait.
        if !self.answers.are_there() && self.session.waits() {
            return Next::After(PATIENCE);
        }
        let reason = match self.generation() {
            Ok(Going::On) => return Next::Now,
            Ok(Going::Over(reason)) => reason,
            Err(error) => return self.break_off(&error),
        };
        match self.finish(reason) {
            Ok(()) => self.end(RunState::Ended { reason: reason.to_string() }),
            Err(error) => self.break_off(&error),
        }
    }
}

impl Drop for TrainingJob {
    fn drop(&mut self) {
        if let (Some(ticket), Some(helpers)) = (self.offered, &self.session.means().helpers) {
            helpers.withdraw(ticket);
        }
        if !self.has_ended {
            self.break_off(&"its training broke off");
        }
    }
}
