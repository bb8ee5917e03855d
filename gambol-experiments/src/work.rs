//! Doing the runs of an experiment: some at the same time, in parts, and on from where they were interrupted.

use gambol_runs::{
    Registry,
    config::RunConfig,
    run_folder::{FolderError, RunFolder},
    strategies::AnyStrategy,
    training::{Resources, TrainError, TrainOptions, resume, train},
};
use ne_core::{Generation, StopReason, StopSignal, archive};
use std::{
    fmt, io,
    num::NonZero,
    path::Path,
    str::FromStr,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

/// One of several machines' share of the runs: `3/20` does every twentieth run, from the third on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    number: usize,
    of: usize,
}

/// How runs are to be done; none of it changes what they find, but for timed ones.
pub struct WorkOptions<'a, R> {
    /// Which runs.
    pub part: Part,
    /// How many runs at the same time; 0: one for each core. Timed runs are done one by one, after all others.
    pub at_once: usize,
    /// Threads of each run; 0: one for each core.
    pub threads: usize,
    /// What configurations can name.
    pub registry: Registry,
    /// Ends the work after the generations under way.
    pub signal: StopSignal,
    /// Called after each run.
    pub on_run: &'a (dyn Fn(&Progress<R>) + Sync),
}

/// How far the work is.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress<R> {
    /// The name of the run that has just ended.
    pub run: String,
    /// What it found; `None` if every evaluation failed.
    pub best: Option<R>,
    /// Why most evaluations of its last generation failed, where all did and it is known.
    pub failure: Option<String>,
    /// Runs of this part that have ended, earlier ones included.
    pub done: usize,
    /// Runs of this part.
    pub all: usize,
}

/// How a run ended.
pub(crate) enum Ended<R> {
    /// Its result is there.
    Done {
        /// What it found.
        best: Option<R>,
        /// Why it found nothing, where that is known.
        failure: Option<String>,
    },
    /// It was interrupted, or another process is at work on it.
    NotYet,
}

impl<R> Ended<R> {
    /// A run of which it is not told why it found nothing, if it did.
    pub(crate) fn done(best: Option<R>) -> Self {
        Self::Done { best, failure: None }
    }
}

impl<R> Progress<R> {
    /// What is said of a run that found nothing.
    pub fn nothing(&self) -> String {
        let reason =
            self.failure.as_ref().map_or_else(String::new, |reason| format!(", most often for this reason: {reason}"));
        format!("every evaluation failed{reason}")
    }
}

impl Part {
    /// The whole.
    pub const ALL: Self = Self { number: 1, of: 1 };

    /// Whether it has the run with this place among all, from 0.
    pub fn has(self, index: usize) -> bool {
        index % self.of == self.number - 1
    }

    /// Those of all jobs that it has.
    pub(crate) fn of<J>(self, jobs: impl Iterator<Item = J>) -> Vec<J> {
        jobs.enumerate().filter(|(index, _)| self.has(*index)).map(|(_, job)| job).collect()
    }
}

impl<'a, R> WorkOptions<'a, R> {
    /// One run alone, the one with this place among `runs`, from 0, on one thread.
    pub(crate) fn of_one(
        index: usize,
        runs: usize,
        registry: &Registry,
        on_run: &'a (dyn Fn(&Progress<R>) + Sync),
    ) -> Self {
        let part = Part { number: index + 1, of: runs };
        Self { part, at_once: 1, threads: 1, registry: registry.clone(), signal: StopSignal::default(), on_run }
    }

    /// What a run is done with.
    pub(crate) fn resources(&self) -> Resources {
        Resources { threads: self.threads, registry: self.registry.clone(), signal: self.signal.clone() }
    }

    /// How a run is trained.
    pub(crate) fn training<'b>(&self, unseen: &'b mut dyn FnMut(&Generation<'_, AnyStrategy>)) -> TrainOptions<'b> {
        TrainOptions {
            threads: self.threads,
            registry: self.registry.clone(),
            signal: self.signal.clone(),
            on_generation: unseen,
        }
    }

    /// The folder of a run that has ended: trains it, or goes on with it. `None`: it was interrupted, or another process is at
    /// work on it.
    pub(crate) fn run(&self, config: &RunConfig, path: &Path) -> Result<Option<RunFolder>, TrainError> {
        let mut unseen = |_: &Generation<'_, AnyStrategy>| {};
        let how = self.training(&mut unseen);
        let folder = RunFolder::at(path);
        let reason = if folder.is_begun() {
            folder.check_run(config)?;
            if folder.read_config()?.stop != config.stop {
                return Err(FolderError::AnotherRun { path: path.into(), what: "stop".into() }.into());
            }
            match resume(path, None, how) {
                Err(TrainError::Over { reason, .. }) => Ok(reason),
                ended => ended.map(|outcome| outcome.reason),
            }
        } else if RunFolder::set_aside(path)? {
            train(config, path, how).map(|outcome| outcome.reason)
        } else {
            return Ok(None);
        };
        match reason {
            Ok(StopReason::Interrupted) => Ok(None),
            // Exists: another process was faster.
            Err(TrainError::Folder(FolderError::Busy { .. } | FolderError::Exists { .. })) => Ok(None),
            Err(error) => Err(error),
            Ok(_) => Ok(Some(RunFolder::open(path)?)),
        }
    }

    /// How many runs at the same time.
    pub(crate) fn workers(&self) -> usize {
        match self.at_once {
            0 => thread::available_parallelism().map_or(1, NonZero::get),
            at_once => at_once,
        }
    }
}

/// The runs of a part while they are done.
pub(crate) struct Work<'a, R> {
    options: &'a WorkOptions<'a, R>,
    all: usize,
    done: AtomicUsize,
}

impl<'a, R> Work<'a, R> {
    /// Work on so many runs.
    pub(crate) fn new(options: &'a WorkOptions<'a, R>, all: usize) -> Self {
        Self { options, all, done: AtomicUsize::new(0) }
    }

    /// How many have not ended.
    pub(crate) fn left(self) -> usize {
        self.all - self.done.into_inner()
    }

    /// Does some of the runs, at most `workers` at the same time.
    ///
    /// # Errors
    /// The first error; runs under way are finished first.
    pub(crate) fn side_by_side<J: Sync, E: Send>(
        &self,
        workers: usize,
        jobs: &[J],
        name: impl Fn(&J) -> String + Sync,
        how: impl Fn(&J) -> Result<Ended<R>, E> + Sync,
    ) -> Result<(), E> {
        let next = AtomicUsize::new(0);
        let failure = Mutex::new(None);
        let worker = || {
            while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                if self.options.signal.is_set() || failure.lock().is_ok_and(|failure| failure.is_some()) {
                    return;
                }
                match how(job) {
                    Ok(Ended::NotYet) => {}
                    Ok(Ended::Done { best, failure }) => {
                        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
                        (self.options.on_run)(&Progress { run: name(job), best, failure, done, all: self.all });
                    }
                    Err(error) => {
                        if let Ok(mut failure) = failure.lock() {
                            failure.get_or_insert(error);
                        }
                    }
                }
            }
        };
        thread::scope(|scope| {
            for _ in 0..workers.min(jobs.len()) {
                scope.spawn(worker);
            }
        });
        match failure.into_inner() {
            Ok(Some(error)) => Err(error),
            _ => Ok(()),
        }
    }
}

/// Whether there is nothing at this path but what a killed writer may have left there.
pub(crate) fn is_free(path: &Path) -> io::Result<bool> {
    match path.read_dir() {
        Ok(mut entries) => Ok(entries.all(|entry| entry.is_ok_and(|entry| archive::is_temporary(&entry.file_name())))),
        Err(_) if !path.exists() => Ok(true),
        Err(_) if !path.is_dir() => Ok(false),
        Err(source) => Err(source),
    }
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) => Ok(Self { number, of }),
            _ => Err("must be a number and how many parts there are, such as 3/20".into()),
        }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}
