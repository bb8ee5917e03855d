use crate::{WeightVector, WeightVectorError};
use ne_core::SettingError;
use ne_net::Topology;

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
        /// Which generation: `parents` or `asked`.
        field: String,
        /// How many there must be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// An individual is not a genome of the topology.
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

/// A generation of `size` individuals, or an empty one, from weights and mutation deviations.
pub(crate) fn generation(
    field: &str,
    genes: impl ExactSizeIterator<Item = (Vec<f32>, f32)>,
    size: usize,
    topology: &Topology,
) -> Result<Vec<WeightVector>, StateError> {
    if genes.len() != 0 && genes.len() != size {
        return Err(StateError::Count { field: field.into(), expected: size, found: genes.len() });
    }
    let genome = |(index, (weights, deviation))| {
        WeightVector::new(topology.clone(), weights, deviation).map_err(|source| StateError::Individual {
            field: field.into(),
            index,
            source,
        })
    };
    genes.enumerate().map(genome).collect()
}

/// The same for strategies without mutation deviations.
pub(crate) fn asked_generation(
    asked: Vec<Vec<f32>>,
    size: usize,
    topology: &Topology,
) -> Result<Vec<WeightVector>, StateError> {
    generation("asked", asked.into_iter().map(|weights| (weights, 0.0)), size, topology)
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
