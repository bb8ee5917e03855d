//! The champions of a session, judged one after the other.

use crate::{
    session::Session,
    work::{Job, Next, PATIENCE},
};
use std::{
    sync::{Arc, Weak},
    time::{Instant, SystemTime},
};

/// Judges each new champion of a session from now on, as long as a page looks.
pub(crate) fn judge_champions(session: &Arc<Session>, look: &Weak<()>) {
    if !session.begin_judging() {
        return;
    }
    let judging = Box::new(Judging { session: Arc::clone(session), look: look.clone(), judged: None });
    if let Err(error) = session.means().workers.start("judge", judging) {
        tracing::warn!(%error, "no gait is judged");
    }
}

struct Judging {
    session: Arc<Session>,
    look: Weak<()>,
    /// When the champion file was written that was judged last.
    judged: Option<SystemTime>,
}

/// Judging takes at most this share of one core.
const SHARE: u32 = 20;

impl Job for Judging {
    fn go_on(&mut self) -> Next {
        if self.look.strong_count() == 0 {
            return Next::Done;
        }
        let changed = std::fs::metadata(self.session.folder().champion()).and_then(|file| file.modified()).ok();
        let began = Instant::now();
        if changed.is_some() && changed != self.judged {
            self.judged = changed;
            self.session.judge();
        }
        Next::After((began.elapsed() * SHARE).max(PATIENCE))
    }
}

impl Drop for Judging {
    fn drop(&mut self) {
        self.session.end_judging();
    }
}
