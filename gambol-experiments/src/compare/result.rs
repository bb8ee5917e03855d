use super::plan::Job;
use crate::folder::PlannedRun;
use gambol_runs::{
    Registry,
    champion::Champion,
    recorder::{check_lines, read_champion},
    run_folder::{FolderError, RunFolder},
};
use serde::{Deserialize, Serialize};

/// What a comparison keeps of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunResult {
    /// The method.
    pub method: String,
    /// The scenario.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// The digest of its configuration, its budget and its seed included.
    pub settings: String,
    /// How the best fitness rose: a point for each generation that had a better champion, and one for the last.
    pub points: Vec<Point>,
    /// What the champion at the end of the run comes to in the movement without terms, in one whole episode; `None` if the
    /// fitness has no terms, or the champion fails.
    pub bare: Option<f64>,
    /// Why most evaluations of the last generation failed, of a run without a champion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
}

/// How far a run was after a generation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Evaluations since the run began.
    pub evaluations: u64,
    /// Physics steps since the run began.
    pub steps: u64,
    /// Seconds of wall clock since the run began. The one number that differs between equal runs.
    pub seconds: f64,
    /// The champion's fitness; `None` while every evaluation failed, and before the first re-evaluation of a champion selection.
    pub best: Option<f64>,
}

impl RunResult {
    /// What the log and the timing of an ended run say. In worlds that vary the last point is of the last re-evaluation in the log, and
    /// not of the one after the last generation: a score at a budget knows nothing of that one where the last generation went beyond it.
    /// Only a run too short for any in its log has that one.
    pub(super) fn read(job: &Job<'_>, folder: &RunFolder, registry: &Registry) -> Result<Self, FolderError> {
        let config = folder.read_config()?;
        check_lines(folder, &config)?;
        let (log, timing) = (folder.read_log()?, folder.read_timing()?);
        let mut seconds = 0.0;
        let mut points: Vec<Point> = Vec::new();
        for (place, report) in log.iter().enumerate() {
            seconds += timing.get(place).map_or(0.0, |timing| timing.seconds);
            let best = report.best_so_far.map(f64::from);
            if points.last().is_none_or(|last| last.best != best) || place + 1 == log.len() {
                points.push(Point { evaluations: report.evaluations, steps: report.steps, seconds, best });
            }
        }
        let mut bare = None;
        if let (Some(last), Some(champion)) = (points.last_mut(), read_champion(folder, &config)?) {
            last.best = last.best.or(Some(champion.fitness.get()));
            bare = if job.cell.is_shaped() { without_terms(champion, registry) } else { None };
        }
        let has_none = points.last().is_none_or(|last| last.best.is_none());
        let failure = log.last().filter(|_| has_none).and_then(|last| Some(last.failure.as_ref()?.to_string()));
        let Job { cell, seed } = *job;
        let settings = job.settings();
        Ok(Self { method: cell.method.clone(), scenario: cell.scenario.clone(), seed, settings, points, bare, failure })
    }

    /// Whether two results are of the same run: all but the seconds.
    pub fn agrees_with(&self, other: &Self) -> bool {
        let timeless = |result: &Self| {
            let points: Vec<Point> = result.points.iter().map(|&point| Point { seconds: 0.0, ..point }).collect();
            Self { points, ..result.clone() }
        };
        timeless(self) == timeless(other)
    }
}

/// What a champion comes to in its movement alone.
fn without_terms(mut champion: Champion, registry: &Registry) -> Option<f64> {
    champion.movement.terms.clear();
    champion.movement.objectives.clear();
    Some(champion.verify(registry).ok()?.evaluation.fitness()?.get())
}
