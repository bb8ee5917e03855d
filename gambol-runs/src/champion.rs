//! The champion file: a controller with all it needs to move its creature again, and the proof that it does.

use crate::Registry;
use crate::{
    config::{EngineChoice, RunConfig},
    episode_parts::{EpisodeParts, SetupError},
    setup::Setup,
    trajectory::{TrajectoryDigest, replay},
};
use creatures::{Actuation, Channel, Creature, Sensor, Terrain};
use envs_rapier::{PhysicsSettings, RAPIER_VERSION, RapierEnvironment, Variation};
use ne_core::{
    Evaluation, Fitness, Genome, Seed, SettingError,
    archive::{self, ArchiveError, Layout},
};
use ne_net::Network;
use serde::{Deserialize, Serialize};
use std::path::Path;
use tasks::{Commands, Episode, MovementSpec, Trials};

/// The format of a champion file.
pub const CHAMPION_FORMAT: &str = "gambol champion";

/// The version of the champion file this Gambol writes and reads.
pub const CHAMPION_VERSION: u32 = 2;

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
    /// What outputs mean to motors.
    #[serde(default)]
    pub actuation: Actuation,
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
    /// What it moves on.
    #[serde(default, skip_serializing_if = "Terrain::is_default")]
    pub terrain: Terrain,
    /// What it is told to do; none: nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commands: Option<Commands>,
    /// The engine that gives its fitness and its trajectory, and its version.
    pub engine: Engine,
    /// The seed it was evaluated with.
    pub seed: Seed,
    /// The generation it was found in, from 1; 0 for one from before the run.
    pub generation: u64,
    /// The strategy that found it.
    pub strategy: String,
    /// Its fitness.
    pub fitness: Fitness,
    /// What it did in the first trial.
    pub trajectory: TrajectoryDigest,
    /// What it was in training, if that was in another engine, in varied worlds, in shorter episodes or in several
    /// bodies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trained: Option<Training>,
}

/// What a champion was in training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Training {
    /// The engine it was trained in.
    pub engine: EngineChoice,
    /// Its fitness there, in the worlds of its generation; `None` for one that no generation evaluated: one from before the run, or
    /// what the strategy recommended.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fitness: Option<Fitness>,
    /// Trials that fitness is made of.
    pub trials: Trials,
    /// How those trials differed.
    pub variation: Variation,
    /// Bodies that fitness is over: the creature and its further bodies; 1 without further bodies.
    #[serde(default = "one_body", skip_serializing_if = "is_one_body")]
    pub bodies: usize,
    /// Whether the engine of training gives it, in the champion's world, another fitness than rapier.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub diverged: bool,
}

fn one_body() -> usize {
    1
}

fn is_one_body(bodies: &usize) -> bool {
    *bodies == 1
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
    /// How many steps of its physics so many seconds are.
    ///
    /// # Errors
    /// If there are none, or more than a million.
    pub fn steps_in(&self, seconds: f64) -> Result<u32, SettingError> {
        let steps = seconds / f64::from(self.physics.time_step);
        match (1.0..=1e6).contains(&steps) {
            true => Ok(steps.round() as u32),
            false => Err(SettingError::new("seconds", seconds, "from 1 to 1000000 steps of the physics")),
        }
    }

    /// Plays a champion once more, in rapier, and records what it does.
    pub fn new<G: Genome<Phenotype: Into<Network>>>(
        config: &RunConfig,
        setup: &Setup,
        strategy: &str,
        champion: &ne_core::Champion<G>,
    ) -> Self {
        let ne_core::Champion { seed, generation, fitness, trained, diverged, .. } = *champion;
        let network: Network = champion.genome.express().into();
        let (trials, variation, (trajectory, evaluation)) = match &setup.reference {
            Some(reference) => (reference.trials, Variation::default(), reference.replay(&network, seed)),
            None => (config.trials, config.variation, replay(&setup.episode, config.trials, &network, seed)),
        };
        let training = (config.engine != EngineChoice::Rapier || setup.reference.is_some()).then(|| Training {
            engine: config.engine,
            fitness: trained,
            trials: config.trials,
            variation: config.variation,
            bodies: config.bodies(),
            diverged: diverged || Some(fitness) != evaluation.fitness(),
        });
        Self {
            creature: config.creature.clone(),
            movement: MovementSpec { steps: Some(setup.episode.steps()), ..config.movement.clone() },
            sensors: config.sensors.clone().unwrap_or_else(|| config.creature.sensors.clone()),
            input_range: config.controller.input_range,
            actuation: config.controller.actuation,
            inputs: setup.inputs().iter().map(Into::into).collect(),
            outputs: setup.outputs().iter().map(Into::into).collect(),
            network,
            trials,
            variation,
            physics: config.physics,
            terrain: config.terrain.clone(),
            commands: config.commands.clone(),
            engine: Engine::current(),
            seed,
            generation,
            strategy: strategy.into(),
            fitness: evaluation.fitness().unwrap_or(fitness),
            trajectory,
            trained: training,
        }
    }

    /// Its fitness in training, if that is another than the champion's own.
    pub fn fitness_in_training(&self) -> Option<Fitness> {
        self.trained.and_then(|trained| trained.fitness).filter(|&fitness| fitness != self.fitness)
    }

    /// Whether the engine of training and rapier disagree about it.
    pub fn diverged(&self) -> bool {
        self.trained.is_some_and(|trained| trained.diverged)
    }

    /// Reads a champion file.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another format or version; the error names file and field.
    pub fn read(path: &Path) -> Result<Self, ArchiveError> {
        archive::read(path, CHAMPION_FORMAT, CHAMPION_VERSION)
    }

    /// The champion of a file with this text; `path`: what the file is called in an error.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn from_text(path: &Path, text: &str) -> Result<Self, ArchiveError> {
        archive::parse(path, text.as_bytes(), CHAMPION_FORMAT, CHAMPION_VERSION)
    }

    /// Writes the champion file, whole or not at all.
    ///
    /// # Errors
    /// If it cannot be written; an older file is then still there.
    pub fn write(&self, path: &Path) -> Result<(), ArchiveError> {
        archive::write(path, CHAMPION_FORMAT, CHAMPION_VERSION, self, Layout::Pretty)
    }

    /// In what this cannot be the champion of a run with such a configuration; `None`: it may be.
    pub(crate) fn differs_from(&self, config: &RunConfig) -> Option<&'static str> {
        // A configuration may leave the length of an episode to the movement.
        let movement = MovementSpec { steps: config.movement.steps, ..self.movement.clone() };
        let differs = [
            (self.creature != config.creature, "the creature"),
            (movement != config.movement, "the movement"),
            (self.physics != config.physics, "the physics"),
            (self.terrain != config.terrain, "the terrain"),
            (self.commands != config.commands, "the commands"),
            (self.input_range != config.controller.input_range, "controller.input_range"),
            (self.actuation != config.controller.actuation, "controller.actuation"),
            (self.strategy != config.strategy.name(), "the strategy"),
            (self.seed.run_seed() != config.seed, "the seed"),
        ];
        differs.into_iter().find_map(|(differs, what)| differs.then_some(what))
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
            terrain: &self.terrain,
            actuation: self.actuation,
            commands: self.commands.as_ref(),
        }
    }

    /// Builds the task the champion was evaluated on.
    ///
    /// # Errors
    /// If a field is out of range, the movement is unknown, or inputs and outputs are not those of the body.
    pub fn episode(&self, registry: &Registry) -> Result<Episode<RapierEnvironment>, SetupError> {
        let episode = self.episode_parts().build(registry)?;
        let environment = episode.environment();
        check_channels("inputs", &self.inputs, environment.senses().channels())?;
        check_channels("outputs", &self.outputs, environment.motors().channels())?;
        Ok(episode)
    }

    /// Replays the champion and compares it with what the file says.
    ///
    /// # Errors
    /// If the task cannot be built.
    pub fn verify(&self, registry: &Registry) -> Result<Verification, SetupError> {
        let episode = self.episode(registry)?;
        let (trajectory, evaluation) = replay(&episode, self.trials, &self.network, self.seed);
        let diverges_at = self.trajectory.first_difference(&trajectory);
        Ok(Verification { evaluation, recorded: self.fitness, diverges_at })
    }
}

/// Checks that what a file says of inputs or outputs is what the body has: a game goes by it.
fn check_channels(field: &str, said: &[ChannelRecord], body: &[Channel]) -> Result<(), SetupError> {
    let wrong = |field: String, found: String, expected: String| Err(SetupError::Channel { field, found, expected });
    if said.len() != body.len() {
        return wrong(field.into(), format!("{} of them", said.len()), format!("{}", body.len()));
    }
    for (index, (said, body)) in said.iter().zip(body).enumerate() {
        let at = |name: &str| format!("{field}[{index}].{name}");
        let body = ChannelRecord::from(body);
        if said.name != body.name {
            return wrong(at("name"), format!("\"{}\"", said.name), format!("\"{}\"", body.name));
        }
        if said.unit != body.unit {
            return wrong(at("unit"), format!("\"{}\"", said.unit), format!("\"{}\"", body.unit));
        }
        if said.range != body.range {
            return wrong(at("range"), format!("{:?}", said.range), format!("{:?}", body.range));
        }
    }
    Ok(())
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
