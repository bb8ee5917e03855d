use super::{
    Cell, Job, WorkOptions,
    result::{ClockResult, Judged, Mark},
};
use crate::folder::{ExperimentError, PlannedRun};
use gambol_runs::{
    config::RunConfig,
    run_folder::FolderError,
    strategies::AnyStrategy,
    training::{Outcome, TrainError, resume, train},
};
use ne_core::{Generation, StopConditions, StopReason};
use std::{path::Path, time::Instant};

/// A run that goes on for some minutes and is looked at after each of these; while its champion is judged the clock
/// stands still. `None`: it was interrupted.
pub(super) fn time(
    job: Job<'_>,
    path: &Path,
    minutes: &[f64],
    options: &WorkOptions<'_, Judged>,
) -> Result<Option<ClockResult>, ExperimentError> {
    let (mut seconds, mut marks) = (0.0, Vec::<Mark>::new());
    for &minutes in minutes {
        let left = minutes - seconds / 60.0;
        if let Some(last) = marks.last().filter(|_| left <= 0.0).cloned() {
            // A generation took longer than from one moment to the next.
            marks.push(Mark { minutes, ..last });
            continue;
        }
        let stop = StopConditions { minutes: Some(left), ..StopConditions::default() };
        let began = Instant::now();
        let outcome = leg(job, path, stop, marks.is_empty(), options);
        seconds += began.elapsed().as_secs_f64();
        let outcome = match outcome {
            Err(TrainError::Folder(FolderError::Busy { .. } | FolderError::Exists { .. })) => return Ok(None),
            Err(error) => return Err(ExperimentError::run(&job, error)),
            Ok(outcome) if outcome.reason == StopReason::Interrupted => return Ok(None),
            Ok(outcome) => outcome,
        };
        let champion = outcome.champion.map(|champion| Judged::of(&champion, &options.registry)).transpose();
        let champion = champion.map_err(|error| ExperimentError::run(&job, error))?;
        marks.push(Mark { minutes, seconds, generations: outcome.progress.generations, champion });
    }
    let Cell { preset, scenario, .. } = job.cell();
    Ok(Some(ClockResult {
        preset: preset.name.clone(),
        creature: scenario.creature.into(),
        movement: scenario.movement.into(),
        settings: job.settings(),
        threads: options.threads,
        marks,
    }))
}

/// The run up to the next moment.
fn leg(
    job: Job<'_>,
    path: &Path,
    stop: StopConditions,
    first: bool,
    options: &WorkOptions<'_, Judged>,
) -> Result<Outcome, TrainError> {
    let mut unseen = |_: &Generation<'_, AnyStrategy>| {};
    let how = options.training(&mut unseen);
    if first { train(&RunConfig { stop, ..job.config() }, path, how) } else { resume(path, Some(stop), how) }
}
