use super::{OpenEs, OpenEsSettings, adam::AdamMemory};
use crate::{StateError, state_error::check_numbers};
use ne_core::SettingError;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// An [`OpenEs`] as a checkpoint has it: without memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "OpenEs")]
pub(super) struct State {
    settings: OpenEsSettings,
    topology: Topology,
    /// Empty before the first generation.
    centre: Vec<f64>,
    deviation: f64,
    adam: AdamMemory,
    gradient_length: f64,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Vec<f32>>,
}

impl From<OpenEs> for State {
    fn from(strategy: OpenEs) -> Self {
        Self {
            asked: strategy.nets.saved(),
            settings: strategy.settings,
            topology: strategy.nets.topology,
            centre: strategy.centre,
            deviation: strategy.deviation,
            adam: strategy.adam,
            gradient_length: strategy.gradient_length,
        }
    }
}

impl TryFrom<State> for OpenEs {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        let (settings, n) = (&strategy.settings, strategy.nets.topology.weight_count());
        if !state.centre.is_empty() {
            check_numbers("centre", &state.centre, n)?;
        }
        SettingError::check_range("deviation", state.deviation, settings.least_deviation, settings.deviation)?;
        check_numbers("adam.means", &state.adam.means, n)?;
        check_numbers("adam.squares", &state.adam.squares, n)?;
        if let Some(index) = state.adam.squares.iter().position(|&square| square < 0.0) {
            let found = state.adam.squares[index];
            return Err(SettingError::new(format!("adam.squares[{index}]"), found, "at least 0").into());
        }
        SettingError::check_range("gradient_length", state.gradient_length, 0.0, f64::INFINITY)?;
        strategy.nets.load(state.asked, 1 + settings.population)?;
        if strategy.nets.asked && state.centre.is_empty() {
            return Err(SettingError::new("centre", "none", "there when individuals were asked").into());
        }
        strategy.centre = state.centre;
        strategy.deviation = state.deviation;
        strategy.adam = state.adam;
        strategy.gradient_length = state.gradient_length;
        Ok(strategy)
    }
}
