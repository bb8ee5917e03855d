//! The gait of a champion: measured and judged as it moves in rapier.

use crate::{
    champion::Champion,
    obstacles::ObstaclesPassed,
    setup::{EpisodeParts, SetupError},
    trajectory::Recording,
};
use envs_core::{Conditions, Ground, Landscape};
use envs_rapier::{RapierEnvironment, Variation};
use ne_core::Seed;
use ne_net::Network;
use serde::Serialize;
use tasks::{
    Environment, Episode, MovementCatalogue, MovementSpec, Trials,
    gait::{GaitReport, Kind, Trajectory},
};

/// A world in which gaits are judged: rapier, the settled start pose, no variation, and as many seconds as the judgement
/// asks for. Nothing ends the episode early.
#[derive(Clone)]
pub struct Stage {
    episode: Episode<RapierEnvironment>,
    movement: MovementSpec,
    kind: Option<Kind>,
    flat: bool,
}

/// The least [grade](ne_core::Judgement::grades) of a champion whose gait is usable. Those whose gait is usable in perturbed
/// worlds too have up to 4 more; a champion that is not usable has 0.
pub const USABLE: u8 = 1;

/// A movement that is not judged is watched for so long, s.
const UNJUDGED_SECONDS: f64 = 20.0;

impl Stage {
    /// The stage for a creature with its sensors, motors and physics.
    ///
    /// # Errors
    /// If a field is out of range or the movement is unknown.
    pub fn new(parts: EpisodeParts<'_>, catalogue: &MovementCatalogue) -> Result<Self, SetupError> {
        parts.physics.validate().map_err(|error| error.within("physics"))?;
        let kind = Kind::of(&parts.movement.name);
        let steps = Some(judged_steps(kind, parts.physics.time_step));
        let movement = MovementSpec { steps, terms: Vec::new(), objectives: Vec::new(), ..parts.movement.clone() };
        let parts =
            EpisodeParts { movement: &movement, trials: Trials::default(), variation: Variation::default(), ..parts };
        let episode = parts.build(catalogue)?;
        let flat = *episode.environment().ground() == Ground::flat();
        Ok(Self { episode, movement, kind, flat })
    }

    /// The same stage in another world: under these conditions, on this ground or in this landscape.
    ///
    /// # Errors
    /// If the world makes no sense, the creature does not come to rest in it, or the movement is unknown.
    pub fn under(
        &self,
        conditions: &Conditions,
        landscape: impl Into<Landscape>,
        catalogue: &MovementCatalogue,
    ) -> Result<Self, SetupError> {
        let environment = self.episode.environment().under(conditions, landscape)?;
        let flat = *environment.ground() == Ground::flat();
        let steps = judged_steps(self.kind, environment.settings().time_step);
        let episode = Episode::new(environment, catalogue.build(&self.movement)?, steps, Trials::default())?;
        Ok(Self { episode, flat, ..self.clone() })
    }

    /// The creature in this world.
    pub fn environment(&self) -> &RapierEnvironment {
        self.episode.environment()
    }

    /// How long an episode lasts here, in steps.
    pub fn steps(&self) -> u32 {
        self.episode.steps()
    }

    /// How a gait is judged here, if it is.
    pub fn kind(&self) -> Option<Kind> {
        self.kind
    }

    /// What a controller does here. A body that explodes, and a controller of another shape, leave a short recording.
    pub fn record(&self, network: &Network) -> Recording {
        let mut recording = Recording::default();
        // Without variation nothing comes from the seed.
        self.episode.play(&mut network.clone(), Seed::of_run(0), &mut recording);
        recording
    }

    /// Measures what a controller does here; `None` for one that falls silent at once: there is nothing to measure.
    pub fn judge(&self, network: &Network) -> Option<GaitReport> {
        self.measure(network).map(|gait| gait.report)
    }

    /// The same, and how many obstacles it passes.
    pub fn measure(&self, network: &Network) -> Option<Gait> {
        let recording = self.record(network);
        let environment = self.episode.environment();
        let trajectory = Trajectory::new(environment.body()?, &recording.snapshots).ok()?;
        let trajectory = if self.flat { trajectory } else { trajectory.on_terrain() };
        let report = GaitReport::of(&trajectory, self.kind);
        Some(Gait { report, obstacles: ObstaclesPassed::count(environment.landscape(), &recording.snapshots) })
    }

    /// Whether a controller's gait is usable here; never for a movement that is not judged.
    pub fn is_usable(&self, network: &Network) -> bool {
        self.judge(network).and_then(|report| report.verdict).is_some_and(|judgement| judgement.usable)
    }
}

/// A gait, and how far it got on its terrain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gait {
    /// What was measured of it.
    #[serde(flatten)]
    pub report: GaitReport,
    /// How many obstacles of each kind it passed; empty on flat ground.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<ObstaclesPassed>,
}

/// The steps of an episode as long as the judgement asks for.
fn judged_steps(kind: Option<Kind>, time_step: f32) -> u32 {
    let seconds = kind.map_or(UNJUDGED_SECONDS, Kind::judged_seconds);
    (seconds / f64::from(time_step)).round() as u32
}

/// Why a champion's gait cannot be told.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GaitOfChampionError {
    /// Its world cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Its body exploded, or its controller failed, before there was anything to measure.
    #[error("its episode breaks off before there is anything to measure")]
    Unmeasurable,
}

/// Replays a champion in rapier, for as long as the judgement asks for, and measures its gait.
///
/// # Errors
/// If a field of the champion is out of range, its movement is unknown, or there is nothing to measure.
pub fn judge(champion: &Champion, catalogue: &MovementCatalogue) -> Result<GaitReport, GaitOfChampionError> {
    measure(champion, catalogue).map(|gait| gait.report)
}

/// The same, and how many obstacles it passes.
///
/// # Errors
/// As [`judge`].
pub fn measure(champion: &Champion, catalogue: &MovementCatalogue) -> Result<Gait, GaitOfChampionError> {
    let stage = Stage::new(champion.episode_parts(), catalogue)?;
    stage.measure(&champion.network).ok_or(GaitOfChampionError::Unmeasurable)
}
