use super::{ConventionalNe, ConventionalNeSettings};
use crate::{
    Setting, StateError, WeightVector,
    nets::Parents,
    state_error::{BorrowedGenes, Genes, generation},
};
use ne_core::Fitness;
use ne_net::Topology;
use serde::{Deserialize, Serialize, Serializer};

/// A [`ConventionalNe`] as a checkpoint has it: the topology once, and no memory that is only kept for reuse.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "ConventionalNe", bound = "S: Setting, C: Setting, M: Setting")]
pub(super) struct State<S, C, M> {
    settings: ConventionalNeSettings<S, C, M>,
    topology: Topology,
    best: Option<Fitness>,
    stagnation: u64,
    distinct_parents: usize,
    /// The first generation, if it is not drawn; empty after it.
    #[serde(default)]
    start: Vec<Genes>,
    /// The generation last told; empty before the first, and once its children are asked.
    parents: Vec<Parent>,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Genes>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parent {
    fitness: Option<Fitness>,
    genes: Genes,
}

/// The same [`State`], borrowed: writing a large population copies none of it.
#[derive(Serialize)]
#[serde(rename = "ConventionalNe", bound = "S: Setting, C: Setting, M: Setting")]
struct BorrowedState<'a, S, C, M> {
    settings: &'a ConventionalNeSettings<S, C, M>,
    topology: &'a Topology,
    best: Option<Fitness>,
    stagnation: u64,
    distinct_parents: usize,
    #[serde(skip_serializing_if = "<[_]>::is_empty", serialize_with = "genes")]
    start: &'a [WeightVector],
    #[serde(serialize_with = "scored")]
    parents: &'a Parents,
    #[serde(serialize_with = "genes")]
    asked: &'a [WeightVector],
}

#[derive(Serialize)]
struct BorrowedParent<'a> {
    fitness: Option<Fitness>,
    genes: BorrowedGenes<'a>,
}

fn genes<R: Serializer>(nets: &[WeightVector], serializer: R) -> Result<R::Ok, R::Error> {
    serializer.collect_seq(nets.iter().map(BorrowedGenes::from))
}

fn scored<R: Serializer>(parents: &Parents, serializer: R) -> Result<R::Ok, R::Error> {
    let scored = parents.nets.iter().zip(&parents.scores);
    serializer.collect_seq(scored.map(|(net, &fitness)| BorrowedParent { fitness, genes: net.into() }))
}

impl<S: Setting, C: Setting, M: Setting> Serialize for ConventionalNe<S, C, M> {
    fn serialize<R: Serializer>(&self, serializer: R) -> Result<R::Ok, R::Error> {
        let Self { settings, nets, parents, best, stagnation, distinct_parents, .. } = self;
        BorrowedState {
            settings,
            topology: &nets.topology,
            best: *best,
            stagnation: *stagnation,
            distinct_parents: *distinct_parents,
            start: &parents.start,
            parents,
            asked: nets.waiting(),
        }
        .serialize(serializer)
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
