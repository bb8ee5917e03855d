//! The stage runs of a run with stages, read from its folder.

use super::ShapingError;
use crate::{
    champion::Champion,
    run_folder::{FolderError, RunFolder},
};
use ne_core::{Progress, TieredFitness, promotion::Decision};
use std::{fs, path::Path, path::PathBuf};

/// A stretch of the way: a stage from its beginning until it was passed, left, or broken off.
#[derive(Clone, Debug, PartialEq)]
pub struct StageRun {
    /// Which, from 1.
    pub number: usize,
    /// The stage's index.
    pub stage: usize,
    /// The stage's name.
    pub name: String,
    /// Its folder.
    pub folder: PathBuf,
    /// How it ended.
    pub decision: Decision,
    /// What it used.
    pub progress: Progress,
    /// Where its champion stands.
    pub champion: Option<TieredFitness>,
}

/// The stage runs of a run with stages so far, in order; the last may be under way.
///
/// # Errors
/// If a file of a stage run cannot be read.
pub fn stage_runs(folder: &RunFolder) -> Result<Vec<StageRun>, FolderError> {
    let Ok(entries) = fs::read_dir(folder.stages()) else { return Ok(Vec::new()) };
    let numbered = |path: PathBuf| {
        let (number, name) = path.file_name()?.to_str()?.split_once('-')?;
        Some((number.parse::<usize>().ok()?, name.to_owned(), path))
    };
    let mut folders: Vec<(usize, String, PathBuf)> =
        entries.flatten().filter_map(|entry| numbered(entry.path())).collect();
    folders.sort();
    let config = folder.read_config()?;
    let mut stage_runs = Vec::new();
    for (number, name, path) in folders {
        let stage_folder = RunFolder::at(&path);
        if stage_folder.is_begun() {
            let stage = config.stages.iter().position(|stage| stage.name == name).unwrap_or(stage_runs.len());
            stage_runs.push(stage_run(&stage_folder, number, stage, &name)?);
        }
    }
    Ok(stage_runs)
}

/// The folder of the run that this folder is a stage of, if it is one.
pub fn run_of_stage(folder: &Path) -> Option<PathBuf> {
    let folder = folder.canonicalize().ok()?;
    let stages = folder.parent().filter(|parent| parent.file_name().is_some_and(|name| name == "stages"))?;
    let run = RunFolder::open(stages.parent()?).ok()?;
    let config = run.read_config().ok()?;
    (!config.stages.is_empty()).then(|| run.path().into())
}

/// Checks that a folder is not that of a stage, which goes on as a part of its run alone.
///
/// # Errors
/// If it is one.
pub fn check_whole(folder: &Path) -> Result<(), ShapingError> {
    match run_of_stage(folder) {
        Some(run) => Err(ShapingError::StageOfARun { stage: folder.into(), run }),
        None => Ok(()),
    }
}

pub(super) fn stage_run(folder: &RunFolder, number: usize, stage: usize, name: &str) -> Result<StageRun, FolderError> {
    let standing = folder.read_standing()?;
    let champion = standing.champion.map(|champion| TieredFitness { tier: champion.tier, fitness: champion.fitness });
    let (decision, progress) = (standing.decision, standing.progress);
    Ok(StageRun { number, stage, name: name.into(), folder: folder.path().into(), decision, progress, champion })
}

/// Why the evaluations of the last generation failed, most often, if all did; of a run with stages those of its last stage run.
///
/// # Errors
/// If a file of the run cannot be read.
pub fn why_all_failed(folder: &RunFolder) -> Result<Option<String>, FolderError> {
    let last = stage_runs(folder)?.last().map(|stage_run| RunFolder::at(&stage_run.folder));
    let log = last.as_ref().unwrap_or(folder).read_log()?;
    Ok(log.into_iter().next_back().and_then(|report| report.failure))
}

/// What all stage runs have used.
pub(super) fn total(stage_runs: &[StageRun]) -> Progress {
    let sum = |count: fn(&Progress) -> u64| stage_runs.iter().map(|stage_run| count(&stage_run.progress)).sum();
    Progress {
        generations: sum(|progress| progress.generations),
        evaluations: sum(|progress| progress.evaluations),
        steps: sum(|progress| progress.steps),
        stagnation: stage_runs.last().map_or(0, |stage_run| stage_run.progress.stagnation),
    }
}

/// The stage run whose champion is that of the run: the latest that has one. Once one was given up, of all that have got as far as any
/// the best: what begins anew has to get there first.
pub fn leading<'a>(stage_runs: impl IntoIterator<Item = &'a StageRun>) -> Option<&'a StageRun> {
    let stage_runs: Vec<&StageRun> = stage_runs.into_iter().collect();
    let gave_up = stage_runs.iter().any(|stage_run| stage_run.decision == Decision::GiveUp);
    let has_champion = |stage_run: &&StageRun| RunFolder::at(&stage_run.folder).champion().is_file();
    let mut able = stage_runs.into_iter().filter(has_champion);
    match gave_up {
        true => able.max_by_key(|stage_run| (stage_run.stage, stage_run.champion)),
        false => able.next_back(),
    }
}

/// The champion of the run is that of its [leading](leading) stage run.
pub(super) fn keep_champion<'a>(
    run: &RunFolder,
    stage_runs: impl IntoIterator<Item = &'a StageRun>,
) -> Result<(), FolderError> {
    match leading(stage_runs) {
        Some(stage_run) => Ok(Champion::read(&RunFolder::at(&stage_run.folder).champion())?.write(&run.champion())?),
        None => Ok(()),
    }
}
