use super::{Cosyne, CosyneSettings};
use crate::{StateError, nets::Parents, state_error::generation};
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
    /// The best score since the search began, and the generations since it was beaten; only where it may begin anew.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    best: Option<Fitness>,
    #[serde(default, skip_serializing_if = "is_zero")]
    stagnation: u64,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    has_begun_anew: bool,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Vec<f32>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parent {
    fitness: Option<Fitness>,
    weights: Vec<f32>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands it over so")]
fn is_zero(number: &u64) -> bool {
    *number == 0
}

impl From<Cosyne> for State {
    fn from(strategy: Cosyne) -> Self {
        let Parents { start, nets, scores } = &strategy.parents;
        let parents = nets.iter().zip(scores);
        Self {
            parents: parents.map(|(net, &fitness)| Parent { fitness, weights: net.into() }).collect(),
            asked: strategy.nets.saved(),
            start: start.iter().map(Vec::from).collect(),
            best: strategy.best,
            stagnation: strategy.stagnation,
            has_begun_anew: strategy.has_begun_anew,
            settings: strategy.settings,
            topology: strategy.nets.topology,
        }
    }
}

impl TryFrom<State> for Cosyne {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?.with_start(&state.start)?;
        let size = strategy.settings.population;
        strategy.parents.scores = state.parents.iter().map(|parent| parent.fitness).collect();
        let parents = state.parents.into_iter().map(|parent| parent.weights).collect();
        strategy.parents.nets = generation("parents", parents, size, &strategy.nets.topology)?;
        strategy.nets.load(state.asked, size)?;
        (strategy.best, strategy.stagnation) = (state.best, state.stagnation);
        strategy.has_begun_anew = state.has_begun_anew;
        Ok(strategy)
    }
}
