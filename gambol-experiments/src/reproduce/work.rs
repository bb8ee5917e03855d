use super::{
    Job, Part, Plan, ReproduceError, ReproductionFolder, clock,
    plan::settings_digest,
    result::{Judged, RunResult},
};
use gambol_runs::Registry;
use gambol_runs::{
    run_folder::{FolderError, RunFolder},
    training::{TrainError, TrainOptions, resume, train},
};
use ne_core::{GenerationReport, StopConditions, StopReason, StopSignal};
use std::{
    num::NonZero,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

/// How the runs are to be done; none of it changes what they find, but for the timed ones.
pub struct WorkOptions<'a> {
    /// Which runs.
    pub part: Part,
    /// How many runs at the same time; 0: one for each core. Timed runs are done one by one, after all others.
    pub at_once: usize,
    /// Threads of each run; 0: one for each core.
    pub threads: usize,
    /// The movements there are.
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
    /// Its champion; `None` if every evaluation failed.
    pub champion: Option<Judged>,
    /// Runs of this part that have ended, earlier ones included.
    pub done: usize,
    /// Runs of this part.
    pub all: usize,
}

/// How a job ended.
enum Ended {
    /// Its result is there: its champion.
    Done(Option<Judged>),
    /// It was interrupted, or another process is at work on it.
    NotYet,
}

/// Does the runs of a part that have not been done yet, and goes on with those that were interrupted; a timed run that was
/// begins anew. Gives the number of runs of the part that have not ended: none, unless the signal was given or other
/// processes are at work on them.
///
/// # Errors
/// If a run cannot be done or a file cannot be written; runs under way are finished first.
pub fn work(folder: &ReproductionFolder, plan: &Plan, options: &WorkOptions<'_>) -> Result<usize, ReproduceError> {
    let mine: Vec<Job> =
        plan.jobs().enumerate().filter(|(index, _)| options.part.has(*index)).map(|(_, job)| job).collect();
    let (timed, runs): (Vec<Job>, Vec<Job>) = mine.iter().partition(|job| matches!(job, Job::Clock { .. }));
    let at_once = match options.at_once {
        0 => thread::available_parallelism().map_or(1, NonZero::get),
        at_once => at_once,
    };
    let done = AtomicUsize::new(0);
    let tell = |job: &Job, champion| {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        (options.on_run)(&Progress { run: job.name(), champion, done, all: mine.len() });
    };
    side_by_side(&runs, at_once, &options.signal, &tell, &|job| run(folder, plan, job, options))?;
    let minutes = plan.clock_minutes.as_deref().unwrap_or_default();
    side_by_side(&timed, 1, &options.signal, &tell, &|job| time(folder, job, minutes, options))?;
    Ok(mine.len() - done.into_inner())
}

/// Does jobs, so many at the same time.
fn side_by_side(
    jobs: &[Job],
    at_once: usize,
    signal: &StopSignal,
    tell: &(dyn Fn(&Job, Option<Judged>) + Sync),
    how: &(dyn Fn(&Job) -> Result<Ended, ReproduceError> + Sync),
) -> Result<(), ReproduceError> {
    let next = AtomicUsize::new(0);
    let failure = Mutex::new(None);
    let worker = || {
        while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
            if signal.is_set() || failure.lock().is_ok_and(|failure| failure.is_some()) {
                return;
            }
            match how(job) {
                Ok(Ended::NotYet) => {}
                Ok(Ended::Done(champion)) => tell(job, champion),
                Err(error) => {
                    if let Ok(mut failure) = failure.lock() {
                        failure.get_or_insert(error);
                    }
                }
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..at_once.min(jobs.len()) {
            scope.spawn(worker);
        }
    });
    match failure.into_inner() {
        Ok(Some(error)) => Err(error),
        _ => Ok(()),
    }
}

/// Does a run, unless it is done, or goes on with it.
fn run(
    folder: &ReproductionFolder,
    plan: &Plan,
    job: &Job,
    options: &WorkOptions<'_>,
) -> Result<Ended, ReproduceError> {
    let Job::Run { cell, seed } = *job else { return Ok(Ended::NotYet) };
    if let Some(result) = folder.run_result(&cell, seed)? {
        return Ok(Ended::Done(result.champion));
    }
    let stop = StopConditions { generations: Some(plan.generations), ..StopConditions::default() };
    let config = cell.config(seed, stop, &options.registry)?;
    let path = folder.run_folder(job);
    let mut unseen = |_: &GenerationReport| {};
    let how = train_options(options, &mut unseen);
    let begun = Some(RunFolder::at(&path)).filter(RunFolder::is_begun);
    let reason = if let Some(begun) = begun {
        if begun.read_config()? != config {
            return Err(ReproduceError::Settings { path, preset: cell.preset.name });
        }
        match resume(&path, None, how) {
            Err(TrainError::Over { reason, .. }) => Ok(reason),
            ended => ended.map(|outcome| outcome.reason),
        }
    } else {
        if !RunFolder::set_aside(&path)? {
            return Ok(Ended::NotYet);
        }
        train(&config, &path, how).map(|outcome| outcome.reason)
    };
    match reason {
        // Exists: another process was faster.
        Err(TrainError::Folder(FolderError::Busy { .. } | FolderError::Exists { .. }))
        | Ok(StopReason::Interrupted) => return Ok(Ended::NotYet),
        Err(error) => return Err(ReproduceError::run(job.name(), error)),
        Ok(_) => {}
    }
    let ended = RunFolder::open(&path)?;
    let result = RunResult::read(&cell, &ended, settings_digest(&config), options.threads, &options.registry)?;
    folder.write_run(job, &result)?;
    Ok(Ended::Done(result.champion))
}

/// Does a timed run, unless it is done.
fn time(
    folder: &ReproductionFolder,
    job: &Job,
    minutes: &[f64],
    options: &WorkOptions<'_>,
) -> Result<Ended, ReproduceError> {
    let cell = job.cell();
    let result = match folder.clock_result(&cell)? {
        Some(result) => result,
        None => {
            let path = folder.run_folder(job);
            if !RunFolder::set_aside(&path)? {
                return Ok(Ended::NotYet);
            }
            let Some(result) = clock::time(&cell, &path, minutes, options)? else { return Ok(Ended::NotYet) };
            folder.write_clock(job, &result)?;
            result
        }
    };
    Ok(Ended::Done(result.marks.last().and_then(|mark| mark.champion.clone())))
}

/// How a run is trained.
pub(super) fn train_options<'a>(
    options: &WorkOptions<'_>,
    unseen: &'a mut dyn FnMut(&GenerationReport),
) -> TrainOptions<'a> {
    TrainOptions {
        threads: options.threads,
        registry: options.registry.clone(),
        signal: options.signal.clone(),
        on_generation: unseen,
    }
}
