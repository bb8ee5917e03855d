use super::{
    Cell, ReproduceError, WorkOptions,
    plan::settings_digest,
    result::{ClockResult, Judged, Mark},
};
use gambol_runs::{
    run_folder::FolderError,
    strategies::AnyStrategy,
    training::{Outcome, TrainError, resume, train},
};
use ne_core::{Generation, StopConditions, StopReason};
use std::{path::Path, time::Instant};

/// A run that goes on for some minutes and is looked at after each of these; while its champion is judged the clock
/// stands still. `None`: it was interrupted.
pub(super) fn time(
    cell: &Cell,
    path: &Path,
    minutes: &[f64],
    options: &WorkOptions<'_, Judged>,
) -> Result<Option<ClockResult>, ReproduceError> {
    let name = || format!("{}, timed", cell.name());
    let config = cell.config(1, StopConditions::default(), &options.registry)?;
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
        let outcome = leg(cell, path, stop, marks.is_empty(), options);
        seconds += began.elapsed().as_secs_f64();
        let outcome = match outcome? {
            Err(TrainError::Folder(FolderError::Busy { .. } | FolderError::Exists { .. })) => return Ok(None),
            Err(error) => return Err(ReproduceError::run(name(), error)),
            Ok(outcome) if outcome.reason == StopReason::Interrupted => return Ok(None),
            Ok(outcome) => outcome,
        };
        let champion = outcome.champion.map(|champion| Judged::of(&champion, &options.registry)).transpose();
        let champion = champion.map_err(|error| ReproduceError::run(name(), error.into()))?;
        marks.push(Mark { minutes, seconds, generations: outcome.progress.generations, champion });
    }
    Ok(Some(ClockResult {
        preset: cell.preset.name.clone(),
        creature: cell.scenario.creature.into(),
        movement: cell.scenario.movement.into(),
        settings: settings_digest(&config),
        threads: options.threads,
        marks,
    }))
}

/// The run up to the next moment.
fn leg(
    cell: &Cell,
    path: &Path,
    stop: StopConditions,
    first: bool,
    options: &WorkOptions<'_, Judged>,
) -> Result<Result<Outcome, TrainError>, ReproduceError> {
    let mut unseen = |_: &Generation<'_, AnyStrategy>| {};
    let how = options.training(&mut unseen);
    Ok(if first { train(&cell.config(1, stop, &options.registry)?, path, how) } else { resume(path, Some(stop), how) })
}
