use super::{
    Job, Plan, ReproduceError, ReproductionFolder, clock,
    plan::settings_digest,
    result::{Judged, RunResult},
};
use crate::work::{Ended, Work, WorkOptions};
use gambol_runs::run_folder::{FolderError, FolderLock, RunFolder};
use ne_core::{StopConditions, archive};
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
    let (timed, runs): (Vec<Job>, Vec<Job>) = mine.into_iter().partition(|job| matches!(job, Job::Clock { .. }));
    work.side_by_side(options.workers(), &runs, Job::name, |job| run(folder, plan, job, options))?;
    let minutes = plan.clock_minutes.as_deref().unwrap_or_default();
    work.side_by_side(1, &timed, Job::name, |job| time(folder, job, minutes, options))?;
    Ok(work.left())
}

/// Does a run, unless it is done, or goes on with it.
fn run(
    folder: &ReproductionFolder,
    plan: &Plan,
    job: &Job,
    options: &WorkOptions<'_, Judged>,
) -> Result<Ended<Judged>, ReproduceError> {
    let &Job::Run { ref cell, seed } = job else { return Ok(Ended::NotYet) };
    if let Some(result) = folder.run_result(cell, seed)? {
        return Ok(Ended::done(result.champion));
    }
    let stop = StopConditions { generations: Some(plan.generations), ..StopConditions::default() };
    let config = cell.config(seed, stop, &options.registry)?;
    let path = folder.run_folder(job);
    let begun = RunFolder::at(&path);
    if begun.is_begun() && begun.read_config()? != config {
        return Err(ReproduceError::Settings { path, preset: cell.preset.name.clone() });
    }
    let ended = options.run(&config, &path).map_err(|error| ReproduceError::run(job.name(), error))?;
    let Some(ended) = ended else { return Ok(Ended::NotYet) };
    let result = RunResult::read(cell, &ended, settings_digest(&config), options.threads, &options.registry)?;
    folder.write_run(job, &result)?;
    Ok(Ended::done(result.champion))
}

/// The right to do the timed run in this folder, held in the folder above it. `None`: another process has it.
fn lock_timed_run(path: &Path) -> Result<Option<FolderLock>, ReproduceError> {
    let scenario = path.parent().unwrap_or(path);
    archive::make_folder(scenario).map_err(|source| ReproduceError::Write { path: scenario.into(), source })?;
    match RunFolder::at(scenario).lock() {
        Ok(lock) => Ok(Some(lock)),
        Err(FolderError::Busy { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// Does a timed run, unless it is done.
fn time(
    folder: &ReproductionFolder,
    job: &Job,
    minutes: &[f64],
    options: &WorkOptions<'_, Judged>,
) -> Result<Ended<Judged>, ReproduceError> {
    let cell = job.cell();
    let result = match folder.clock_result(cell)? {
        Some(result) => result,
        None => {
            let path = folder.run_folder(job);
            // No lock is held between two moments of a timed run: this one keeps other processes from taking it.
            let Some(_timed) = lock_timed_run(&path)? else { return Ok(Ended::NotYet) };
            if folder.clock_result(cell)?.is_some() {
                return time(folder, job, minutes, options);
            }
            if !RunFolder::set_aside_with_runs(&path)? {
                return Ok(Ended::NotYet);
            }
            let Some(result) = clock::time(cell, &path, minutes, options)? else { return Ok(Ended::NotYet) };
            folder.write_clock(job, &result)?;
            result
        }
    };
    Ok(Ended::done(result.marks.last().and_then(|mark| mark.champion.clone())))
}
