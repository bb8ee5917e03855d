use super::{RandomSearch, RandomSearchSettings};
use crate::{StateError, state_error::generation};
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
        let asked = if strategy.asked { strategy.population } else { Vec::new() };
        Self {
            settings: strategy.settings,
            topology: strategy.topology,
            asked: asked.iter().map(|net| net.weights().to_vec()).collect(),
        }
    }
}

impl TryFrom<State> for RandomSearch {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        strategy.population = generation("asked", state.asked, strategy.settings.population, &strategy.topology)?;
        strategy.asked = !strategy.population.is_empty();
        Ok(strategy)
    }
}
