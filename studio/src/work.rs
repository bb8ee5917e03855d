//! Work that takes its time, and who does it.

use crate::protocol::Verdict;
use gambol_runs::{champion::Champion, config::RunConfig, training::Batch};
use ne_core::Evaluation;
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

/// Helps trainings with their evaluations and verdicts: elsewhere, as the workers of a browser do. What a training finds is the same.
pub trait Helpers: Send + Sync {
    /// Whether any are there.
    fn are_there(&self) -> bool;

    /// A batch that is to be evaluated, of a run or a stage with this configuration.
    fn offer(&self, config: &RunConfig, batch: Batch) -> Ticket;

    /// All evaluations of a batch, once they are there; the ticket is of no more use then.
    fn collect(&self, ticket: Ticket) -> Option<Vec<Evaluation>>;

    /// A piece of a batch that nothing evaluates yet, for the owner of the ticket to evaluate.
    fn take(&self, ticket: Ticket) -> Option<(usize, Batch)>;

    /// The evaluations of a piece that was taken.
    fn give(&self, ticket: Ticket, piece: usize, evaluations: Vec<Evaluation>);

    /// A champion that is to be judged.
    fn judge(&self, champion: &Champion) -> Ticket;

    /// The verdict on a champion, once it is there; the ticket is of no more use then.
    fn verdict(&self, ticket: Ticket) -> Option<Verdict>;

    /// Nothing of it is wanted any more.
    fn withdraw(&self, ticket: Ticket);
}

/// What a batch or a champion is known by.
pub type Ticket = u64;

/// How long what waits waits before it looks again.
pub(crate) const PATIENCE: Duration = Duration::from_millis(200);
