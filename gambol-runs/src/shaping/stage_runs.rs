//! The stage runs of a run with stages, read from its folder.

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

pub(super) fn stage_run(folder: &RunFolder, number: usize, stage: usize, name: &str) -> Result<StageRun, FolderError> {
    let standing = folder.read_standing()?;
    let champion = standing.champion.map(|champion| TieredFitness { tier: champion.tier, fitness: champion.fitness });
    let (decision, progress) = (standing.decision, standing.progress);
    Ok(StageRun { number, stage, name: name.into(), folder: folder.path().into(), decision, progress, champion })
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

/// The champion of the latest stage run that has one is that of the run; `current` is the stage run under way.
pub(super) fn keep_champion(
    run: &RunFolder,
    stage_runs: &[StageRun],
    current: Option<&RunFolder>,
) -> Result<(), FolderError> {
    let earlier = stage_runs.iter().rev().map(|stage_run| RunFolder::at(&stage_run.folder).champion());
    let mut latest = current.map(RunFolder::champion).into_iter().chain(earlier).filter(|path| path.is_file());
    match latest.next() {
        Some(path) => Ok(Champion::read(&path)?.write(&run.champion())?),
        None => Ok(()),
    }
}
