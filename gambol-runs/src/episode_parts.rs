//! What an episode is made of, and the task that comes of it.

use crate::{
    Registry,
    catalogue::UnknownName,
    config::{EngineChoice, RunConfig},
    strategies::StrategyError,
    suggest,
    training_task::TrainingTask,
};
use creatures::{Actuation, Blueprint, Creature, CreatureError, Sensor, Terrain};
use envs_lanes::{LaneEnvironment, LaneEpisode};
use envs_rapier::{EnvironmentError, PhysicsSettings, RapierEnvironment, Variation};
use ne_core::SettingError;
use tasks::{Commands, Episode, Movement, MovementSpec, MovementSpecError, Trials};

/// Why a configuration cannot be built. Each says which field.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// The creature is not valid.
    #[error("creature: {0}")]
    Creature(#[from] CreatureError),
    /// The movement is unknown or its terms are, or their settings are wrong.
    #[error("movement.{}", with_nearest(.0))]
    Movement(#[from] MovementSpecError),
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The topology was made for another creature, or for other sensors.
    #[error("the topology does not fit the creature: {0}")]
    Topology(String),
    /// A further body cannot be built, or its inputs and outputs are not those of the creature.
    #[error("further_bodies[{index}] (\"{name}\"): {problem}")]
    FurtherBody {
        /// Which, from 0.
        index: usize,
        /// Its name.
        name: String,
        /// What is wrong with it.
        problem: Box<SetupError>,
    },
    /// Two bodies cannot have one net.
    #[error("one net cannot move it and the creature: {0}")]
    Channels(String),
    /// What a champion file says of an input or output is not what the body has.
    #[error("{field}: {found}, where the creature with these sensors and motors has {expected}")]
    Channel {
        /// Which.
        field: String,
        /// What the file says.
        found: String,
        /// What the body has.
        expected: String,
    },
    /// A topology is given to a strategy that searches for one.
    #[error("topology: {strategy} finds its own, and cannot keep one; choose another strategy for its weights")]
    Evolving {
        /// The strategy.
        strategy: String,
    },
    /// There is no such strategy, or its settings are wrong.
    #[error(transparent)]
    Strategy(#[from] StrategyError),
    /// The physics cannot build it.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
    /// There is no such sensor, or its settings are wrong.
    #[error(transparent)]
    Sensor(#[from] UnknownName),
    /// Lanes cannot ask a sensor of another crate.
    #[error("engine: lanes cannot ask \"{name}\", a sensor of another crate; train it with --engine rapier")]
    SensorInLanes {
        /// The sensor.
        name: String,
    },
    /// The engine of training cannot do what rapier can.
    #[error("engine: {0}; train it with --engine rapier")]
    Engine(EnvironmentError),
}

fn with_nearest(error: &MovementSpecError) -> String {
    match error {
        MovementSpecError::Unknown { name, known, .. } => {
            match suggest::nearest(name, known.iter().map(String::as_str)) {
                Some(nearest) => format!("{error}; did you mean \"{nearest}\"?"),
                None => error.to_string(),
            }
        }
        MovementSpecError::Settings { field, message } => format!("{field}: {}", suggest::explain(message)),
        _ => error.to_string(),
    }
}

/// What an episode is made of: the part of a configuration that a champion keeps.
#[derive(Clone, Copy, Debug)]
pub struct EpisodeParts<'a> {
    /// The body.
    pub creature: &'a Creature,
    /// What the controller senses; `None`: what the creature asks for.
    pub sensors: Option<&'a [Sensor]>,
    /// Sensors are scaled to ± this.
    pub input_range: f32,
    /// What is learned.
    pub movement: &'a MovementSpec,
    /// Trials of an evaluation.
    pub trials: Trials,
    /// How trials differ.
    pub variation: Variation,
    /// The physics.
    pub physics: PhysicsSettings,
    /// What the creature moves on.
    pub terrain: &'a Terrain,
    /// What outputs mean to motors.
    pub actuation: Actuation,
    /// What the body is told to do; `None`: nothing.
    pub commands: Option<&'a Commands>,
}

/// Schedules of commands in which champions are compared.
const SCHEDULES: u32 = 8;

/// Varied worlds a candidate is proved in.
const PROOFS: u32 = 4;

impl EpisodeParts<'_> {
    fn goes_backwards(&self, registry: &Registry) -> bool {
        registry.movements.rules(&self.movement.name).is_some_and(|rules| rules.view().backwards)
    }

    /// Builds the task.
    ///
    /// # Errors
    /// Names the field that is wrong.
    pub fn build(&self, registry: &Registry) -> Result<Episode<RapierEnvironment>, SetupError> {
        let (movement, steps, blueprint) = self.pieces(registry)?;
        let sensors = registry.sensors.telling(self.sensors(), &blueprint)?;
        let variation = self.variation.for_trials(self.trials.count);
        let (physics, terrain) = (self.physics, self.terrain.clone());
        let environment =
            RapierEnvironment::on_terrain(blueprint, &sensors, self.input_range, physics, variation, terrain)?
                .going_backwards(self.goes_backwards(registry))
                .with_actuation(self.actuation)?
                .with_commands(self.commands.cloned(), self.trials.lessons)?;
        Ok(Episode::new(environment, movement, steps, self.trials)?)
    }

    /// Builds the task for many creatures at once.
    ///
    /// # Errors
    /// Names the field that is wrong, or what only rapier can do.
    pub fn build_lanes(&self, registry: &Registry) -> Result<LaneEpisode, SetupError> {
        let (movement, steps, blueprint) = self.pieces(registry)?;
        let sensors = self.sensors();
        if let Some(Sensor::Custom(custom)) = sensors.iter().find(|sensor| matches!(sensor, Sensor::Custom(_))) {
            return Err(SetupError::SensorInLanes { name: custom.name.clone() });
        }
        let variation = self.variation.for_trials(self.trials.count);
        let (physics, terrain) = (self.physics, self.terrain.clone());
        let environment =
            LaneEnvironment::on_terrain(blueprint, sensors, self.input_range, physics, variation, terrain)
                .and_then(|it| it.going_backwards(self.goes_backwards(registry)).with_actuation(self.actuation))
                .and_then(|environment| environment.with_commands(self.commands.cloned(), self.trials.lessons))
                .map_err(SetupError::Engine)?;
        Ok(LaneEpisode::new(environment, movement, steps, self.trials)?)
    }

    /// What both engines are given: the movement, the steps of an episode and the body.
    fn pieces(&self, registry: &Registry) -> Result<(Box<dyn Movement>, u32, Blueprint), SetupError> {
        let movement = registry.movements.build(self.movement)?;
        let steps = registry.movements.steps(self.movement)?;
        Ok((movement, steps, Blueprint::new(self.creature.clone())?))
    }

    fn sensors(&self) -> &[Sensor] {
        self.sensors.unwrap_or(&self.creature.sensors)
    }

    /// The same without variation, and with one trial: more would all be alike. A body that is told random commands has several,
    /// in each of which it is told something else: of one alone what was lucky would be the best for ever.
    #[must_use]
    pub fn reference(self) -> Self {
        let count = if matches!(self.commands, Some(Commands::Random(_))) { SCHEDULES } else { 1 };
        Self { trials: Trials { count, ..Trials::default() }, variation: Variation::default(), ..self }
    }

    /// The same in as many varied worlds as a champion is proved in.
    pub(crate) fn proof(self) -> Self {
        Self { trials: Trials { count: PROOFS, ..Trials::default() }, ..self }
    }

    /// Builds the task in rapier, and in the engine of training.
    pub(crate) fn build_both(
        &self,
        engine: EngineChoice,
        registry: &Registry,
    ) -> Result<(Episode<RapierEnvironment>, TrainingTask), SetupError> {
        // In rapier first: whatever is wrong with the settings is then not blamed on the engine.
        let episode = self.build(registry)?;
        let task = match engine {
            EngineChoice::Rapier => TrainingTask::Rapier(Box::new(episode.clone())),
            EngineChoice::Lanes => TrainingTask::Lanes(Box::new(self.build_lanes(registry)?)),
        };
        Ok((episode, task))
    }
}

impl RunConfig {
    /// The part that makes the task.
    pub fn episode_parts(&self) -> EpisodeParts<'_> {
        EpisodeParts {
            creature: &self.creature,
            sensors: self.sensors.as_deref(),
            input_range: self.controller.input_range,
            movement: &self.movement,
            trials: self.trials,
            variation: self.variation,
            physics: self.physics,
            terrain: &self.terrain,
            actuation: self.controller.actuation,
            commands: self.commands.as_ref(),
        }
    }
}
