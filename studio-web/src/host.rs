//! A studio in a worker: its pages, and its work.

use crate::{
    desk::{Desk, Errand, Found},
    queue::Queue,
};
use gambol_runs::{Registry, training::BatchEvaluator};
use percent_encoding::percent_decode_str;
use std::{collections::BTreeMap, path::PathBuf, sync::Arc, time::Duration};
use studio::{Download, DownloadError, Library, Means, Reply, Viewer, Wanted, protocol::Verdict};

/// A studio whose pages have numbers.
pub struct Host {
    library: Arc<Library>,
    viewers: BTreeMap<u32, Viewer>,
    queue: Arc<Queue>,
    desk: Arc<Desk>,
}

/// Evaluates and judges for a host in another worker.
#[derive(Default)]
pub struct Helper {
    registry: Registry,
    evaluator: Option<BatchEvaluator>,
}

impl Helper {
    /// What comes of an errand; `None` if its configuration cannot be built, or was never sent.
    pub fn run(&mut self, errand: Errand) -> Option<Found> {
        match errand {
            Errand::Evaluate { ticket, piece, config, batch } => {
                if let Some(config) = &config {
                    self.evaluator = BatchEvaluator::new(config, &self.registry).ok();
                }
                Some(Found::Evaluations { ticket, piece, evaluations: self.evaluator.as_ref()?.evaluate(batch) })
            }
            Errand::Judge { ticket, champion } => {
                Some(Found::Verdict { ticket, verdict: Verdict::of(&champion, &self.registry) })
            }
        }
    }
}

impl Host {
    /// Over the runs in a folder, which need not be there yet.
    pub fn new(registry: Registry, runs: PathBuf) -> Self {
        let queue = Arc::new(Queue::default());
        // A report is made when it is asked for: it would keep the page waiting.
        let desk = Arc::new(Desk::new(queue.clone()));
        let means = Means { workers: queue.clone(), helpers: Some(desk.clone()), threads: 1, writes_reports: false };
        Self { library: Arc::new(Library::new(registry, runs, means)), viewers: BTreeMap::new(), queue, desk }
    }

    /// Where helpers come and go.
    pub fn desk(&self) -> &Desk {
        &self.desk
    }

    /// A page comes. `shows_scenes`: what is to be seen moves in another worker.
    pub fn join(&mut self, page: u32, shows_scenes: bool) {
        let viewer = Viewer::new(Arc::clone(&self.library));
        self.viewers.insert(page, if shows_scenes { viewer.of_scenes() } else { viewer });
    }

    /// A page goes.
    pub fn leave(&mut self, page: u32) {
        self.viewers.remove(&page);
    }

    /// Answers a message of a page.
    pub fn answer(&mut self, page: u32, message: &str) -> Vec<Reply> {
        self.viewers.get_mut(&page).map_or_else(Vec::new, |viewer| viewer.answer(message))
    }

    /// What is new for a page.
    pub fn news(&mut self, page: u32) -> Vec<Reply> {
        self.viewers.get_mut(&page).map_or_else(Vec::new, Viewer::news)
    }

    /// A file of a run, by its address, such as `runs/biped-1-running/export/gif/0`, with its parts encoded as in a URL.
    ///
    /// # Errors
    /// If there is none.
    pub fn download(&self, address: &str) -> Result<Download, DownloadError> {
        let missing = || DownloadError::Missing(format!("there is no \"{address}\""));
        let (run, wanted) = address.strip_prefix("runs/").and_then(|rest| rest.split_once('/')).ok_or_else(missing)?;
        let run = percent_decode_str(run).decode_utf8().map_err(|_| missing())?;
        self.library.download(&run, &Wanted::parse(wanted)?)
    }

    /// Does a bit of what there is to do. How long it is until there is more; `None`: nothing is to be done.
    pub fn work(&self) -> Option<Duration> {
        self.queue.work()
    }
}

impl Drop for Host {
    /// A job holds its session, and that the queue.
    fn drop(&mut self) {
        self.queue.clear();
    }
}
