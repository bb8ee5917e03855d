//! Work that takes its time, and who does it.

use std::{io, time::Duration};

/// Work that is done bit by bit, so that it can be done between other things.
pub trait Job: Send {
    /// Does a bit of it.
    fn go_on(&mut self) -> Next;
}

/// When a [`Job`] is to go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// At once.
    Now,
    /// After so long, or when all are [woken](Workers::wake).
    After(Duration),
    /// It is done.
    Done,
}

/// Does jobs: on threads where there are some, in a browser between two messages of the page.
pub trait Workers: Send + Sync {
    /// Begins to do a job. `name`: what it is called in a list of threads.
    ///
    /// # Errors
    /// If there is nothing to do it with.
    fn start(&self, name: &str, job: Box<dyn Job>) -> io::Result<()>;

    /// Lets all that wait look again.
    fn wake(&self);
}

/// How long what waits waits before it looks again.
pub(crate) const PATIENCE: Duration = Duration::from_millis(200);
