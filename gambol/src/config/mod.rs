//! The configuration of a run: everything needed to repeat it.

mod assembly;
mod presets;
mod request;

pub use assembly::{Assembly, ConfigError};
pub use presets::{PRESETS, Preset, preset};
pub use request::{Request, RequestError};

use creatures::{Creature, Sensor};
use envs_rapier::{PhysicsSettings, Variation};
use ne_core::{SettingError, StopConditions};
use ne_fixed::ConventionalNeSettings;
use ne_net::Activation;
use serde::{Deserialize, Serialize};
use tasks::{MovementSpec, Trials};

/// The format a configuration file names.
pub const CONFIG_FORMAT: &str = "gambol run";

/// The version of the configuration file this Gambol writes and reads.
pub const CONFIG_VERSION: u32 = 1;

/// Everything that determines a run. Two runs with equal configurations give the same bytes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunConfig {
    /// The name of the preset it started from, for the record.
    pub preset: String,
    /// The run's seed.
    pub seed: u64,
    /// What is to be learned.
    pub movement: MovementSpec,
    /// Trials of an evaluation.
    pub trials: Trials,
    /// How trials differ.
    pub variation: Variation,
    /// The search.
    pub strategy: StrategySettings,
    /// The controller.
    pub controller: ControllerSettings,
    /// When the run ends.
    pub stop: StopConditions,
    /// The physics.
    pub physics: PhysicsSettings,
    /// What is written down, and how often.
    pub record: RecordSettings,
    /// What the controller senses; `null`: what the creature's file asks for.
    pub sensors: Option<Vec<Sensor>>,
    /// The body.
    pub creature: Creature,
}

/// The search, by name, with its settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum StrategySettings {
    /// Conventional neuroevolution: a genetic algorithm over the weights of a fixed topology.
    Conventional(ConventionalNeSettings),
    /// A strategy of another program, by the name it has there. That program trains and resumes
    /// ([`train_with`](crate::training::train_with)); ours reports, replays and verifies.
    Custom(String),
}

/// The net between sensors and motors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControllerSettings {
    /// Neurons of each hidden layer; an empty list connects inputs to outputs directly.
    pub hidden: Vec<usize>,
    /// Activation of hidden neurons.
    pub hidden_activation: Activation,
    /// Activation of outputs; from −1 to 1 drives a motor from full speed backwards to full speed forwards.
    pub output_activation: Activation,
    /// Hidden outputs are multiplied with this before the next layer.
    pub hidden_scale: f32,
    /// Sensors are scaled to ± this.
    pub input_range: f32,
}

/// What is written down during a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordSettings {
    /// A checkpoint and the champion are written every so many generations, and at the end; at least 1.
    pub checkpoint_every: u64,
    /// The whole population is kept for the report at these generations.
    pub populations_at: Vec<u64>,
}

impl RecordSettings {
    pub(crate) fn validate(&self) -> Result<(), SettingError> {
        if self.checkpoint_every == 0 {
            return Err(SettingError::new("checkpoint_every", 0, "at least 1"));
        }
        Ok(())
    }
}

impl StrategySettings {
    /// The strategy's name.
    pub fn name(&self) -> &str {
        match self {
            Self::Conventional(_) => "conventional",
            Self::Custom(name) => name,
        }
    }

    /// The number of individuals of a generation, if it is a setting of ours.
    pub fn population(&self) -> Option<usize> {
        match self {
            Self::Conventional(settings) => Some(settings.population),
            Self::Custom(_) => None,
        }
    }

    /// Sets the number of individuals of a generation.
    pub fn set_population(&mut self, population: usize) {
        match self {
            Self::Conventional(settings) => settings.population = population,
            Self::Custom(_) => {}
        }
    }
}
