use super::Transferred;
use creatures::Sensor;
use ne_core::promotion::PromotionRule;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::fmt;

/// A stage of shaping, as a configuration has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct StageSettings {
    /// Its name: lower-case letters, digits and hyphens; no two stages have the same.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 40), regex(pattern = "^[a-z0-9-]*$")))]
    pub name: String,
    /// Fields of the configuration that are other than in the stage before; objects are merged, lists take the place of
    /// lists. Whatever is not mentioned stays. With another `movement.name` come the terms, steps and shortened training episodes that the preset
    /// has for it and the body, with swimming the water and its engine, which go again with it. A `creature` and a `terrain`
    /// are changed as a whole. The first stage changes the configuration itself.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub changes: Map<String, Value>,
    /// Sensors added to those of the stage before.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub add_sensors: Vec<Sensor>,
    /// Whether the worlds of this stage vary no more than [near ones](envs_core::Variation::near), whatever the configuration says:
    /// what is hard to find is found there first. The next stage has those of the configuration again.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub near: bool,
    /// When the stage is passed. Only the last may have none: it goes on until the run ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub promotion: Option<PromotionRule>,
    /// When the population goes back to the stage before; looked at after `promotion`. The first stage has none. What goes
    /// back is as much as can be, whatever `transfer` says; inputs and weights that this stage added are given up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub demotion: Option<PromotionRule>,
    /// When what was learned is given up, and the run begins anew at an earlier stage or this one; looked at after `promotion` and `demotion`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub give_up: Option<GiveUp>,
    /// What it takes from the stage before; by default as much as it can: the population if the strategy is the same, else the
    /// champion, or from NEAT the champion's topology.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transfer: Option<Transferred>,
    /// Whether inputs, outputs and weights of the stage before may be given up; else a stage that lacks them is refused.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub allow_loss: bool,
}

/// When a stage gives up what was learned, and where the run begins anew: with another seed, and with what it had begun with there.
///
/// So a stage is attempted `times` + 1 times. Once the last attempt is given up, too, the search of the best goes on, until the stage is
/// passed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GiveUp {
    /// When.
    pub when: PromotionRule,
    /// The name of the stage in which it begins anew: an earlier one, or this one.
    pub back_to: String,
    /// How often; from 1 to 100.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 100)))]
    pub times: u32,
}

impl fmt::Display for GiveUp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { when, back_to, times } = self;
        let times = if *times == 1 { "once".to_owned() } else { format!("{times} times") };
        write!(f, "given up at {when}, to begin anew at {back_to}, {times}")
    }
}
