//! The champion of a session, replayed in worlds that are not quite the one it learned in.

use crate::{
    protocol::RobustnessState,
    session::{Session, SessionError},
    work::{Job, Next},
};
use gambol_runs::robust::{Perturbations, PerturbedReplays, RobustnessError};
use std::sync::{Arc, Weak};

/// Begins to replay the champion, as `gambol robust` does, as long as a page looks.
///
/// # Errors
/// If it is being replayed, there is none, or there is nothing to do it with.
pub(crate) fn replay(session: &Arc<Session>, look: &Weak<()>) -> Result<(), Box<dyn std::error::Error>> {
    let is_under_way = |state: &RobustnessState| state.result.is_none() && state.problem.is_none();
    if session.robustness().as_ref().is_some_and(is_under_way) {
        return Err("the champion is being replayed".into());
    }
    let champion = session.champion().ok_or("there is no champion yet")?;
    let state = RobustnessState { generation: champion.generation, worlds: [0, 0], result: None, problem: None };
    session.set_robustness(state.clone());
    let job = Replaying { session: Arc::clone(session), look: look.clone(), state, replays: None };
    Ok(session.means().workers.start("robustness", Box::new(job)).map_err(SessionError::Thread)?)
}

struct Replaying {
    session: Arc<Session>,
    look: Weak<()>,
    state: RobustnessState,
    replays: Option<PerturbedReplays>,
}

impl Replaying {
    fn begin(&mut self) -> Result<Next, RobustnessError> {
        let Some(champion) = self.session.champion() else { return Ok(Next::Done) };
        let replays = PerturbedReplays::new(&champion, self.session.registry(), &Perturbations::default())?;
        (self.state.generation, self.state.worlds) = (champion.generation, replays.progress());
        self.replays = Some(replays);
        Ok(Next::Now)
    }
}

impl Job for Replaying {
    fn go_on(&mut self) -> Next {
        if self.look.strong_count() == 0 {
            return Next::Done;
        }
        let next = match self.replays.take() {
            None => self.begin().unwrap_or_else(|error| {
                self.state.problem = Some(error.to_string());
                Next::Done
            }),
            Some(mut replays) => {
                replays.go_on(PerturbedReplays::FEW);
                self.state.worlds = replays.progress();
                let [done, of] = self.state.worlds;
                if done < of {
                    self.replays = Some(replays);
                    Next::Now
                } else {
                    self.state.result = Some(replays.robustness().into());
                    Next::Done
                }
            }
        };
        self.session.set_robustness(self.state.clone());
        next
    }
}

impl Drop for Replaying {
    fn drop(&mut self) {
        // So that it can be asked for again.
        if self.state.result.is_none() && self.state.problem.is_none() {
            let problem = Some("the replays were broken off".to_owned());
            self.session.set_robustness(RobustnessState { problem, ..self.state.clone() });
        }
    }
}
