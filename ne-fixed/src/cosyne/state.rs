use super::{Cosyne, CosyneSettings};
use crate::{
    StateError,
    state_error::{asked_generation, generation},
};
use ne_core::Fitness;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// A [`Cosyne`] as a checkpoint has it: the topology once, and no memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Cosyne")]
pub(super) struct State {
    settings: CosyneSettings,
    topology: Topology,
    /// The first generation, if it is not drawn; empty after it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    start: Vec<Vec<f32>>,
    /// The generation last told; empty before the first.
    parents: Vec<Parent>,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Vec<f32>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parent {
    fitness: Option<Fitness>,
    weights: Vec<f32>,
}

impl From<Cosyne> for State {
    fn from(strategy: Cosyne) -> Self {
        let asked = if strategy.asked { strategy.population } else { Vec::new() };
        let parents = strategy.parents.iter().zip(&strategy.scores);
        Self {
            parents: parents.map(|(net, &fitness)| Parent { fitness, weights: net.weights().to_vec() }).collect(),
            asked: asked.iter().map(|individual| individual.weights().to_vec()).collect(),
            start: strategy.start.iter().map(|net| net.weights().to_vec()).collect(),
            settings: strategy.settings,
            topology: strategy.topology,
        }
    }
}

impl TryFrom<State> for Cosyne {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?.with_start(&state.start)?;
        let size = strategy.settings.population;
        strategy.scores = state.parents.iter().map(|parent| parent.fitness).collect();
        let parents = state.parents.into_iter().map(|parent| (parent.weights, 0.0));
        strategy.parents = generation("parents", parents, size, &strategy.topology)?;
        strategy.population = asked_generation(state.asked, size, &strategy.topology)?;
        strategy.asked = !strategy.population.is_empty();
        Ok(strategy)
    }
}
