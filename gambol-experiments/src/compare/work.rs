use super::{CompareError, ComparisonFolder, Part, Plan, plan::Job, result::RunResult};
use gambol_runs::Registry;
use gambol_runs::{
    run_folder::{FolderError, RunFolder},
    training::{self, TrainError, TrainOptions},
};
use ne_core::{GenerationReport, StopReason, StopSignal};
use std::{
    num::NonZero,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

/// How the runs of a comparison are to be done; none of it changes what they find.
pub struct WorkOptions<'a> {
    /// Which runs.
    pub part: Part,
    /// How many runs at the same time; 0: one for each core.
    pub at_once: usize,
    /// Threads of each run; 0: one for each core.
    pub threads: usize,
    /// What configurations can name.
    pub registry: Registry,
    /// Ends the work after the generations under way.
    pub signal: StopSignal,
    /// Called after each run.
    pub on_run: &'a (dyn Fn(&Progress) + Sync),
}

/// How far the work is.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// The name of the run that has just ended.
    pub run: String,
    /// Its best fitness; `None` if every evaluation failed.
    pub best: Option<f64>,
    /// Runs of this part that have ended, earlier ones included.
    pub done: usize,
    /// Runs of this part.
    pub all: usize,
}

/// Does the runs of a part that have not been done yet, and goes on with those that were interrupted. Gives the number of
/// runs of the part that have not ended: none, unless the signal was given or other processes are at work on them.
///
/// # Errors
/// If a run cannot be done or a file cannot be written; runs under way are finished first.
pub fn work(folder: &ComparisonFolder, plan: &Plan, options: &WorkOptions<'_>) -> Result<usize, CompareError> {
    let mine: Vec<Job<'_>> =
        plan.jobs().enumerate().filter(|(index, _)| options.part.has(*index)).map(|(_, job)| job).collect();
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let failure = Mutex::new(None);
    let worker = || {
        while let Some(job) = mine.get(next.fetch_add(1, Ordering::Relaxed)) {
            let failed = || failure.lock().is_ok_and(|failure| failure.is_some());
            if options.signal.is_set() || failed() {
                return;
            }
            match run(folder, job, options) {
                Ok(None) => {}
                Ok(Some(result)) => {
                    let best = result.points.last().and_then(|point| point.best);
                    let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                    (options.on_run)(&Progress { run: job.name(), best, done, all: mine.len() });
                }
                Err(error) => {
                    if let Ok(mut failure) = failure.lock() {
                        failure.get_or_insert(error);
                    }
                }
            }
        }
    };
    let at_once =
        if options.at_once > 0 { options.at_once } else { thread::available_parallelism().map_or(1, NonZero::get) };
    thread::scope(|scope| {
        for _ in 0..at_once.min(mine.len()) {
            scope.spawn(worker);
        }
    });
    match failure.into_inner() {
        Ok(Some(error)) => Err(error),
        _ => Ok(mine.len() - done.into_inner()),
    }
}

/// Does a run, unless it is done, or goes on with it. `None`: it was interrupted, or another process is at work on it.
fn run(folder: &ComparisonFolder, job: &Job<'_>, options: &WorkOptions<'_>) -> Result<Option<RunResult>, CompareError> {
    if let Some(result) = folder.result(job)? {
        return Ok(Some(result));
    }
    let failed = |source: TrainError| CompareError::Run { run: job.name(), source };
    let unreadable = |error: FolderError| failed(error.into());
    let path = folder.run_folder(job);
    let mut unseen = |_: &GenerationReport| {};
    let how = TrainOptions {
        threads: options.threads,
        registry: options.registry.clone(),
        signal: options.signal.clone(),
        on_generation: &mut unseen,
    };
    let reason = if RunFolder::at(&path).is_begun() {
        match training::resume(&path, None, how) {
            Err(TrainError::Over { reason, .. }) => Ok(reason),
            ended => ended.map(|outcome| outcome.reason),
        }
    } else {
        if !RunFolder::set_aside(&path).map_err(unreadable)? {
            return Ok(None);
        }
        training::train(&job.config(), &path, how).map(|outcome| outcome.reason)
    };
    match reason {
        // Exists: another process was faster.
        Err(TrainError::Folder(FolderError::Busy { .. } | FolderError::Exists { .. }))
        | Ok(StopReason::Interrupted) => {
            return Ok(None);
        }
        Err(error) => return Err(failed(error)),
        Ok(_) => {}
    }
    let run = RunFolder::open(&path).map_err(unreadable)?;
    let result = RunResult::read(job, &run, &options.registry).map_err(unreadable)?;
    folder.write_result(job, &result)?;
    Ok(Some(result))
}
