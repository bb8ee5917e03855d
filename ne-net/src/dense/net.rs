use super::DenseShape;
use crate::{Activation, NetworkError, error::check_weights};
use ne_core::Phenotype;
use serde::{Deserialize, Serialize};
use std::{ops::Range, sync::Arc};

/// A dense feed-forward net: a [`DenseShape`] with weights.
///
/// `activate` allocates nothing. Sums start with the bias and add the sources in order, so that a net gives the same
/// bits everywhere. Finite inputs give finite outputs as long as no sum overflows; inputs that are not finite are not
/// caught: NaN goes through to the outputs. A net has no memory, so `reset` changes nothing.
///
/// In JSON: `{"shape": {"inputs": 9, "hidden": [10], "outputs": 8, …}, "weights": [188 numbers]}`. Reading checks the
/// shape, the number of weights and that they are finite.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "DenseNetData", try_from = "DenseNetData")]
pub struct DenseNet {
    shape: Arc<DenseShape>,
    weights: Vec<f32>,
    /// The weights in the order `activate` reads them: layer by layer, block of targets by block of targets; for a block
    /// the weights of the bias, then those of each source. The blocks' missing targets have weights of zero.
    rows: Vec<Block>,
    /// What each layer of neurons last put out, in whole blocks.
    values: Vec<Block>,
    layers: Vec<Layer>,
}

/// Neurons side by side that are computed at once: two vector registers of the smallest machines.
type Block = [f32; LANES];
const LANES: usize = 8;

/// A layer of neurons and the weights that lead to it.
#[derive(Clone, Debug)]
struct Layer {
    width: usize,
    /// Where its outputs are in `values`.
    values: Range<usize>,
    /// Where the weights that lead to it are in `rows`; none for the inputs.
    rows: Range<usize>,
    activation: Activation,
    /// What the outputs are multiplied by.
    scale: f32,
}

impl DenseNet {
    /// The net of this shape with these weights, in the order [`DenseShape`] documents.
    ///
    /// # Errors
    /// If the shape is out of range, the number of weights is not the shape's, or a weight is NaN or infinite; the error
    /// names the field.
    pub fn new(shape: impl Into<Arc<DenseShape>>, weights: &[f32]) -> Result<Self, NetworkError> {
        let shape = shape.into();
        shape.validate()?;
        check_weights(format!("shape {shape}"), shape.weight_count(), weights)?;
        Ok(Self::from_checked(shape, weights))
    }

    /// As [`new`](Self::new), for a shape that was validated before: what a genome uses that is expressed often.
    ///
    /// Weights that are not finite are not caught; the outputs then are not finite either.
    ///
    /// # Panics
    /// If the number of weights is not the shape's.
    pub fn from_checked(shape: Arc<DenseShape>, weights: &[f32]) -> Self {
        assert_eq!(weights.len(), shape.weight_count(), "number of weights for a net of shape {shape}");
        let (layers, rows, values) = lay_out(&shape);
        let mut net = Self { shape, weights: weights.to_vec(), rows, values, layers };
        net.arrange_weights();
        net
    }

    /// The shape.
    pub fn shape(&self) -> &Arc<DenseShape> {
        &self.shape
    }

    /// The weights, in the order [`DenseShape`] documents.
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// What each layer of neurons put out when the net was last activated: inputs, hidden layers (scaled, as the next
    /// layer gets them), outputs. Zeros before.
    pub fn activations(&self) -> impl ExactSizeIterator<Item = &[f32]> {
        self.layers.iter().map(|layer| &self.values[layer.values.clone()].as_flattened()[..layer.width])
    }

    /// Copies the weights into `rows`.
    fn arrange_weights(&mut self) {
        let mut weights = self.weights.as_slice();
        for (sources, layer) in self.layers.iter().zip(&self.layers[1..]) {
            let count = sources.width + 1;
            let blocks = self.rows[layer.rows.clone()].chunks_exact_mut(count);
            let (mine, rest) = weights.split_at(count * layer.width);
            for (block, targets) in blocks.zip(mine.chunks(count * LANES)) {
                for (lane, target) in targets.chunks_exact(count).enumerate() {
                    // In the file the bias comes last, here first.
                    block[0][lane] = target[sources.width];
                    block[1..].iter_mut().zip(target).for_each(|(row, &weight)| row[lane] = weight);
                }
            }
            weights = rest;
        }
    }
}

impl Phenotype for DenseNet {
    fn inputs(&self) -> usize {
        self.shape.inputs
    }

    fn outputs(&self) -> usize {
        self.shape.outputs
    }

    fn reset(&mut self) {}

    /// # Panics
    /// If the slices are not [`inputs`](Phenotype::inputs) and [`outputs`](Phenotype::outputs) long.
    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        let [input_layer, layers @ ..] = self.layers.as_slice() else { return };
        let (mut before, mut after) = self.values.split_at_mut(input_layer.values.len());
        let mut sources = &mut before.as_flattened_mut()[..input_layer.width];
        sources.copy_from_slice(inputs);
        for layer in layers {
            (before, after) = after.split_at_mut(layer.values.len());
            let rows = &self.rows[layer.rows.clone()];
            for (target, block) in before.iter_mut().zip(rows.chunks_exact(sources.len() + 1)) {
                *target = weighted_sums(block, sources);
            }
            let values = before.as_flattened_mut();
            layer.activation.apply_all(values);
            if layer.scale != 1.0 {
                values.iter_mut().for_each(|value| *value *= layer.scale);
            }
            sources = &mut values[..layer.width];
        }
        outputs.copy_from_slice(sources);
    }
}

/// Equal nets have equal shapes and weights; what they were last fed does not count.
impl PartialEq for DenseNet {
    fn eq(&self, other: &Self) -> bool {
        self.shape == other.shape && self.weights == other.weights
    }
}

/// The sums of a block of targets: the bias' weights, then weight times source for each source.
#[inline(always)]
fn weighted_sums(block: &[Block], sources: &[f32]) -> Block {
    let [bias, rows @ ..] = block else { return [0.0; LANES] };
    let mut sums = *bias;
    for (row, &source) in rows.iter().zip(sources) {
        for (sum, weight) in sums.iter_mut().zip(row) {
            *sum += weight * source;
        }
    }
    sums
}

/// The layers of a valid shape, and zeroed memory for weights and outputs.
fn lay_out(shape: &DenseShape) -> (Vec<Layer>, Vec<Block>, Vec<Block>) {
    let last = shape.hidden.len() + 1;
    let mut layers: Vec<Layer> = Vec::with_capacity(last + 1);
    for (index, width) in shape.widths().enumerate() {
        let blocks = width.div_ceil(LANES);
        let (values, rows, row_count) = match layers.last() {
            None => (0, 0, 0),
            Some(before) => (before.values.end, before.rows.end, blocks * (before.width + 1)),
        };
        let (activation, scale) = match index {
            0 => (Activation::Linear, 1.0),
            _ if index == last => (shape.output_activation, 1.0),
            _ => (shape.hidden_activation, shape.hidden_scale),
        };
        layers.push(Layer { width, values: values..values + blocks, rows: rows..rows + row_count, activation, scale });
    }
    let (rows, values) = layers.last().map_or((0, 0), |layer| (layer.rows.end, layer.values.end));
    (layers, vec![[0.0; LANES]; rows], vec![[0.0; LANES]; values])
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "DenseNet")]
struct DenseNetData {
    shape: Arc<DenseShape>,
    weights: Vec<f32>,
}

impl From<DenseNet> for DenseNetData {
    fn from(net: DenseNet) -> Self {
        Self { shape: net.shape, weights: net.weights }
    }
}

impl TryFrom<DenseNetData> for DenseNet {
    type Error = NetworkError;

    fn try_from(data: DenseNetData) -> Result<Self, NetworkError> {
        Self::new(data.shape, &data.weights)
    }
}
