use super::{
    Job, Plan, ReproduceError, ReproductionFolder, clock,
    result::{Judged, RunResult},
};
use crate::{
    folder::{ExperimentError, make},
    work::{Ended, Work, WorkOptions},
};
use gambol_runs::run_folder::{FolderError, FolderLock, RunFolder};
use std::path::Path;

/// Does the runs of a part that are not done, and goes on with interrupted ones; an interrupted timed run begins anew.
/// [`Progress::best`](crate::reproduce::Progress) is the champion of a run. Returns how many runs of the part have not ended: 0,
/// unless the signal was given or other processes work on them.
///
/// # Errors
/// If a run cannot be done or a file cannot be written; runs under way are finished first.
pub fn work(
    folder: &ReproductionFolder,
    plan: &Plan,
    options: &WorkOptions<'_, Judged>,
) -> Result<usize, ReproduceError> {
    let mine = options.part.of(plan.jobs());
    let work = Work::new(options, mine.len());
    let (timed, runs): (Vec<Job<'_>>, Vec<Job<'_>>) =
        mine.into_iter().partition(|job| matches!(job, Job::Clock { .. }));
    let run = |job: &Job<'_>| -> Result<Ended<Judged>, ReproduceError> {
        let read = |ended: &_| RunResult::read(*job, ended, options.threads, &options.registry);
        let result = folder.files.result_or_do(job, options, read)?;
        Ok(result.map_or(Ended::NotYet, |result| Ended::done(result.champion)))
    };
    work.side_by_side(options.workers(), &runs, Job::name, run)?;
    let minutes = plan.clock_minutes.as_deref().unwrap_or_default();
    work.side_by_side(1, &timed, Job::name, |&job| time(folder, job, minutes, options))?;
    Ok(work.left())
}

/// The right to do the timed run in this folder, held in the folder above it. `None`: another process has it.
fn lock_timed_run(job: Job<'_>, path: &Path) -> Result<Option<FolderLock>, ExperimentError> {
    let scenario = path.parent().unwrap_or(path);
    make(scenario)?;
    match RunFolder::at(scenario).lock() {
        Ok(lock) => Ok(Some(lock)),
        Err(FolderError::Busy { .. }) => Ok(None),
        Err(error) => Err(ExperimentError::run(&job, error)),
    }
}

/// Does a timed run, unless it is done.
fn time(
    folder: &ReproductionFolder,
    job: Job<'_>,
    minutes: &[f64],
    options: &WorkOptions<'_, Judged>,
) -> Result<Ended<Judged>, ReproduceError> {
    let cell = job.cell();
    let result = match folder.clock_result(cell)? {
        Some(result) => result,
        None => {
            let path = folder.files.run_folder(&job);
            // No lock is held between two moments of a timed run: this one keeps other processes from taking it.
            let Some(_timed) = lock_timed_run(job, &path)? else { return Ok(Ended::NotYet) };
            if folder.clock_result(cell)?.is_some() {
                return time(folder, job, minutes, options);
            }
            let is_free = RunFolder::set_aside_with_runs(&path).map_err(|error| ExperimentError::run(&job, error))?;
            if !is_free {
                return Ok(Ended::NotYet);
            }
            let Some(result) = clock::time(job, &path, minutes, options)? else { return Ok(Ended::NotYet) };
            folder.files.write_result(&job, &result)?;
            result
        }
    };
    Ok(Ended::done(result.marks.last().and_then(|mark| mark.champion.clone())))
}
