//! The training of a session, one generation after the other.

use crate::{
    protocol::RunState,
    session::{Session, SessionError},
    work::{Job, Next, PATIENCE},
};
use gambol_runs::{
    run::Run,
    run_folder::NewFolder,
    shaping::{PlannedStage, ShapingError, StageProgress},
    training::{Outcome, Resources},
};
use ne_core::{StopConditions, StopReason};
use std::sync::Arc;

/// How a training begins.
pub(crate) enum Plan {
    /// In a new folder.
    Begin(NewFolder),
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
    let job = TrainingJob { session: Arc::clone(session), plan: Some(plan), run: None, folder: None, has_ended: false };
    session.means().workers.start(&name, Box::new(job)).map_err(SessionError::Thread)
}

/// Lets it go on: from a pause, or from where it had ended, by so many generations more than it had planned.
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

/// Whatever becomes of it, the session hears of its end.
struct TrainingJob {
    session: Arc<Session>,
    plan: Option<Plan>,
    run: Option<Run>,
    /// Goes again if nothing came into it.
    folder: Option<NewFolder>,
    has_ended: bool,
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
            Plan::Begin(folder) => {
                self.folder = Some(folder);
                Run::begin(session.config(), path, resources)
            }
            Plan::Resume(stop) => Run::resume(path, stop, resources),
        }
    }

    /// Does a generation. The reason, if the run is over.
    fn generation(&mut self) -> Result<Option<StopReason>, ShapingError> {
        let Some(run) = &mut self.run else { return Ok(Some(StopReason::Interrupted)) };
        let session = &self.session;
        let mut on_stage_run = |planned: &PlannedStage, _: Option<&_>| session.see_stage(planned);
        run.generation(&mut StageProgress { on_stage_run: &mut on_stage_run }, &mut |generation| {
            session.see(generation)
        })
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
                Err(error) => self.break_off(&error),
            };
        }
        if self.session.waits() {
            return Next::After(PATIENCE);
        }
        let reason = match self.generation() {
            Ok(None) => return Next::Now,
            Ok(Some(reason)) => reason,
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
        if !self.has_ended {
            self.break_off(&"its training broke off");
        }
    }
}
