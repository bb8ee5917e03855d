//! A thread for each job.

use std::{
    io,
    sync::{Arc, Condvar, Mutex, PoisonError},
    thread,
};
use studio::work::{Job, Next, Workers};

/// Does each job on a thread of its own.
#[derive(Clone, Default)]
pub struct Threads(Arc<Woken>);

/// How often all were woken.
#[derive(Default)]
struct Woken {
    times: Mutex<u64>,
    changed: Condvar,
}

impl Woken {
    fn times(&self) -> u64 {
        *self.times.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Workers for Threads {
    fn start(&self, name: &str, mut job: Box<dyn Job>) -> io::Result<()> {
        let woken = Arc::clone(&self.0);
        let work = move || {
            loop {
                // Looked at before the job is, so that it cannot be woken in between.
                let before = woken.times();
                match job.go_on() {
                    Next::Now => {}
                    Next::Done => return,
                    Next::After(duration) => {
                        let times = woken.times.lock().unwrap_or_else(PoisonError::into_inner);
                        drop(woken.changed.wait_timeout_while(times, duration, |times| *times == before));
                    }
                }
            }
        };
        thread::Builder::new().name(name.to_owned()).spawn(work).map(drop)
    }

    fn wake(&self) {
        *self.0.times.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        self.0.changed.notify_all();
    }
}
