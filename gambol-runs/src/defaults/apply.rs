//! From what is known of a movement to the settings of a run.

use super::{
    BodyFacts, DefaultsCatalogue, MovementDefaults,
    running::{RHYTHM, stride_of},
};
use crate::config::{EngineChoice, RunConfig};
use creatures::{Actuation, Blueprint, Sensor};
use ne_net::Activation;
use tasks::{Commands, MovementSpec};

/// Motors that hold their speed, as those of other engines do: a gait of soft ones falls where they are stiff. N·m per rad/s.
const MOTOR_GAIN: f32 = 200.0;

/// The gain of motors that are stronger, for each N·m of the strongest: they have their top torque 1.25 rad/s off the speed asked for.
/// Where a body is four times as large its motors have 64 times the torque, and would give an eightieth of it at the usual gain.
const GAIN_OF_TORQUE: f32 = 0.8;

/// Of one world alone the lucky would be the best: one near world, and two that vary.
const TRIALS: u32 = 3;

/// Sets in a configuration what the defaults have for its movement and its creature.
pub fn apply(config: &mut RunConfig, catalogue: &DefaultsCatalogue) {
    let defaults = catalogue.of(&config.movement.name, &BodyFacts::of(config));
    let controller = &mut config.controller;
    controller.hidden = vec![defaults.hidden];
    controller.hidden_activation = Activation::Tanh;
    controller.output_activation = Activation::Tanh;
    controller.hidden_scale = 1.0;
    controller.modular = defaults.modular;
    controller.actuation = Actuation::Angle { gain: defaults.gain };
    let torques = config.creature.joints.iter().filter_map(|joint| Some(joint.motor?.top_torque));
    config.physics.motor_gain = torques.fold(MOTOR_GAIN, |gain, torque| gain.max(GAIN_OF_TORQUE * torque));
    config.sensors = Some(sensors(&config.creature.sensors, &defaults));
    config.movement.terms = defaults.terms;
    config.movement.steps = defaults.steps;
    config.training_steps = defaults.training_steps;
    if let Some(commands) = defaults.commands.clone() {
        config.commands = Some(commands);
    }
    config.trials.count = defaults.trials.unwrap_or(TRIALS);
    config.stages = defaults.stages;
    if defaults.most_steps.is_some() {
        (config.stop.generations, config.stop.steps) = (None, defaults.most_steps);
    }
    if let Some(variation) = defaults.variation {
        config.variation = variation;
    }
    for (name, value) in defaults.strategy {
        if config.strategy.settings().contains_key(&name) {
            config.strategy.set(&name, value);
        }
    }
    // What lanes refuse is trained in rapier rather than not at all.
    if config.creature.self_collision {
        config.engine = EngineChoice::Rapier;
    }
}

/// Has the stride that the defaults ask for take as long as the clock that the net hears, where that is another than the body's own:
/// one that was chosen, or that of a run that goes on. `planned`: the movement as the defaults have it.
pub(crate) fn follow_clock(config: &mut RunConfig, planned: &MovementSpec) {
    let Some(rhythm) = planned.terms.iter().find(|term| term.term == RHYTHM) else { return };
    let Some(period) = clock(config.sensors.as_ref().unwrap_or(&config.creature.sensors)) else { return };
    for term in config.movement.terms.iter_mut().filter(|term| **term == *rhythm) {
        term.settings.insert("period".into(), stride_of(period).into());
    }
}

/// How long the defaults have an episode of a configuration's movement; `None`: as long as the movement by itself.
pub fn steps(config: &RunConfig, catalogue: &DefaultsCatalogue) -> Option<u32> {
    catalogue.of(&config.movement.name, &BodyFacts::of(config)).steps
}

impl BodyFacts {
    /// The body of a configuration; one that is not valid is told apart later, and has no legs here.
    fn of(config: &RunConfig) -> Self {
        let clock = clock(&config.creature.sensors);
        let Ok(blueprint) = Blueprint::new(config.creature.clone()) else {
            return Self { legs: 0, limbs: 0, joints: 0, height: 1.0, clock };
        };
        let limbs = blueprint.legs().len();
        Self {
            legs: if blueprint.is_legless() { 0 } else { limbs },
            limbs,
            joints: blueprint.legs().iter().map(Vec::len).min().unwrap_or(0),
            height: blueprint.start_height(),
            clock,
        }
    }
}

/// What the creature's file asks for, if it asks for anything of its own, or else what a body feels; and a clock.
fn sensors(own: &[Sensor], defaults: &MovementDefaults) -> Vec<Sensor> {
    let &MovementDefaults { period, from_landing, stands, ref commands, .. } = defaults;
    let mut sensors = own.to_vec();
    if sensors == Sensor::defaults() {
        sensors.insert(1, Sensor::TorsoSpin);
        if stands {
            sensors.extend([Sensor::FootContacts, Sensor::TorsoVelocity, Sensor::TorsoHeight]);
        }
    }
    if let Some(commands) = commands {
        let top = top_speed(commands);
        if !own.iter().any(|sensor| matches!(sensor, Sensor::CommandedSpeed { .. })) {
            sensors.push(Sensor::CommandedSpeed { top });
        }
        if clock(&sensors).is_none() {
            sensors.push(Sensor::StrideClock { period, top });
        }
    }
    if clock(&sensors).is_none() {
        sensors.push(if from_landing { Sensor::LandingClock { period } } else { Sensor::Clock { period } });
    }
    sensors
}

/// The period of the first clock, s.
fn clock(sensors: &[Sensor]) -> Option<f32> {
    sensors.iter().find_map(|sensor| match *sensor {
        Sensor::Clock { period } | Sensor::LandingClock { period } | Sensor::StrideClock { period, .. } => Some(period),
        _ => None,
    })
}

/// The fastest that these commands tell a body to be, body lengths/s.
fn top_speed(commands: &Commands) -> f32 {
    let top = match commands {
        Commands::Random(random) => random.speeds[1],
        Commands::Given(changes) => changes.iter().map(|change| change.speed.abs()).fold(0.0, f32::max),
    };
    top.clamp(0.1, 20.0)
}
