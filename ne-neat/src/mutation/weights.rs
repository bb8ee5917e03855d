use crate::{
    BiasKind, NeatGenome,
    noise::{NewWeights, Noise, happens},
};
use ne_core::{RandomStream, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// How the weights of a child change, those of disabled connections included. A bias of [a neuron of its
/// own](BiasKind::PerNeuron) is one of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WeightMutation {
    /// The probability that a child's weights change at all, from 0 to 1; 0.8 in the paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub rate: f64,
    /// The share of its weights that then change, from 0 to 1; all in the paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub share: f64,
    /// The share of those that are drawn anew instead of perturbed, from 0 to 1; 0.1 in the paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub replaced: f64,
    /// What is added to a weight that is perturbed.
    pub perturbation: Noise,
    /// The greatest weight, and negated the least, from 0.001 to 1000: new weights and mutations stop there. Only the
    /// connection into a new neuron has a weight of 1, as in the paper, whatever the limit.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1000.0)))]
    pub limit: f64,
}

impl WeightMutation {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("rate", self.rate, 0.0, 1.0)?;
        SettingError::check_range("share", self.share, 0.0, 1.0)?;
        SettingError::check_range("replaced", self.replaced, 0.0, 1.0)?;
        self.perturbation.validate().map_err(|error| error.within("perturbation"))?;
        SettingError::check_range("limit", self.limit, 0.001, 1000.0)
    }

    pub(super) fn mutate(&self, genome: &mut NeatGenome, new_weights: NewWeights, stream: &mut RandomStream) {
        if !happens(self.rate, stream) {
            return;
        }
        // One number decides for each weight: replaced, perturbed or neither.
        let (replaced, changed) = ((self.share * self.replaced) as f32, self.share as f32);
        let limit = self.limit as f32;
        let mut mutate = |weight: &mut f32| {
            let decision: f32 = stream.random();
            if decision < replaced {
                *weight = new_weights.draw(stream);
            } else if decision < changed {
                *weight = (*weight + self.perturbation.draw(stream)).clamp(-limit, limit);
            }
        };
        let has_biases = genome.layout().bias == BiasKind::PerNeuron;
        let (nodes, connections) = genome.genes_mut();
        connections.iter_mut().for_each(|gene| mutate(&mut gene.weight));
        if has_biases {
            nodes.iter_mut().for_each(|gene| mutate(&mut gene.bias));
        }
    }
}
