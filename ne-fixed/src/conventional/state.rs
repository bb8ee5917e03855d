use super::{ConventionalNe, ConventionalNeSettings};
use crate::{
    Setting, StateError,
    nets::Parents,
    state_error::{Genes, generation},
};
use ne_core::Fitness;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// A [`ConventionalNe`] as a checkpoint has it: the topology once, and no memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename = "ConventionalNe",
    bound(serialize = "S: Setting, C: Setting, M: Setting", deserialize = "S: Setting, C: Setting, M: Setting")
)]
pub(super) struct State<S, C, M> {
    settings: ConventionalNeSettings<S, C, M>,
    topology: Topology,
    best: Option<Fitness>,
    stagnation: u64,
    distinct_parents: usize,
    /// The first generation, if it is not drawn; empty after it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    start: Vec<Genes>,
    /// The generation last told; empty before the first.
    parents: Vec<Parent>,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Genes>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parent {
    fitness: Option<Fitness>,
    genes: Genes,
}

impl<S, C, M> From<ConventionalNe<S, C, M>> for State<S, C, M> {
    fn from(strategy: ConventionalNe<S, C, M>) -> Self {
        let Parents { start, nets, scores } = &strategy.parents;
        let parents = nets.iter().zip(scores);
        Self {
            parents: parents.map(|(parent, &fitness)| Parent { fitness, genes: parent.into() }).collect(),
            asked: strategy.nets.saved(),
            start: start.iter().map(Genes::from).collect(),
            settings: strategy.settings,
            topology: strategy.nets.topology,
            best: strategy.best,
            stagnation: strategy.stagnation,
            distinct_parents: strategy.distinct_parents,
        }
    }
}

impl<S: Setting, C: Setting, M: Setting> TryFrom<State<S, C, M>> for ConventionalNe<S, C, M> {
    type Error = StateError;

    fn try_from(state: State<S, C, M>) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        let (size, begins) = (strategy.settings.population, state.start.len());
        let scores = state.parents.iter().map(|parent| parent.fitness).collect();
        let parents = state.parents.into_iter().map(|parent| parent.genes).collect();
        let start = generation("start", state.start, begins, &strategy.nets.topology)?;
        strategy.parents =
            Parents { start, nets: generation("parents", parents, size, &strategy.nets.topology)?, scores };
        strategy.nets.load(state.asked, size)?;
        (strategy.best, strategy.stagnation) = (state.best, state.stagnation);
        strategy.distinct_parents = state.distinct_parents;
        Ok(strategy)
    }
}
