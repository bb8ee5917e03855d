use super::{Cell, Job};
use crate::folder::PlannedRun;
use gambol_runs::{
    Registry,
    champion::Champion,
    episode_parts::SetupError,
    gait::{self, GaitOfChampionError},
    recorder::{check_lines, read_champion},
    run_folder::RunFolder,
    training::TrainError,
};
use serde::{Deserialize, Serialize};

/// What is kept of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunResult {
    /// The preset.
    pub preset: String,
    /// The creature.
    pub creature: String,
    /// The movement.
    pub movement: String,
    /// The seed.
    pub seed: u64,
    /// A digest of its settings.
    pub settings: String,
    /// The best fitness of each generation, in training; `None` where every evaluation failed.
    pub best: Vec<Option<f64>>,
    /// The mean fitness of each generation, in training; `None` where every evaluation failed.
    pub mean: Vec<Option<f64>>,
    /// The champion; `None` if every evaluation failed.
    pub champion: Option<Judged>,
    /// Threads it ran on when it ended.
    pub threads: usize,
    /// Seconds of wall clock. With the threads the one number that differs between equal runs.
    pub seconds: f64,
}

impl RunResult {
    /// Whether two results are of the same run: all but the threads and the seconds.
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        let timeless = |result: &Self| Self { threads: 0, seconds: 0.0, ..result.clone() };
        timeless(self) == timeless(other)
    }
}

/// What is kept of a timed run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClockResult {
    /// The preset.
    pub preset: String,
    /// The creature.
    pub creature: String,
    /// The movement.
    pub movement: String,
    /// A digest of its settings.
    pub settings: String,
    /// Threads it ran on.
    pub threads: usize,
    /// How far it was at each moment.
    pub marks: Vec<Mark>,
}

/// How far a timed run was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// After so many minutes.
    pub minutes: f64,
    /// The same in seconds, as it came: generations under way are finished. Judging is left out.
    pub seconds: f64,
    /// Generations done.
    pub generations: u64,
    /// The champion; `None` if every evaluation failed.
    pub champion: Option<Judged>,
}

/// A champion, judged by how it moves in rapier.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Judged {
    /// Its fitness, which is its preset's own.
    pub fitness: f64,
    /// The generation it was found in, from 1.
    pub generation: u64,
    /// How far its torso travels in the episode that is judged, m; `None` if there was nothing to measure.
    pub distance_m: Option<f64>,
    /// How high its torso rises above its start while no part touches the ground, m; `None` if it never leaves it.
    pub rise_m: Option<f64>,
    /// Whether the gait is usable.
    pub usable: bool,
    /// What speaks against it.
    pub reasons: Vec<String>,
}

impl Judged {
    /// Replays a champion and judges it.
    ///
    /// # Errors
    /// If its world cannot be built.
    pub fn of(champion: &Champion, registry: &Registry) -> Result<Self, SetupError> {
        let mut judged = Self {
            fitness: champion.fitness.get(),
            generation: champion.generation,
            distance_m: None,
            rise_m: None,
            usable: false,
            reasons: Vec::new(),
        };
        match gait::judge(champion, registry) {
            Ok(report) => {
                judged.distance_m = Some(report.travel.distance);
                judged.rise_m = report.aloft.highest;
                if let Some(verdict) = report.verdict {
                    judged.usable = verdict.usable;
                    judged.reasons = verdict.reasons.iter().map(ToString::to_string).collect();
                }
            }
            Err(GaitOfChampionError::Setup(error)) => return Err(error),
            Err(error) => judged.reasons.push(error.to_string()),
        }
        Ok(judged)
    }

    /// What the plain movement is measured by, m: the distance of a run, the rise of a jump.
    pub fn measure(&self, movement: &str) -> Option<f64> {
        match movement {
            // What never leaves the ground does not rise.
            "jumping" => self.rise_m.or(self.distance_m.map(|_| 0.0)),
            _ => self.distance_m,
        }
    }
}

impl RunResult {
    /// What an ended run left, its champion judged.
    pub(super) fn read(
        job: Job<'_>,
        folder: &RunFolder,
        threads: usize,
        registry: &Registry,
    ) -> Result<Self, TrainError> {
        let config = folder.read_config()?;
        check_lines(folder, &config)?;
        let (log, timing) = (folder.read_log()?, folder.read_timing()?);
        let champion = read_champion(folder, &config)?;
        let Cell { preset, scenario, .. } = job.cell();
        Ok(Self {
            preset: preset.name.clone(),
            creature: scenario.creature.into(),
            movement: scenario.movement.into(),
            seed: config.seed,
            settings: job.settings(),
            best: log.iter().map(|line| line.fitness.map(|fitness| fitness.best)).collect(),
            mean: log.iter().map(|line| line.fitness.map(|fitness| fitness.mean)).collect(),
            champion: champion.map(|champion| Judged::of(&champion, registry)).transpose()?,
            threads,
            seconds: timing.iter().map(|line| line.seconds).sum(),
        })
    }
}
