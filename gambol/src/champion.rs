//! The champion file: a controller with all it needs to move its creature again, and the proof that it does.

use crate::{
    config::RunConfig,
    setup::{EpisodeParts, Setup, SetupError},
    trajectory::{TrajectoryDigest, TrajectoryDigester},
};
use creatures::{Channel, Creature, Sensor};
use envs_rapier::{PhysicsSettings, RAPIER_VERSION, RapierEnvironment, Variation};
use ne_core::{
    Evaluation, Fitness, Phenotype, Seed, Task,
    archive::{self, ArchiveError, Layout},
};
use ne_net::Network;
use serde::{Deserialize, Serialize};
use std::path::Path;
use tasks::{Episode, MovementCatalogue, MovementSpec, Trials};

/// The format of a champion file.
pub const CHAMPION_FORMAT: &str = "gambol champion";

/// The version of the champion file this Gambol writes and reads.
pub const CHAMPION_VERSION: u32 = 1;

/// A saved champion. A game needs `creature`, `inputs`, `outputs`, `network` and the settings of the physics; the rest
/// is for repeating and proving it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Champion {
    /// The body.
    pub creature: Creature,
    /// What it has learned.
    pub movement: MovementSpec,
    /// What the controller senses.
    pub sensors: Vec<Sensor>,
    /// Sensors are scaled to ± this.
    pub input_range: f32,
    /// Each input of the network, in order.
    pub inputs: Vec<ChannelRecord>,
    /// Each output of the network, in order; −1 and 1 are the ends of its range.
    pub outputs: Vec<ChannelRecord>,
    /// The controller.
    pub network: Network,
    /// Trials its fitness is made of.
    pub trials: Trials,
    /// How trials differ.
    pub variation: Variation,
    /// The physics it learned in.
    pub physics: PhysicsSettings,
    /// The engine it learned in, and its version.
    pub engine: Engine,
    /// The seed it was evaluated with.
    pub seed: Seed,
    /// The generation it was found in, from 1.
    pub generation: u64,
    /// The strategy that found it.
    pub strategy: String,
    /// Its fitness.
    pub fitness: Fitness,
    /// What it did in the first trial.
    pub trajectory: TrajectoryDigest,
}

/// One number between body and network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChannelRecord {
    /// What it is.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The lowest and the highest value, which the network sees as ∓ its input range or gives as ∓ 1.
    pub range: [f32; 2],
}

/// A physics engine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Engine {
    /// Its name.
    pub name: String,
    /// Its exact version.
    pub version: String,
}

impl Engine {
    /// The engine this Gambol is built with.
    pub fn current() -> Self {
        Self { name: "rapier2d".into(), version: RAPIER_VERSION.into() }
    }
}

impl From<&Channel> for ChannelRecord {
    fn from(channel: &Channel) -> Self {
        Self { name: channel.name.clone(), unit: channel.unit.into(), range: channel.range }
    }
}

impl Champion {
    /// Evaluates a controller once more, records what it does, and makes a champion of it.
    pub fn new(
        config: &RunConfig,
        setup: &Setup,
        strategy: &str,
        network: Network,
        seed: Seed,
        generation: u64,
        fitness: Fitness,
    ) -> Self {
        let trajectory = digest(&setup.episode, &mut network.clone(), seed);
        Self {
            creature: config.creature.clone(),
            movement: MovementSpec { steps: Some(setup.episode.steps()), ..config.movement.clone() },
            sensors: config.sensors.clone().unwrap_or_else(|| config.creature.sensors.clone()),
            input_range: config.controller.input_range,
            inputs: setup.inputs().iter().map(Into::into).collect(),
            outputs: setup.outputs().iter().map(Into::into).collect(),
            network,
            trials: config.trials,
            variation: config.variation,
            physics: config.physics,
            engine: Engine::current(),
            seed,
            generation,
            strategy: strategy.into(),
            fitness,
            trajectory,
        }
    }

    /// Reads a champion file.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another format or version; the error names file and field.
    pub fn read(path: &Path) -> Result<Self, ArchiveError> {
        archive::read(path, CHAMPION_FORMAT, CHAMPION_VERSION)
    }

    /// Writes the champion file, whole or not at all.
    ///
    /// # Errors
    /// If it cannot be written; an older file is then still there.
    pub fn write(&self, path: &Path) -> Result<(), ArchiveError> {
        archive::write(path, CHAMPION_FORMAT, CHAMPION_VERSION, self, Layout::Pretty)
    }

    /// The part that makes the task.
    pub fn episode_parts(&self) -> EpisodeParts<'_> {
        EpisodeParts {
            creature: &self.creature,
            sensors: Some(&self.sensors),
            input_range: self.input_range,
            movement: &self.movement,
            trials: self.trials,
            variation: self.variation,
            physics: self.physics,
        }
    }

    /// Builds the task the champion was evaluated on.
    ///
    /// # Errors
    /// If a field is out of range or the movement is unknown.
    pub fn episode(&self, catalogue: &MovementCatalogue) -> Result<Episode<RapierEnvironment>, SetupError> {
        self.episode_parts().build(catalogue)
    }

    /// Replays the champion and compares it with what the file says.
    ///
    /// # Errors
    /// If the task cannot be built.
    pub fn verify(&self, catalogue: &MovementCatalogue) -> Result<Verification, SetupError> {
        let episode = self.episode(catalogue)?;
        let mut network = self.network.clone();
        let evaluation = episode.evaluate(&mut network, self.seed);
        let shape_fits = episode.check_shape(&network).is_ok();
        let trajectory =
            if shape_fits { digest(&episode, &mut network, self.seed) } else { TrajectoryDigest::default() };
        let diverges_at = self.trajectory.first_difference(&trajectory);
        Ok(Verification { evaluation, recorded: self.fitness, diverges_at })
    }
}

/// Plays the first trial and digests it.
fn digest(episode: &Episode<RapierEnvironment>, phenotype: &mut dyn Phenotype, seed: Seed) -> TrajectoryDigest {
    let mut digester = TrajectoryDigester::default();
    episode.play(phenotype, seed.trial(0), &mut digester);
    digester.finish()
}

/// What a replay of a champion showed.
#[derive(Clone, Debug, PartialEq)]
pub struct Verification {
    /// What the replay gave.
    pub evaluation: Evaluation,
    /// The fitness in the file.
    pub recorded: Fitness,
    /// The first step at which the replay left the recorded trajectory; 0 is the start.
    pub diverges_at: Option<u32>,
}

impl Verification {
    /// Whether the replay did the same, to the bit, and is worth the same.
    pub fn is_identical(&self) -> bool {
        self.diverges_at.is_none() && self.evaluation.fitness() == Some(self.recorded)
    }
}
