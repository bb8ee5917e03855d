//! The champions of a session, judged one after the other.

use crate::{
    protocol::Verdict,
    session::Session,
    work::{Job, Next, PATIENCE, Ticket},
};
use gambol_runs::champion::Champion;
use std::{
    sync::{Arc, Weak},
    time::{Duration, Instant, SystemTime},
};

/// Judges each new champion of a session from now on, as long as this or another page looks.
pub(crate) fn judge_champions(session: &Arc<Session>, look: &Weak<()>) {
    if !session.begin_judging(look.clone()) {
        return;
    }
    let judging = Box::new(Judging {
        session: Arc::clone(session),
        judged: None,
        asked: None,
        has_waited: false,
        is_over: false,
    });
    if let Err(error) = session.means().workers.start("judge", judging) {
        tracing::warn!(%error, "no gait is judged");
    }
}

struct Judging {
    session: Arc<Session>,
    /// When the champion file was written that was judged last.
    judged: Option<SystemTime>,
    /// What a helper judges.
    asked: Option<Ticket>,
    /// Whether helpers had time to come.
    has_waited: bool,
    /// Whether the session knows that it has ended.
    is_over: bool,
}

/// Judging takes at most this share of one core.
const SHARE: u32 = 20;

/// Where there can be helpers, they come after the first picture, which a verdict is not to hold up.
const UNTIL_HELPERS_COME: Duration = Duration::from_secs(1);

impl Judging {
    /// Judges it here, or has it judged by a helper.
    fn judge(&mut self, champion: &Champion) {
        match self.session.means().helpers.as_ref().filter(|helpers| helpers.are_there()) {
            Some(helpers) => self.asked = Some(helpers.judge(champion)),
            None => self.session.set_verdict(Verdict::of(champion, self.session.registry())),
        }
    }

    /// Whether a helper is still at it.
    fn is_asked(&mut self) -> bool {
        let (Some(ticket), Some(helpers)) = (self.asked, &self.session.means().helpers) else { return false };
        if !helpers.are_there() {
            // It is judged again, here.
            helpers.withdraw(ticket);
            (self.asked, self.judged) = (None, None);
            return false;
        }
        let Some(verdict) = helpers.verdict(ticket) else { return true };
        self.session.set_verdict(verdict);
        self.asked = None;
        false
    }
}

impl Job for Judging {
    fn go_on(&mut self) -> Next {
        if !self.session.is_looked_at() {
            self.is_over = true;
            return Next::Done;
        }
        if self.is_asked() {
            return Next::After(PATIENCE);
        }
        let must_wait = self.session.means().helpers.as_ref().is_some_and(|helpers| !helpers.are_there());
        if !std::mem::replace(&mut self.has_waited, true) && must_wait {
            return Next::After(UNTIL_HELPERS_COME);
        }
        let changed = std::fs::metadata(self.session.folder().champion()).and_then(|file| file.modified()).ok();
        let began = Instant::now();
        if changed.is_some() && changed != self.judged {
            self.judged = changed;
            if let Some(champion) = self.session.champion() {
                self.judge(&champion);
            }
        }
        Next::After((began.elapsed() * SHARE).max(PATIENCE))
    }
}

impl Drop for Judging {
    fn drop(&mut self) {
        if let (Some(ticket), Some(helpers)) = (self.asked, &self.session.means().helpers) {
            helpers.withdraw(ticket);
        }
        if !self.is_over {
            self.session.end_judging();
        }
    }
}
