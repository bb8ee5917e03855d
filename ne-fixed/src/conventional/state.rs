use super::{ConventionalNe, ConventionalNeSettings};
use crate::{Setting, StateError, WeightVector, state_error::generation};
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
    /// The generation last told; empty before the first.
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Genes {
    mutation_deviation: f32,
    weights: Vec<f32>,
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
    parents: Parents<'a>,
    #[serde(serialize_with = "genes")]
    asked: &'a [WeightVector],
}

struct Parents<'a> {
    genomes: &'a [WeightVector],
    scores: &'a [Option<Fitness>],
}

#[derive(Serialize)]
struct BorrowedParent<'a> {
    fitness: Option<Fitness>,
    genes: BorrowedGenes<'a>,
}

#[derive(Serialize)]
struct BorrowedGenes<'a> {
    mutation_deviation: f32,
    weights: &'a [f32],
}

impl<'a> From<&'a WeightVector> for BorrowedGenes<'a> {
    fn from(genome: &'a WeightVector) -> Self {
        Self { mutation_deviation: genome.mutation_deviation(), weights: genome.weights() }
    }
}

fn genes<R: Serializer>(genomes: &[WeightVector], serializer: R) -> Result<R::Ok, R::Error> {
    serializer.collect_seq(genomes.iter().map(BorrowedGenes::from))
}

impl Serialize for Parents<'_> {
    fn serialize<R: Serializer>(&self, serializer: R) -> Result<R::Ok, R::Error> {
        let parents = self.genomes.iter().zip(self.scores);
        serializer.collect_seq(parents.map(|(parent, &fitness)| BorrowedParent { fitness, genes: parent.into() }))
    }
}

impl<S: Setting, C: Setting, M: Setting> Serialize for ConventionalNe<S, C, M> {
    fn serialize<R: Serializer>(&self, serializer: R) -> Result<R::Ok, R::Error> {
        let Self { settings, topology, best, stagnation, distinct_parents, start, .. } = self;
        let (best, stagnation, distinct_parents) = (*best, *stagnation, *distinct_parents);
        let parents = Parents { genomes: &self.parents, scores: &self.scores };
        let asked = if self.asked { &self.population[..] } else { &[] };
        let state = BorrowedState { settings, topology, best, stagnation, distinct_parents, start, parents, asked };
        state.serialize(serializer)
    }
}

impl<S: Setting, C: Setting, M: Setting> TryFrom<State<S, C, M>> for ConventionalNe<S, C, M> {
    type Error = StateError;

    fn try_from(state: State<S, C, M>) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        let size = strategy.settings.population;
        strategy.scores = state.parents.iter().map(|parent| parent.fitness).collect();
        let genes = |genes: Genes| (genes.weights, genes.mutation_deviation);
        let parents = state.parents.into_iter().map(|parent| genes(parent.genes));
        let begins = state.start.len();
        strategy.start = generation("start", state.start.into_iter().map(genes), begins, &strategy.topology)?;
        strategy.parents = generation("parents", parents, size, &strategy.topology)?;
        strategy.population = generation("asked", state.asked.into_iter().map(genes), size, &strategy.topology)?;
        strategy.asked = !strategy.population.is_empty();
        (strategy.best, strategy.stagnation) = (state.best, state.stagnation);
        strategy.distinct_parents = state.distinct_parents;
        Ok(strategy)
    }
}
