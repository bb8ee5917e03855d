use super::GraphShape;
use crate::{Activation, NetworkError, error::check_weights};
use ne_core::Phenotype;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A net of any graph: a [`GraphShape`] with weights.
///
/// `activate` allocates nothing. A net that is not recurrent has no memory; a recurrent one remembers what its neurons
/// last put out, until it is [`reset`](Phenotype::reset). Finite inputs give finite outputs as long as no sum overflows;
/// inputs that are not finite are not caught: NaN goes through to the outputs.
///
/// Neighbours in the list that share an activation, and of which none feeds a later one, get their activation together.
/// That changes no bit and saves time, so a shape that lists its neurons layer by layer is the fastest.
///
/// In JSON: `{"shape": {"inputs": 2, "recurrent": false, "neurons": […], "outputs": [3]}, "weights": […]}`. Reading
/// checks the shape, the number of weights and that they are finite. What a net remembers is not saved.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "GraphNetData", try_from = "GraphNetData")]
pub struct GraphNet {
    shape: Arc<GraphShape>,
    weights: Vec<f32>,
    /// The sources of all neurons, neuron by neuron: as in the shape, but in one piece.
    sources: Vec<u32>,
    neurons: Vec<Neuron>,
    groups: Vec<Group>,
    /// What each node last put out: inputs, then neurons.
    values: Vec<f32>,
}

/// Which of the weights and sources are a neuron's: those that follow its predecessor's.
#[derive(Clone, Copy, Debug)]
struct Neuron {
    bias: bool,
    sources: u32,
}

/// Neurons, one after the other, of which none needs the new output of another: their sums first, then their activation.
#[derive(Clone, Copy, Debug)]
struct Group {
    activation: Activation,
    neurons: u32,
}

impl GraphNet {
    /// The net of this shape with these weights, in the order [`GraphShape`] documents.
    ///
    /// # Errors
    /// If the shape is not one, the number of weights is not the shape's, or a weight is NaN or infinite; the error names
    /// the field.
    pub fn new(shape: impl Into<Arc<GraphShape>>, weights: &[f32]) -> Result<Self, NetworkError> {
        let shape = shape.into();
        shape.validate()?;
        check_weights(&*shape, shape.weight_count(), weights)?;
        Ok(Self::from_checked(shape, weights))
    }

    /// As [`new`](Self::new), for a shape that was validated before: what a genome uses that is expressed often.
    ///
    /// Weights that are not finite are not caught; the outputs then are not finite either.
    ///
    /// # Panics
    /// If the number of weights is not the shape's.
    pub fn from_checked(shape: Arc<GraphShape>, weights: &[f32]) -> Self {
        assert_eq!(weights.len(), shape.weight_count(), "number of weights for a net of {shape}");
        let mut sources = Vec::with_capacity(weights.len());
        let mut neurons = Vec::with_capacity(shape.neurons.len());
        let mut groups: Vec<Group> = Vec::with_capacity(shape.neurons.len());
        let mut group_start = shape.inputs;
        for (node, neuron) in (shape.inputs..).zip(&shape.neurons) {
            // Validated, so it fits: there are fewer than 2¹⁷ nodes.
            sources.extend(neuron.sources.iter().map(|&source| source as u32));
            neurons.push(Neuron { bias: neuron.bias, sources: neuron.sources.len() as u32 });
            let needs_group = neuron.sources.iter().any(|source| (group_start..node).contains(source));
            match groups.last_mut() {
                Some(group) if group.activation == neuron.activation && !needs_group => group.neurons += 1,
                _ => {
                    groups.push(Group { activation: neuron.activation, neurons: 1 });
                    group_start = node;
                }
            }
        }
        let values = vec![0.0; shape.inputs + shape.neurons.len()];
        Self { shape, weights: weights.to_vec(), sources, neurons, groups, values }
    }

    /// The shape.
    pub fn shape(&self) -> &Arc<GraphShape> {
        &self.shape
    }

    /// The weights, in the order [`GraphShape`] documents.
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// What each node put out when the net was last activated: inputs, then neurons in the order of the shape. Zeros
    /// before.
    pub fn activations(&self) -> &[f32] {
        &self.values
    }
}

impl Phenotype for GraphNet {
    fn inputs(&self) -> usize {
        self.shape.inputs
    }

    fn outputs(&self) -> usize {
        self.shape.outputs.len()
    }

    fn reset(&mut self) {
        self.values.fill(0.0);
    }

    /// # Panics
    /// If the slices are not [`inputs`](Phenotype::inputs) and [`outputs`](Phenotype::outputs) long.
    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        assert_eq!(outputs.len(), self.shape.outputs.len(), "number of outputs");
        let values = self.values.as_mut_slice();
        values[..self.shape.inputs].copy_from_slice(inputs);
        let (mut weights, mut sources) = (self.weights.as_slice(), self.sources.as_slice());
        let mut neurons = self.neurons.as_slice();
        let mut node = self.shape.inputs;
        for group in &self.groups {
            let (members, later) = neurons.split_at(group.neurons as usize);
            let start = node;
            for &neuron in members {
                // Nothing reads this value before the group's activation: a neuron that needs it new is in a later
                // group.
                values[node] = weighted_sum(neuron, &mut weights, &mut sources, values);
                node += 1;
            }
            group.activation.apply_all(&mut values[start..node]);
            neurons = later;
        }
        for (output, &node) in outputs.iter_mut().zip(&self.shape.outputs) {
            *output = values[node];
        }
    }
}

/// The weight of the bias, then weight times source for each source. Takes the neuron's weights and sources off the front.
#[inline(always)]
fn weighted_sum(neuron: Neuron, weights: &mut &[f32], sources: &mut &[u32], values: &[f32]) -> f32 {
    let (bias, rest) = weights.split_at(usize::from(neuron.bias));
    let (my_weights, later_weights) = rest.split_at(neuron.sources as usize);
    let (my_sources, later_sources) = sources.split_at(neuron.sources as usize);
    (*weights, *sources) = (later_weights, later_sources);
    let bias = bias.first().copied().unwrap_or(0.0);
    my_weights.iter().zip(my_sources).fold(bias, |sum, (weight, &source)| sum + weight * values[source as usize])
}

/// Equal nets have equal shapes and weights; what they remember does not count.
impl PartialEq for GraphNet {
    fn eq(&self, other: &Self) -> bool {
        self.shape == other.shape && self.weights == other.weights
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "GraphNet")]
struct GraphNetData {
    shape: Arc<GraphShape>,
    weights: Vec<f32>,
}

impl From<GraphNet> for GraphNetData {
    fn from(net: GraphNet) -> Self {
        Self { shape: net.shape, weights: net.weights }
    }
}

impl TryFrom<GraphNetData> for GraphNet {
    type Error = NetworkError;

    fn try_from(data: GraphNetData) -> Result<Self, NetworkError> {
        Self::new(data.shape, &data.weights)
    }
}
