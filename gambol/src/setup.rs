//! From a configuration to the things a run is made of.

use crate::Registry;
use crate::{
    bodies,
    config::{ControllerSettings, EngineChoice, FrozenTopology, HeatSettings, RunConfig, StrategySettings},
    gait::Stage,
    limbs::{self, Limbs},
    shaping,
    strategies::StrategyError,
    suggest,
};
use creatures::{Actuation, Blueprint, Channel, Creature, CreatureError, Sensor, Terrain};
use envs_lanes::{LaneEnvironment, LaneEpisode};
use envs_rapier::{EnvironmentError, PhysicsSettings, RapierEnvironment, Variation};
use ne_core::{Heat, Seed, SettingError};
use ne_net::{DenseShape, Topology};
use serde::{Deserialize, Serialize};
use tasks::{Combine, Episode, Medium, Movement, MovementSpec, MovementSpecError, TermSpec, Trials};

pub use crate::{bodies::SeveralBodies, nominal::Nominal, training_task::TrainingTask};

/// The task and the topology of the controller a configuration describes: checked, built, ready.
#[derive(Clone)]
pub struct Setup {
    /// The task of training.
    pub task: TrainingTask,
    /// What comes before it.
    heats: Vec<HeatSettings>,
    /// The same in rapier: what is shown and proved.
    pub episode: Episode<RapierEnvironment>,
    /// Where the champion is chosen, if a [jury](RunConfig::has_jury) does that.
    pub nominal: Option<Nominal>,
    /// The controller without its weights. NEAT finds another one with as many inputs and outputs.
    pub topology: Topology,
    /// What each weight of the topology is for; equal names in two topologies mean the same.
    pub weight_names: Vec<String>,
    /// The unit of the fitness.
    pub unit: String,
    /// What a strategy that searches for several objectives finds compromises between; the fitness alone if the
    /// movement has no objectives.
    pub objectives: Vec<Objective>,
}

/// One of the objectives of a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Objective {
    /// The name of what is measured.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// What the measured value is multiplied with to be maximised: below 0 where less is better.
    pub weight: f64,
}

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
    #[error("{0}")]
    Setting(#[from] SettingError),
    /// The topology was made for another creature, or for other sensors.
    #[error("the topology does not fit the creature: {0}")]
    Topology(String),
    /// A companion cannot be built, or its inputs and outputs are not those of the creature.
    #[error("companions[{index}] (\"{name}\"): {problem}")]
    Companion {
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
    #[error("{0}")]
    Environment(#[from] EnvironmentError),
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
}

/// Varied worlds a finalist is proved in.
const PROOFS: u32 = 4;

impl EpisodeParts<'_> {
    /// Builds the task.
    ///
    /// # Errors
    /// Names the field that is wrong.
    pub fn build(&self, registry: &Registry) -> Result<Episode<RapierEnvironment>, SetupError> {
        let (movement, steps, blueprint) = self.pieces(registry)?;
        let sensors = self.sensors.unwrap_or(&self.creature.sensors);
        let variation = self.variation.for_trials(self.trials.count);
        let (physics, terrain) = (self.physics, self.terrain.clone());
        let environment =
            RapierEnvironment::on_terrain(blueprint, sensors, self.input_range, physics, variation, terrain)?
                .with_actuation(self.actuation)?;
        Ok(Episode::new(environment, movement, steps, self.trials)?)
    }

    /// Builds the task for many creatures at once.
    ///
    /// # Errors
    /// Names the field that is wrong, or what only rapier can do.
    pub fn build_lanes(&self, registry: &Registry) -> Result<LaneEpisode, SetupError> {
        let (movement, steps, blueprint) = self.pieces(registry)?;
        let sensors = self.sensors.unwrap_or(&self.creature.sensors);
        let variation = self.variation.for_trials(self.trials.count);
        let (physics, terrain) = (self.physics, self.terrain.clone());
        let environment =
            LaneEnvironment::on_terrain(blueprint, sensors, self.input_range, physics, variation, terrain)
                .and_then(|environment| environment.with_actuation(self.actuation))
                .map_err(SetupError::Engine)?;
        Ok(LaneEpisode::new(environment, movement, steps, self.trials)?)
    }

    /// What both engines are given: the movement, the steps of an episode and the body.
    fn pieces(&self, registry: &Registry) -> Result<(Box<dyn Movement>, u32, Blueprint), SetupError> {
        let movement = registry.movements.build(self.movement)?;
        let steps = registry.movements.steps(self.movement)?;
        Ok((movement, steps, Blueprint::new(self.creature.clone())?))
    }

    /// The same without variation, and with one trial: more would all be alike.
    #[must_use]
    pub fn nominal(self) -> Self {
        Self { trials: Trials::default(), variation: Variation::default(), ..self }
    }

    /// The same in as many varied worlds as a champion is proved in.
    fn proof(self) -> Self {
        Self { trials: Trials { count: PROOFS, combine: Combine::Mean }, ..self }
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

impl Setup {
    /// Checks a configuration and builds its task.
    ///
    /// # Errors
    /// Names the field that is wrong.
    pub fn new(config: &RunConfig, registry: &Registry) -> Result<Self, SetupError> {
        config.stop.validate().map_err(|error| error.within("stop"))?;
        config.record.validate().map_err(|error| error.within("record"))?;
        let input_range = f64::from(config.controller.input_range);
        SettingError::check_range("input_range", input_range, 0.001, 1000.0)
            .map_err(|error| error.within("controller"))?;
        if let Actuation::Angle { gain } = config.controller.actuation
            && !config.controller.actuation.is_valid()
        {
            let [low, high] = Actuation::GAINS;
            let error = SettingError::new("actuation.angle.gain", gain, format!("from {low} to {high}"));
            return Err(error.within("controller").into());
        }
        let is_in_water = registry.movements.find(&config.movement.name).is_some_and(|it| it.medium == Medium::Water);
        if is_in_water && config.physics.water.is_none() {
            let allowed = format!("water, which {} is done in", config.movement.name);
            return Err(SettingError::new("physics.water", "null", allowed).into());
        }
        let parts = config.episode_parts();
        let (episode, task) = parts.build_both(config.engine, registry)?;
        let (senses, motors) = (episode.environment().senses().channels(), episode.environment().motors().channels());
        let shape = config.controller.shape(senses.len(), motors.len()).map_err(|error| error.within("controller"))?;
        let entry = registry.strategies.of(&config.strategy)?;
        let mut weight_names = None;
        let topology = match &config.topology {
            None => match config.controller.limbs {
                None => shape.into(),
                Some(phases) => {
                    let environment = episode.environment();
                    let Limbs { topology, names } = limbs::topology(
                        environment.blueprint(),
                        environment.senses(),
                        environment.motors(),
                        &config.controller,
                        phases,
                    );
                    weight_names = Some(names);
                    topology.into()
                }
            },
            Some(_) if entry.finds_topology() => return Err(SetupError::Evolving { strategy: entry.name().into() }),
            Some(frozen) => frozen.fitting(senses, motors)?,
        };
        let weight_names = weight_names.unwrap_or_else(|| shaping::weight_names(&topology, senses, motors));
        registry.strategies.validate(&config.strategy, &topology)?;
        check_size(&config.strategy, &topology)?;
        let unit = registry.movements.build(&config.movement)?.unit().to_owned();
        let objectives = objectives(&config.movement, registry, &unit);
        if let Some(steps) = config.rehearsal {
            SettingError::check_range("rehearsal", steps.into(), 1.0, 1e6)?;
        }
        let nominal = match config.has_jury() {
            false => None,
            true => {
                let (episode, task) = parts.nominal().build_both(config.engine, registry)?;
                let stage = Stage::new(parts, registry)?;
                let proof = match config.variation.is_none() {
                    true => None,
                    false => Some(parts.proof().build_both(config.engine, registry)?.1),
                };
                Some(Nominal::new(task, episode, proof, stage, Seed::of_run(config.seed)))
            }
        };
        if config.stop.grade.is_some() && nominal.as_ref().is_none_or(|nominal| nominal.stage.is_none()) {
            let judged: Vec<&str> = registry.movements.judged().collect();
            let allowed = format!(
                "null where no gaits are judged during training: only those of {} are, and only in runs with a variation, a \
                 rehearsal or companions",
                judged.join(", ")
            );
            return Err(SettingError::new("stop.grade", "a grade (--until usable)", allowed).into());
        }
        let task = bodies::with_companions(config, task, [senses, motors], registry)?;
        let task = match config.rehearsal {
            Some(steps) => task.shortened(steps),
            None => task,
        };
        HeatSettings::validate(&config.heats, task.steps(), config.trials.count)?;
        Ok(Self { task, heats: config.heats.clone(), episode, nominal, topology, weight_names, unit, objectives })
    }

    /// The heats that come before the task of training, the first one first.
    pub fn heats(&self) -> Vec<Heat> {
        let heat = |&HeatSettings { steps, trials, share }: &HeatSettings| {
            let task = self.task.shortened(steps.unwrap_or(u32::MAX));
            Heat { task: Box::new(task.with_fewer_trials(trials.unwrap_or(u32::MAX))), share }
        };
        self.heats.iter().map(heat).collect()
    }

    /// What each input of the controller is.
    pub fn inputs(&self) -> &[Channel] {
        self.episode.environment().senses().channels()
    }

    /// What each output of the controller does.
    pub fn outputs(&self) -> &[Channel] {
        self.episode.environment().motors().channels()
    }
}

/// What is measured for a search with several objectives, or else the fitness.
fn objectives(movement: &MovementSpec, registry: &Registry, unit: &str) -> Vec<Objective> {
    if movement.objectives.is_empty() {
        return vec![Objective { name: "fitness".into(), unit: unit.into(), weight: 1.0 }];
    }
    let objective = |spec: &TermSpec| Objective {
        name: spec.term.clone(),
        unit: registry.movements.find(&spec.term).map_or_else(String::new, |entry| entry.unit.clone()),
        weight: spec.weight,
    };
    movement.objectives.iter().map(objective).collect()
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
        }
    }
}

/// The most weights that a population has altogether: 1 GiB of them.
const MOST_WEIGHTS: usize = 1 << 28;

/// Checks that a population fits into memory.
fn check_size(strategy: &StrategySettings, topology: &Topology) -> Result<(), SettingError> {
    let (Some(population), weights) = (strategy.population(), topology.weight_count()) else { return Ok(()) };
    let most = MOST_WEIGHTS / weights.max(1);
    if population <= most {
        return Ok(());
    }
    let field = format!("strategy.{}.population", strategy.name());
    Err(SettingError::new(field, population, format!("at most {most} for nets of {weights} weights")))
}

impl FrozenTopology {
    /// The topology, if it was made for these inputs and outputs.
    fn fitting(&self, senses: &[Channel], motors: &[Channel]) -> Result<Topology, SetupError> {
        self.net.validate().map_err(|error| error.within("topology.net"))?;
        for (what, mine, count, channels) in [
            ("inputs", &self.inputs, self.net.inputs(), senses),
            ("outputs", &self.outputs, self.net.outputs(), motors),
        ] {
            if mine.len() != count {
                let allowed = format!("{count} names, one for each of the net's");
                return Err(SettingError::new(what, format!("{} names", mine.len()), allowed)
                    .within("topology")
                    .into());
            }
            if let Some(difference) = difference("topology", what, mine, channels) {
                return Err(SetupError::Topology(difference));
            }
        }
        Ok(self.net.clone())
    }
}

/// Says how the names of the inputs or outputs of a topology, or of something else, differ from those of the creature.
pub(crate) fn difference(whose: &str, what: &str, mine: &[String], channels: &[Channel]) -> Option<String> {
    let theirs: Vec<&String> = channels.iter().map(|channel| &channel.name).collect();
    let only = |names: Vec<&String>| names.into_iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let missing = only(mine.iter().filter(|name| !theirs.contains(name)).collect());
    let new = only(theirs.iter().copied().filter(|name| !mine.contains(name)).collect());
    let counts = format!("it has {} {what}, the creature has {}", mine.len(), theirs.len());
    match (missing.is_empty(), new.is_empty()) {
        (true, true) => {
            let place = mine.iter().zip(&theirs).position(|(mine, theirs)| mine != *theirs)?;
            let (mine, theirs) = (&mine[place], theirs[place]);
            Some(format!("its {what} are in another order: \"{mine}\" where the creature has \"{theirs}\""))
        }
        (false, true) => Some(format!("{counts}; {missing} is not among the creature's")),
        (true, false) => Some(format!("{counts}; {new} is not among the {whose}'s")),
        (false, false) => Some(format!("{counts}; only the {whose} has {missing}, only the creature has {new}")),
    }
}

impl ControllerSettings {
    /// The shape of a controller with these settings.
    ///
    /// # Errors
    /// If a layer is empty or too wide, or the scale is out of range.
    pub fn shape(&self, inputs: usize, outputs: usize) -> Result<DenseShape, SettingError> {
        let shape = DenseShape {
            inputs,
            hidden: self.hidden.clone(),
            outputs,
            hidden_activation: self.hidden_activation,
            output_activation: self.output_activation,
            hidden_scale: self.hidden_scale,
        };
        shape.validate()?;
        Ok(shape)
    }
}
