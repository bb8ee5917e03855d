use super::{CompareError, ComparisonFolder, Plan, plan::Job, result::RunResult};
use crate::work::{Ended, Work, WorkOptions};
use gambol_runs::training::TrainError;

/// Does the runs of a part that are not done, and goes on with interrupted ones. [`Progress::best`](crate::compare::Progress) is the
/// best fitness of a run. Returns how many runs of the part have not ended: 0, unless the signal was given or other processes
/// work on them.
///
/// # Errors
/// If a run cannot be done or a file cannot be written; runs under way are finished first.
pub fn work(folder: &ComparisonFolder, plan: &Plan, options: &WorkOptions<'_, f64>) -> Result<usize, CompareError> {
    let mine = options.part.of(plan.jobs());
    Work::new(options, mine.len())
        .side_by_side(options.workers(), &mine, Job::name, |job| run(folder, job, options))?;
    // Other processes may have done what this one found them at.
    mine.iter().try_fold(0, |left, job| Ok(left + usize::from(folder.result(job)?.is_none())))
}

/// Does a run, unless it is done, or goes on with it.
fn run(folder: &ComparisonFolder, job: &Job<'_>, options: &WorkOptions<'_, f64>) -> Result<Ended<f64>, CompareError> {
    let best = |result: RunResult| Ended::Done {
        best: result.points.last().and_then(|point| point.best),
        failure: result.failure,
    };
    if let Some(result) = folder.result(job)? {
        return Ok(best(result));
    }
    let failed = |source: TrainError| CompareError::Run { run: job.name(), source };
    let ended = options.run(&job.config(), &folder.run_folder(job)).map_err(failed)?;
    let Some(ended) = ended else { return Ok(Ended::NotYet) };
    let result = RunResult::read(job, &ended, &options.registry).map_err(|error| failed(error.into()))?;
    folder.write_result(job, &result)?;
    Ok(best(result))
}
