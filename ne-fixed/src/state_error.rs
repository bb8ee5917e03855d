use crate::{WeightVector, WeightVectorError};
use ne_core::SettingError;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// Why a saved strategy cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// A setting, the topology or a number of the state is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// There are too many or too few individuals.
    #[error("{field}: found {found} individuals, the settings say {expected}")]
    Count {
        /// Which of them, such as `parents` or `asked`.
        field: String,
        /// How many there must be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// An individual is not a genome of the topology.
    #[error("{field}[{index}].{source}")]
    Individual {
        /// Which of them, such as `parents` or `asked`.
        field: String,
        /// Which individual, from 0.
        index: usize,
        /// What is wrong with it.
        source: WeightVectorError,
    },
}

/// An individual as a checkpoint has it, whose topology is known.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Genes {
    mutation_deviation: f32,
    weights: Vec<f32>,
}

/// The same, borrowed.
#[derive(Serialize)]
pub(crate) struct BorrowedGenes<'a> {
    mutation_deviation: f32,
    weights: &'a [f32],
}

impl<'a> From<&'a WeightVector> for BorrowedGenes<'a> {
    fn from(genome: &'a WeightVector) -> Self {
        Self { mutation_deviation: genome.mutation_deviation(), weights: genome.weights() }
    }
}

impl From<&WeightVector> for Genes {
    fn from(genome: &WeightVector) -> Self {
        Self { mutation_deviation: genome.mutation_deviation(), weights: genome.weights().to_vec() }
    }
}

/// Of a search without mutation deviations.
impl From<Vec<f32>> for Genes {
    fn from(weights: Vec<f32>) -> Self {
        Self { mutation_deviation: 0.0, weights }
    }
}

impl From<&WeightVector> for Vec<f32> {
    fn from(genome: &WeightVector) -> Self {
        genome.weights().to_vec()
    }
}

/// A generation of `size` individuals, or an empty one, from a checkpoint.
pub(crate) fn generation<G: Into<Genes>>(
    field: &str,
    genes: Vec<G>,
    size: usize,
    topology: &Topology,
) -> Result<Vec<WeightVector>, StateError> {
    if !genes.is_empty() && genes.len() != size {
        return Err(StateError::Count { field: field.into(), expected: size, found: genes.len() });
    }
    let genome = |(index, genes): (usize, G)| {
        let Genes { mutation_deviation, weights } = genes.into();
        WeightVector::new(topology.clone(), weights, mutation_deviation).map_err(|source| StateError::Individual {
            field: field.into(),
            index,
            source,
        })
    };
    genes.into_iter().enumerate().map(genome).collect()
}

/// Checks that there is one finite number for each of `count` weights.
pub(crate) fn check_numbers(field: &str, numbers: &[f64], count: usize) -> Result<(), SettingError> {
    if numbers.len() != count {
        return Err(SettingError::new(field, format!("{} numbers", numbers.len()), format!("{count} numbers")));
    }
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(index) => Err(SettingError::new(format!("{field}[{index}]"), numbers[index], "finite")),
        None => Ok(()),
    }
}
