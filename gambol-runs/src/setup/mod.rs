//! From a configuration to the things a run is made of.

mod further_bodies;

use crate::{
    Registry,
    champion_selection::highest_tier,
    config::{ControllerSettings, RecordSettings, RunConfig, RungSettings, StrategySettings},
    episode_parts::SetupError,
    judge::{Judge, TRAINING},
    reference::ReferenceEpisode,
    topology::{
        self,
        limbs::{self, LimbCopies},
    },
    training_task::TrainingTask,
};
use creatures::{Actuation, Channel};
use envs_rapier::RapierEnvironment;
use ne_core::{Seed, SettingError, champion_selection::ReEvaluations, successive_halving::Rung};
use ne_net::{DenseShape, Topology};
use serde::{Deserialize, Serialize};
use tasks::{Commands, Episode, Medium, MovementSpec, TermSpec};

/// The task and the topology of the controller a configuration describes: checked, built, ready.
#[derive(Clone)]
pub struct Setup {
    /// The task of training.
    pub task: TrainingTask,
    /// What comes before it.
    rungs: Vec<RungSettings>,
    /// The same in rapier: what is shown and proved.
    pub episode: Episode<RapierEnvironment>,
    /// Where the champion is chosen, if a [champion selection](RunConfig::has_champion_selection) does that.
    pub reference: Option<ReferenceEpisode>,
    /// The controller without its weights. NEAT finds another one with as many inputs and outputs.
    pub topology: Topology,
    /// What each weight of the topology is for; equal names in two topologies mean the same.
    pub weight_names: Vec<String>,
    /// What each weight is if it is added to what has been learned without it.
    pub(crate) by_hand: Vec<f32>,
    /// The names of the inputs and of the outputs of the net that is searched for: of a limb's, if a strategy that finds
    /// topologies finds one for all limbs.
    pub(crate) searched: [Vec<String>; 2],
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

impl Setup {
    /// Checks a configuration and builds its task.
    ///
    /// # Errors
    /// Names the field that is wrong.
    pub fn new(config: &RunConfig, registry: &Registry) -> Result<Self, SetupError> {
        config.stop.validate().map_err(|error| error.within("stop"))?;
        config.record.validate().map_err(|error| error.within("record"))?;
        SettingError::check_range("controller.input_range", config.controller.input_range, 0.001, 1000.0)?;
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
        let needs_commands =
            registry.movements.rules(&config.movement.name).is_some_and(|rules| rules.needs_commands());
        if needs_commands && config.commands.is_none() {
            let allowed = format!("commands, which {} is judged by", config.movement.name);
            return Err(SettingError::new("commands", "null", allowed).into());
        }
        if config.trials.lessons && !matches!(config.commands, Some(Commands::Random(_))) {
            let allowed = "false where no random commands are given: lessons are drawn of them";
            return Err(SettingError::new("trials.lessons", true, allowed).into());
        }
        let parts = config.episode_parts();
        let (episode, task) = parts.build_both(config.engine, registry)?;
        let (senses, motors) = (episode.environment().senses().channels(), episode.environment().motors().channels());
        let shape = config.controller.shape(senses.len(), motors.len()).map_err(|error| error.within("controller"))?;
        let entry = registry.strategies.of(&config.strategy)?;
        let names = |channels: &[Channel]| channels.iter().map(|channel| channel.name.clone()).collect::<Vec<_>>();
        let mut searched = [names(senses), names(motors)];
        let (mut weight_names, mut by_hand) = (None, None);
        let topology = match &config.topology {
            None => match config.controller.modular {
                None => shape.into(),
                Some(phases) if entry.finds_copied() => {
                    let environment = episode.environment();
                    let LimbCopies { topology, inputs, outputs } = limbs::copies(
                        environment.blueprint(),
                        environment.senses(),
                        environment.motors(),
                        &config.controller,
                        phases,
                    );
                    searched = [inputs, outputs];
                    topology.into()
                }
                Some(phases) => {
                    let environment = episode.environment();
                    let limbs = limbs::topology(
                        environment.blueprint(),
                        environment.senses(),
                        environment.motors(),
                        &config.controller,
                        phases,
                    );
                    (weight_names, by_hand) = (Some(limbs.names), Some(limbs.by_hand));
                    limbs.topology.into()
                }
            },
            Some(_) if entry.finds_topology() => return Err(SetupError::Evolving { strategy: entry.name().into() }),
            Some(frozen) => frozen.fitting(senses, motors)?,
        };
        let weight_names = weight_names.unwrap_or_else(|| topology::weight_names(&topology, senses, motors));
        let by_hand = by_hand.unwrap_or_else(|| vec![0.0; weight_names.len()]);
        registry.strategies.validate(&config.strategy, &topology)?;
        check_size(&config.strategy, &topology)?;
        let unit = registry.movements.build(&config.movement)?.unit().to_owned();
        let objectives = objectives(&config.movement, registry, &unit);
        if !config.terrain.is_flat() && episode.environment().goes_backwards() {
            let allowed = "flat for a movement that goes backwards: obstacles are in front of the start, \
                           and behind it the ground ends";
            return Err(SettingError::new("terrain", "a terrain", allowed).into());
        }
        if let Some(steps) = config.training_steps {
            SettingError::check_range("training_steps", steps, 1.0, 1e6)?;
        }
        let reference = match config.has_champion_selection() {
            false => None,
            true => {
                let reference = parts.reference();
                let (episode, task) = reference.build_both(config.engine, registry)?;
                let judge = Judge::new(parts, registry)?.drawing_from(Seed::of_run(config.seed), TRAINING);
                let proof = match config.variation.is_none() {
                    true => None,
                    false => Some(parts.proof().build_both(config.engine, registry)?.1),
                };
                Some(ReferenceEpisode::new(task, (episode, reference.trials), proof, judge, Seed::of_run(config.seed)))
            }
        };
        if let Some(tier) = config.stop.tier {
            check_tier(tier, reference.as_ref(), registry)?;
        }
        let task = further_bodies::with_further_bodies(config, task, [senses, motors], registry)?;
        let task = match config.training_steps {
            Some(steps) => task.shortened(steps),
            None => task,
        };
        RungSettings::validate(&config.rungs, task.steps(), config.trials.count)?;
        let rungs = config.rungs.clone();
        Ok(Self { task, rungs, episode, reference, topology, weight_names, by_hand, searched, unit, objectives })
    }

    /// When candidates are re-evaluated, and how many. Where a candidate takes more than [`LONGER`] times the steps of its training,
    /// re-evaluations are rarer by the ratio of the two, rounded up, and no more candidates wait for them.
    pub(crate) fn re_evaluations(&self, config: &RunConfig) -> ReEvaluations {
        let steps = |trials: u32, steps: u32| u64::from(trials) * u64::from(steps);
        let whole = self.reference.as_ref().map_or(0, |it| steps(it.trials.count, it.episode.steps()));
        let training = steps(config.trials.count, self.task.steps()) * config.bodies().max(1) as u64;
        let rarer = whole.div_ceil(LONGER * training.max(1)).max(1);
        let RecordSettings { checkpoint_every, candidates, .. } = config.record;
        ReEvaluations { every: checkpoint_every.saturating_mul(rarer), group: rarer, candidates }
    }

    /// The rungs that come before the task of training, the first one first.
    pub fn rungs(&self) -> Vec<Rung> {
        let rung = |&RungSettings { steps, trials, share }: &RungSettings| {
            let task = self.task.shortened(steps.unwrap_or(u32::MAX));
            Rung { task: Box::new(task.with_fewer_trials(trials.unwrap_or(u32::MAX))), share }
        };
        self.rungs.iter().map(rung).collect()
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

/// Checks that a champion can have the tier that ends the run.
fn check_tier(tier: u8, reference: Option<&ReferenceEpisode>, registry: &Registry) -> Result<(), SettingError> {
    let (found, allowed) = match highest_tier(reference) {
        Some(highest) if (1..=highest).contains(&tier) => return Ok(()),
        Some(1) => (tier.to_string(), "1: where worlds do not vary there is no higher tier".into()),
        Some(highest) => (tier.to_string(), format!("from 1 to {highest}")),
        None => {
            let judged: Vec<&str> = registry.movements.judged().collect();
            let allowed = format!(
                "null where no gaits are judged during training: only those of {} are, and only in runs with variation, \
                 random commands, shortened training episodes or further bodies",
                judged.join(", ")
            );
            ("a tier (--until usable)".into(), allowed)
        }
    };
    Err(SettingError::new("stop.tier", found, allowed))
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

/// Up to so many times the steps of training re-evaluations do not become rarer.
const LONGER: u64 = 3;

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
