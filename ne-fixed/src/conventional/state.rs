use super::{ConventionalNe, ConventionalNeSettings};
use crate::{Setting, WeightVector, WeightVectorError};
use ne_core::{Fitness, SettingError};
use ne_net::DenseShape;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Why a saved [`ConventionalNe`] cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// A setting or the shape is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// There are too many or too few individuals.
    #[error("{field}: found {found} individuals, the settings say {expected}")]
    Count {
        /// Which generation: `parents` or `asked`.
        field: String,
        /// How many there must be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// An individual is not a genome of the shape.
    #[error("{field}[{index}].{source}")]
    Individual {
        /// Which generation: `parents` or `asked`.
        field: String,
        /// Which individual, from 0.
        index: usize,
        /// What is wrong with it.
        source: WeightVectorError,
    },
}

/// A [`ConventionalNe`] as a checkpoint has it: the shape once, and no memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename = "ConventionalNe",
    bound(serialize = "S: Setting, C: Setting, M: Setting", deserialize = "S: Setting, C: Setting, M: Setting")
)]
pub(super) struct State<S, C, M> {
    settings: ConventionalNeSettings<S, C, M>,
    shape: Arc<DenseShape>,
    best: Option<Fitness>,
    stagnation: u64,
    distinct_parents: usize,
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

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Genes {
    mutation_deviation: f32,
    weights: Vec<f32>,
}

impl From<&WeightVector> for Genes {
    fn from(genome: &WeightVector) -> Self {
        Self { mutation_deviation: genome.mutation_deviation(), weights: genome.weights().to_vec() }
    }
}

impl<S, C, M> From<ConventionalNe<S, C, M>> for State<S, C, M> {
    fn from(strategy: ConventionalNe<S, C, M>) -> Self {
        let parents = strategy.parents.iter().zip(&strategy.scores);
        let asked: &[_] = if strategy.asked { &strategy.population } else { &[] };
        Self {
            parents: parents.map(|(parent, &fitness)| Parent { fitness, genes: parent.into() }).collect(),
            asked: asked.iter().map(Genes::from).collect(),
            settings: strategy.settings,
            shape: strategy.shape,
            best: strategy.best,
            stagnation: strategy.stagnation,
            distinct_parents: strategy.distinct_parents,
        }
    }
}

impl<S: Setting, C: Setting, M: Setting> TryFrom<State<S, C, M>> for ConventionalNe<S, C, M> {
    type Error = StateError;

    fn try_from(state: State<S, C, M>) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.shape)?;
        let size = strategy.settings.population;
        strategy.scores = state.parents.iter().map(|parent| parent.fitness).collect();
        let parents = state.parents.into_iter().map(|parent| parent.genes).collect();
        strategy.parents = generation("parents", parents, size, &strategy.shape)?;
        strategy.population = generation("asked", state.asked, size, &strategy.shape)?;
        strategy.asked = !strategy.population.is_empty();
        (strategy.best, strategy.stagnation) = (state.best, state.stagnation);
        strategy.distinct_parents = state.distinct_parents;
        Ok(strategy)
    }
}

/// A generation of `size` individuals, or an empty one.
fn generation(
    field: &str,
    genes: Vec<Genes>,
    size: usize,
    shape: &Arc<DenseShape>,
) -> Result<Vec<WeightVector>, StateError> {
    if !genes.is_empty() && genes.len() != size {
        return Err(StateError::Count { field: field.into(), expected: size, found: genes.len() });
    }
    let genome = |(index, genes): (usize, Genes)| {
        WeightVector::new(Arc::clone(shape), genes.weights, genes.mutation_deviation)
            .map_err(|source| StateError::Individual { field: field.into(), index, source })
    };
    genes.into_iter().enumerate().map(genome).collect()
}
