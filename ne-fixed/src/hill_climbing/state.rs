use super::{HillClimbing, HillClimbingSettings};
use crate::{StateError, state_error::generation};
use ne_core::SettingError;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// A [`HillClimbing`] as a checkpoint has it: the topology once, and no memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "HillClimbing")]
pub(super) struct State {
    settings: HillClimbingSettings,
    topology: Topology,
    /// `null` before the first generation was told.
    parent: Option<Vec<f32>>,
    /// How many of the children last told were at least as good as their parent.
    as_good: usize,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Vec<f32>>,
}

impl From<HillClimbing> for State {
    fn from(strategy: HillClimbing) -> Self {
        Self {
            asked: strategy.nets.saved(),
            settings: strategy.settings,
            topology: strategy.nets.topology,
            parent: strategy.parent.map(|parent| parent.weights().to_vec()),
            as_good: strategy.as_good,
        }
    }
}

impl TryFrom<State> for HillClimbing {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        let parent: Vec<Vec<f32>> = state.parent.into_iter().collect();
        strategy.parent = generation("parent", parent, 1, &strategy.nets.topology)?.pop();
        let children = strategy.settings.population - 1;
        SettingError::check_range("as_good", state.as_good as f64, 0.0, children as f64)?;
        strategy.as_good = state.as_good;
        strategy.nets.load(state.asked, strategy.settings.population)?;
        Ok(strategy)
    }
}
