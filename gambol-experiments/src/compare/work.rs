use super::{CompareError, ComparisonFolder, Plan, plan::Job, result::RunResult};
use crate::work::{Ended, Work, WorkOptions};

/// Does the runs of a part that are not done, and goes on with interrupted ones. [`Progress::best`](crate::compare::Progress) is the
/// best fitness of a run. Returns how many runs of the part have not ended: 0, unless the signal was given or other processes
/// work on them.
///
/// # Errors
/// If a run cannot be done or a file cannot be written; runs under way are finished first.
pub fn work(folder: &ComparisonFolder, plan: &Plan, options: &WorkOptions<'_, f64>) -> Result<usize, CompareError> {
    let mine = options.part.of(plan.jobs());
    let run = |job: &Job<'_>| -> Result<Ended<f64>, CompareError> {
        let read = |ended: &_| Ok(RunResult::read(job, ended, &options.registry)?);
        let result = folder.files.result_or_do(job, options, read)?;
        Ok(result.map_or(Ended::NotYet, |result| Ended::Done {
            best: result.points.last().and_then(|point| point.best),
            failure: result.failure,
        }))
    };
    Work::new(options, mine.len()).side_by_side(options.workers(), &mine, Job::name, run)?;
    // Other processes may have done what this one found them at.
    mine.iter().try_fold(0, |left, job| Ok(left + usize::from(folder.result(job)?.is_none())))
}
