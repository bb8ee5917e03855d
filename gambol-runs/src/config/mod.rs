//! The configuration of a run: everything needed to repeat it.

mod engine;
mod origin;
mod rungs;
mod stage;
mod strategy;

pub use engine::EngineChoice;
pub use origin::{Origin, Transferred};
pub use rungs::RungSettings;
pub use stage::{GiveUp, StageSettings};
pub use strategy::StrategySettings;

use creatures::{Actuation, Creature, Sensor, Terrain};
use envs_rapier::{PhysicsSettings, Variation};
use ne_core::{SettingError, StopConditions, digest::Digest};
use ne_net::{Activation, Topology};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use tasks::{Commands, MovementSpec, Trials};

/// The format a configuration file names.
pub const CONFIG_FORMAT: &str = "gambol run";

/// The version of the configuration file this Gambol writes and reads.
pub const CONFIG_VERSION: u32 = 2;

/// Everything that determines a run. Two runs with equal configurations give the same bytes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// How trials differ. If they do, or if the body is told random commands, training episodes are shortened or there are further bodies,
    /// the champion is chosen without variation: in one trial, or in eight if the body is told random commands, with others in each.
    pub variation: Variation,
    /// The steps an episode of training lasts, from 1 to 1,000,000; `null`, the default: as many as the movement's. With fewer, more
    /// individuals can be tried, and the champion is chosen in one episode of the movement's length.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1_000_000)))]
    pub training_steps: Option<u32>,
    /// Cheaper evaluations before that of training, the first one first: after each only the best share goes on. At most
    /// 8; none, the default: every individual has the evaluation of training.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "schema", schemars(length(max = 8)))]
    pub rungs: Vec<RungSettings>,
    /// What steps the creatures in training.
    #[serde(default = "EngineChoice::of_old")]
    pub engine: EngineChoice,
    /// The search.
    pub strategy: StrategySettings,
    /// The controller.
    pub controller: ControllerSettings,
    /// A topology to search the weights of, in place of the controller's layers; of the controller only `input_range`
    /// and `actuation` count then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub topology: Option<FrozenTopology>,
    /// When the run ends.
    pub stop: StopConditions,
    /// The physics.
    pub physics: PhysicsSettings,
    /// What the creature moves on; flat by default.
    #[serde(default, skip_serializing_if = "Terrain::is_default")]
    pub terrain: Terrain,
    /// What the body is told to do, for movements that follow commands; `null`, the default: nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commands: Option<Commands>,
    /// What is written down, and how often.
    pub record: RecordSettings,
    /// The stages of shaping, in order; none: the run has one task.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<StageSettings>,
    /// Where the run goes on from, for the record; it is filled in, not chosen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<Origin>,
    /// What the controller senses, 1 to 64 sensors; `null`: what the creature's file asks for.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 64)))]
    pub sensors: Option<Vec<Sensor>>,
    /// The body.
    pub creature: Creature,
    /// Further bodies in which every individual is evaluated in training, each with the creature's inputs and outputs; at
    /// most 15, none by default. What they come to is combined as trials are; the champion is chosen in `creature` alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "schema", schemars(length(max = 15)))]
    pub further_bodies: Vec<Creature>,
}

impl RunConfig {
    /// In how many bodies every individual is evaluated in training: in `creature` and its further bodies.
    pub fn bodies(&self) -> usize {
        1 + self.further_bodies.len()
    }

    /// Whether the trials of a generation differ from those of the next: in their worlds, or in what the body is told.
    pub fn varies(&self) -> bool {
        !self.variation.is_none() || matches!(self.commands, Some(Commands::Random(_)))
    }

    /// Whether a champion selection chooses the champion: where training [varies](Self::varies), or is in shorter episodes or in further
    /// bodies, so that the best of a generation need not be the best in one whole episode of `creature`.
    pub fn has_champion_selection(&self) -> bool {
        self.varies() || self.training_steps.is_some() || !self.further_bodies.is_empty()
    }

    /// The first field by which another configuration is that of another run; `None`: by none. A run keeps its own when its limits change,
    /// and when it begins with what another has learned.
    pub fn other_run(&self, other: &Self) -> Option<String> {
        let (one, other) = (self.fields_of_run(), other.fields_of_run());
        one.keys().chain(other.keys()).find(|&field| one.get(field) != other.get(field)).cloned()
    }

    /// What its checkpoints are [labelled](ne_core::Evolution::with_label) with: the digest of all by which
    /// [another run](Self::other_run) is told, but for the engine, since all engines give the same bits.
    pub fn label(&self) -> String {
        let mut fields = self.fields_of_run();
        fields.remove("engine");
        Digest::of_json(&Value::Object(fields)).to_string()
    }

    fn fields_of_run(&self) -> Map<String, Value> {
        let config = Self { stop: StopConditions::default(), topology: None, origin: None, ..self.clone() };
        match serde_json::to_value(config) {
            Ok(Value::Object(fields)) => fields,
            // Plain data can be written.
            _ => Map::new(),
        }
    }
}

/// The net between sensors and motors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ControllerSettings {
    /// Neurons of each hidden layer, from 1 to 4096, of at most 64 layers; an empty list connects inputs to outputs directly.
    #[cfg_attr(feature = "schema", schemars(length(max = 64), inner(range(min = 1, max = 4096))))]
    pub hidden: Vec<usize>,
    /// Activation of hidden neurons.
    pub hidden_activation: Activation,
    /// Activation of outputs; from −1 to 1 drives a motor from full speed backwards to full speed forwards.
    pub output_activation: Activation,
    /// Hidden outputs are multiplied with this before the next layer; above 0 and at most 1000.
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0)))]
    pub hidden_scale: f32,
    /// Sensors are scaled to ± this, from 0.001 to 1000.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1000.0)))]
    pub input_range: f32,
    /// What an output means to its motor.
    #[serde(default)]
    pub actuation: Actuation,
    /// A modular controller: a copy of one small net for each limb, with shared weights, and with the clocks of the limbs like this; `null`: one net for the whole body,
    /// which sees every sensor. Joints hear hidden neurons alone, or the sensors if there are none. NEAT finds the small net.
    #[serde(default)]
    pub modular: Option<LimbPhases>,
}

/// How far the clocks of limbs run ahead of each other before evolution changes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LimbPhases {
    /// Half a turn between neighbours, along the body and beside each other: the start of a walk.
    Alternating,
    /// All alike: the start of a jump. Limbs before and behind then also answer a tilt of the torso differently, and more
    /// than four feet are felt as one.
    Together,
}

/// A net without its weights, such as the one of a champion that NEAT has found, and what it was made for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FrozenTopology {
    /// The name of each input.
    pub inputs: Vec<String>,
    /// The name of each output.
    pub outputs: Vec<String>,
    /// The net.
    pub net: Topology,
    /// If a part of it is [held](Transferred::Held): all genes of the whole net, in order, so that a later stage can search
    /// for all of them again.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub genes: Vec<GeneRecord>,
}

/// A gene of a net of which a part is held.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GeneRecord {
    /// What it is for.
    pub name: String,
    /// Its value, if it is held.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub held: Option<f32>,
}

/// What is written down during a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RecordSettings {
    /// A checkpoint and the champion are written every so many generations, and at the end; at least 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub checkpoint_every: u64,
    /// The whole population is kept for the report at these generations.
    pub populations_at: Vec<u64>,
    /// With variation, random commands, shortened training episodes or further bodies: with each checkpoint, or more seldom where that takes much longer than
    /// training, so many of the best of the generation, and the best of each few generations since, are evaluated in whole episodes of
    /// the creature without variation, and the best of them may become champion; from 1 to 1000, default 22. What the
    /// strategy recommends is one more.
    #[serde(default = "default_candidates")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub candidates: usize,
}

/// With the nine generations between checkpoints, and what the strategy recommends, they are 32: two batches of 16 lanes.
pub(crate) fn default_candidates() -> usize {
    22
}

impl RecordSettings {
    pub(crate) fn validate(&self) -> Result<(), SettingError> {
        if self.checkpoint_every == 0 {
            return Err(SettingError::new("checkpoint_every", 0, "at least 1"));
        }
        SettingError::check_range("candidates", self.candidates as f64, 1.0, 1000.0)
    }
}
