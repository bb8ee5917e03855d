use super::{RandomSearch, RandomSearchSettings};
use crate::StateError;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// A [`RandomSearch`] as a checkpoint has it: the topology once, and no memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "RandomSearch")]
pub(super) struct State {
    settings: RandomSearchSettings,
    topology: Topology,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Vec<f32>>,
}

impl From<RandomSearch> for State {
    fn from(strategy: RandomSearch) -> Self {
        Self { asked: strategy.nets.saved(), settings: strategy.settings, topology: strategy.nets.topology }
    }
}

impl TryFrom<State> for RandomSearch {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        strategy.nets.load(state.asked, strategy.settings.population)?;
        Ok(strategy)
    }
}
