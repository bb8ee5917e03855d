use ne_core::{Genome, SettingError};
use ne_net::{Network, NetworkError, Topology, TopologyMap};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The weights of a net of fixed topology, as a string of genes.
///
/// The genes stand in the order the shape documents ([`DenseShape`](ne_net::DenseShape),
/// [`GraphShape`](ne_net::GraphShape)), so that neighbours in the string lead to the same neuron. The topology is shared
/// between individuals, and the weights between copies of an individual until one of them changes.
///
/// In JSON: `{"topology": …, "weights": […], "mutation_deviation": 0.1}`. Reading checks the topology, the number of
/// weights and that they are finite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "UncheckedWeightVector")]
pub struct WeightVector {
    topology: Topology,
    weights: Arc<[f32]>,
    mutation_deviation: f32,
}

/// Why a topology, weights and a deviation are not a genome.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WeightVectorError {
    /// Topology and weights are not a net.
    #[error(transparent)]
    Net(#[from] NetworkError),
    /// The topology or the deviation is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl WeightVector {
    /// A genome. `mutation_deviation` is finite, at least 0, and in units of the weights.
    ///
    /// # Errors
    /// If the topology is out of range, the number of weights is not the topology's, or a number is not finite; the error
    /// names the field.
    pub fn new(
        topology: impl Into<Topology>,
        weights: Vec<f32>,
        mutation_deviation: f32,
    ) -> Result<Self, WeightVectorError> {
        let topology = topology.into();
        topology.validate().map_err(|error| error.within("topology"))?;
        topology.check_weights(&weights)?;
        SettingError::check_range("mutation_deviation", mutation_deviation, 0.0, f64::INFINITY)?;
        Ok(Self::checked(topology, weights, mutation_deviation))
    }

    /// As [`new`](Self::new), of what has been checked.
    pub(crate) fn checked(topology: Topology, weights: Vec<f32>, mutation_deviation: f32) -> Self {
        Self { topology, weights: weights.into(), mutation_deviation }
    }

    /// The genome of zeros, for a valid topology.
    pub(crate) fn zero(topology: Topology) -> Self {
        let weights = std::iter::repeat_n(0.0, topology.weight_count()).collect();
        Self { topology, weights, mutation_deviation: 0.0 }
    }

    /// Genes of a valid topology, each to the nearest finite `f32`.
    pub(crate) fn rounded(topology: &Topology, genes: &[f64]) -> Self {
        debug_assert_eq!(genes.len(), topology.weight_count());
        Self::checked(topology.clone(), genes.iter().copied().map(finite).collect(), 0.0)
    }

    /// The same individual in a net that has grown: what is new begins at 0.
    pub(crate) fn remapped(&self, topology: &Topology, growth: &TopologyMap) -> Self {
        let weights = growth.transfer(&self.weights, 0.0);
        Self::checked(topology.clone(), weights, self.mutation_deviation)
    }

    /// The net without its weights.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The genes: the weights in the order the shape documents.
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// How strongly this individual's children mutate, in units of the weights; evolves with the genes under
    /// [`SelfAdaptiveMutation`](crate::SelfAdaptiveMutation), else without effect.
    pub fn mutation_deviation(&self) -> f32 {
        self.mutation_deviation
    }

    /// The genes and the deviation, to be changed.
    pub(crate) fn genes_mut(&mut self) -> (&mut [f32], &mut f32) {
        (Arc::make_mut(&mut self.weights), &mut self.mutation_deviation)
    }

    /// Frees the weights; the individual must not be used afterwards.
    pub(crate) fn drop_weights(&mut self) {
        self.weights = Arc::default();
    }

    /// Becomes a copy of an individual of the same topology, in its own memory unless that is shared.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        match Arc::get_mut(&mut self.weights) {
            Some(own) => own.copy_from_slice(&other.weights),
            None => self.weights = Arc::clone(&other.weights),
        }
        self.mutation_deviation = other.mutation_deviation;
    }
}

impl Genome for WeightVector {
    type Phenotype = Network;

    fn express(&self) -> Network {
        self.topology.network(&self.weights)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "WeightVector")]
struct UncheckedWeightVector {
    topology: Topology,
    weights: Vec<f32>,
    mutation_deviation: f32,
}

impl TryFrom<UncheckedWeightVector> for WeightVector {
    type Error = WeightVectorError;

    fn try_from(unchecked: UncheckedWeightVector) -> Result<Self, WeightVectorError> {
        Self::new(unchecked.topology, unchecked.weights, unchecked.mutation_deviation)
    }
}

/// To the nearest finite `f32`.
pub(crate) fn finite(x: f64) -> f32 {
    (x as f32).clamp(f32::MIN, f32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::Phenotype;
    use ne_net::DenseShape;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn survives_serialisation_and_expresses_its_weights(
            weights in proptest::collection::vec(-5.0..5.0f32, 13), deviation in 0.0..1.0f32,
        ) {
            let genome = WeightVector::new(DenseShape::new(2, vec![3], 1), weights, deviation).expect("valid");
            let text = serde_json::to_string(&genome).expect("serialises");
            let loaded: WeightVector = serde_json::from_str(&text).expect("deserialises");
            prop_assert_eq!(&loaded, &genome);
            let (mut net, mut outputs) = (loaded.express(), [0.0]);
            prop_assert_eq!(&net, &genome.topology().network(genome.weights()));
            net.activate(&[1.0, 2.0], &mut outputs);
            prop_assert!(outputs[0].abs() <= 1.0);
        }
    }

    #[test]
    fn errors_name_the_field() {
        let error = |inputs, weights: Vec<f32>, deviation| {
            WeightVector::new(DenseShape::new(inputs, vec![], 1), weights, deviation).expect_err("invalid").to_string()
        };
        assert_eq!(error(0, vec![0.0], 0.0), "topology.inputs = 0: must be from 1 to 4096");
        assert_eq!(error(1, vec![0.0], 0.0), "weights: found 1, a net of shape 1-1 has 2");
        assert_eq!(error(1, vec![0.0, f32::NAN], 0.0), "weights[1] = NaN: must be finite");
        assert_eq!(error(1, vec![0.0, 0.0], -1.0), "mutation_deviation = -1: must be at least 0");
        assert_eq!(error(1, vec![0.0, 0.0], f32::INFINITY), "mutation_deviation = inf: must be finite and at least 0");
    }
}
