//! Jobs that wait for their turn.

use std::{
    io,
    sync::{Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};
use studio::work::{Job, Next, Workers};

/// Does jobs on the calling thread, whenever it is [asked to](Self::work).
#[derive(Default)]
pub struct Queue(Mutex<Vec<Waiting>>);

struct Waiting {
    job: Box<dyn Job>,
    /// From when on it may go on; `None`: at once.
    due: Option<Instant>,
}

impl Queue {
    /// Does a bit of each job that may go on. How long it is until another may; `None`: there is none.
    pub fn work(&self) -> Option<Duration> {
        let now = Instant::now();
        let is_due = |waiting: &Waiting| waiting.due.is_none_or(|due| due <= now);
        // A job may start others, or wake them.
        let due: Vec<Waiting> = self.waiting().extract_if(.., |waiting| is_due(waiting)).collect();
        for Waiting { mut job, .. } in due {
            let due = match job.go_on() {
                Next::Done => continue,
                Next::Now => None,
                Next::After(duration) => Some(Instant::now() + duration),
            };
            self.waiting().push(Waiting { job, due });
        }
        let now = Instant::now();
        let until = |waiting: &Waiting| waiting.due.map_or(Duration::ZERO, |due| due.saturating_duration_since(now));
        self.waiting().iter().map(until).min()
    }

    /// Drops all jobs.
    pub fn clear(&self) {
        let all = std::mem::take(&mut *self.waiting());
        // What ends may ask for the queue.
        drop(all);
    }

    fn waiting(&self) -> MutexGuard<'_, Vec<Waiting>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Workers for Queue {
    fn start(&self, _: &str, job: Box<dyn Job>) -> io::Result<()> {
        self.waiting().push(Waiting { job, due: None });
        Ok(())
    }

    fn wake(&self) {
        self.waiting().iter_mut().for_each(|waiting| waiting.due = None);
    }
}
