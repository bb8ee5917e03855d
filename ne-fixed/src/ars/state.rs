use super::{Ars, ArsSettings};
use crate::{StateError, state_error::check_numbers};
use ne_core::SettingError;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// An [`Ars`] as a checkpoint has it: without memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Ars")]
pub(super) struct State {
    settings: ArsSettings,
    topology: Topology,
    /// Empty before the first generation.
    centre: Vec<f64>,
    reward_deviation: f64,
    step_length: f64,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Vec<f32>>,
}

impl From<Ars> for State {
    fn from(strategy: Ars) -> Self {
        Self {
            asked: strategy.nets.saved(),
            settings: strategy.settings,
            topology: strategy.nets.topology,
            centre: strategy.centre,
            reward_deviation: strategy.reward_deviation,
            step_length: strategy.step_length,
        }
    }
}

impl TryFrom<State> for Ars {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        if !state.centre.is_empty() {
            check_numbers("centre", &state.centre, strategy.nets.topology.weight_count())?;
        }
        SettingError::check_range("reward_deviation", state.reward_deviation, 0.0, f64::INFINITY)?;
        SettingError::check_range("step_length", state.step_length, 0.0, f64::INFINITY)?;
        strategy.nets.load(state.asked, 1 + strategy.settings.population)?;
        if strategy.nets.asked && state.centre.is_empty() {
            return Err(SettingError::new("centre", "none", "there when individuals were asked").into());
        }
        strategy.centre = state.centre;
        strategy.reward_deviation = state.reward_deviation;
        strategy.step_length = state.step_length;
        Ok(strategy)
    }
}
