use crate::Activation;
use ne_core::SettingError;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The layers of a dense feed-forward net: everything but its weights.
///
/// Each neuron of a layer is connected with all neurons of the layer before and with that layer's bias, a constant 1;
/// every layer but the last has a bias. Its output is `activation(Σ weight · source + weight of the bias)`; in hidden
/// layers that is then multiplied by [`hidden_scale`](Self::hidden_scale).
///
/// # Order of the weights
/// Layer by layer; in a layer target neuron by target neuron; for a target first the weight of each source, in order,
/// then that of the bias. So a net of widths n₀ … nₖ has Σ (nᵢ + 1) · nᵢ₊₁ weights, and 9-10-8 has 188.
///
/// ```
/// use ne_net::DenseShape;
///
/// let shape = DenseShape::new(9, vec![10], 8);
/// assert_eq!((shape.weight_count(), shape.to_string().as_str()), (188, "9-10-8"));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "UncheckedShape")]
#[cfg_attr(feature = "schema", schemars(!try_from, deny_unknown_fields))]
pub struct DenseShape {
    /// Number of inputs, from 1 to 4096.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 4096)))]
    pub inputs: usize,
    /// Number of neurons in each hidden layer, from 1 to 4096; up to 64 layers, or none.
    #[cfg_attr(feature = "schema", schemars(length(max = 64), inner(range(min = 1, max = 4096))))]
    pub hidden: Vec<usize>,
    /// Number of outputs, from 1 to 4096.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 4096)))]
    pub outputs: usize,
    /// The activation of all hidden neurons; default tanh.
    #[cfg_attr(feature = "schema", schemars(default = "default_activation"))]
    pub hidden_activation: Activation,
    /// The activation of the outputs; default tanh.
    #[cfg_attr(feature = "schema", schemars(default = "default_activation"))]
    pub output_activation: Activation,
    /// What the output of a hidden neuron is multiplied by, above 0 and at most 1000; default 3.
    ///
    /// The thesis feeds every layer values in [-3, 3], where tanh is neither flat nor a line: inputs are scaled so from
    /// outside, hidden outputs by this factor.
    #[cfg_attr(feature = "schema", schemars(default = "default_scale", range(max = 1000.0), extend("exclusiveMinimum" = 0.0)))]
    pub hidden_scale: f32,
}

impl DenseShape {
    /// The most neurons in a layer.
    pub const MAX_WIDTH: usize = 4096;
    /// The most hidden layers.
    pub const MAX_HIDDEN_LAYERS: usize = 64;
    /// The most weights.
    pub const MAX_WEIGHTS: usize = 1 << 24;

    /// A shape with these layers and the defaults of the thesis: tanh everywhere, hidden outputs scaled by 3.
    ///
    /// Nothing is checked here; [`validate`](Self::validate) does, and so do all that build on a shape.
    pub fn new(inputs: usize, hidden: Vec<usize>, outputs: usize) -> Self {
        let (hidden_activation, output_activation) = (default_activation(), default_activation());
        Self { inputs, hidden, outputs, hidden_activation, output_activation, hidden_scale: default_scale() }
    }

    /// The number of weights, biases included.
    pub fn weight_count(&self) -> usize {
        self.connections().fold(0, |count, (sources, targets)| {
            count.saturating_add(sources.saturating_add(1).saturating_mul(targets))
        })
    }

    /// The number of neurons in each layer: inputs, hidden layers, outputs.
    pub fn widths(&self) -> impl Iterator<Item = usize> + '_ {
        [self.inputs].into_iter().chain(self.hidden.iter().copied()).chain([self.outputs])
    }

    /// The number of sources (bias not counted) and targets of each layer of weights.
    pub fn connections(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.widths().zip(self.widths().skip(1))
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `hidden[0] = 0: must be from 1 to 4096`.
    pub fn validate(&self) -> Result<(), SettingError> {
        let check = |field: &str, width: usize| {
            if (1..=Self::MAX_WIDTH).contains(&width) {
                Ok(())
            } else {
                Err(SettingError::new(field, width, format!("from 1 to {}", Self::MAX_WIDTH)))
            }
        };
        check("inputs", self.inputs)?;
        if self.hidden.len() > Self::MAX_HIDDEN_LAYERS {
            let (found, allowed) = (format!("{} layers", self.hidden.len()), Self::MAX_HIDDEN_LAYERS);
            return Err(SettingError::new("hidden", found, format!("at most {allowed} layers")));
        }
        for (layer, &width) in self.hidden.iter().enumerate() {
            check(&format!("hidden[{layer}]"), width)?;
        }
        check("outputs", self.outputs)?;
        SettingError::check_above_0("hidden_scale", self.hidden_scale, 1000.0)?;
        if self.weight_count() > Self::MAX_WEIGHTS {
            let found = format!("{:?} ({} weights)", self.hidden, self.weight_count());
            return Err(SettingError::new(
                "hidden",
                found,
                format!("so that there are at most {} weights", Self::MAX_WEIGHTS),
            ));
        }
        Ok(())
    }
}

/// The widths, hyphens between: `9-10-8`.
impl fmt::Display for DenseShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.inputs)?;
        self.widths().skip(1).try_for_each(|width| write!(f, "-{width}"))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "DenseShape")]
struct UncheckedShape {
    inputs: usize,
    hidden: Vec<usize>,
    outputs: usize,
    #[serde(default = "default_activation")]
    hidden_activation: Activation,
    #[serde(default = "default_activation")]
    output_activation: Activation,
    #[serde(default = "default_scale")]
    hidden_scale: f32,
}

fn default_activation() -> Activation {
    Activation::Tanh
}

fn default_scale() -> f32 {
    3.0
}

impl TryFrom<UncheckedShape> for DenseShape {
    type Error = SettingError;

    fn try_from(unchecked: UncheckedShape) -> Result<Self, SettingError> {
        let UncheckedShape { inputs, hidden, outputs, hidden_activation, output_activation, hidden_scale } = unchecked;
        let shape = Self { inputs, hidden, outputs, hidden_activation, output_activation, hidden_scale };
        shape.validate().map(|()| shape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_weights_as_the_thesis_does() {
        for (inputs, hidden, outputs, count) in
            [(9, vec![10], 8, 188), (9, vec![8], 8, 152), (3, vec![], 2, 8), (2, vec![3, 4], 1, 9 + 16 + 5)]
        {
            assert_eq!(DenseShape::new(inputs, hidden, outputs).weight_count(), count);
        }
    }

    #[test]
    fn errors_name_the_field_and_the_range() {
        let shape = DenseShape::new(9, vec![10], 8);
        for (shape, message) in [
            (DenseShape { inputs: 0, ..shape.clone() }, "inputs = 0: must be from 1 to 4096"),
            (DenseShape { outputs: 4097, ..shape.clone() }, "outputs = 4097: must be from 1 to 4096"),
            (DenseShape { hidden: vec![0], ..shape.clone() }, "hidden[0] = 0: must be from 1 to 4096"),
            (DenseShape { hidden: vec![5, 5000], ..shape.clone() }, "hidden[1] = 5000: must be from 1 to 4096"),
            (DenseShape { hidden: vec![1; 65], ..shape.clone() }, "hidden = 65 layers: must be at most 64 layers"),
            (
                DenseShape { hidden: vec![4096, 4096], ..shape.clone() },
                "hidden = [4096, 4096] (16855048 weights): must be so that there are at most 16777216 weights",
            ),
            (DenseShape { hidden_scale: 0.0, ..shape.clone() }, "hidden_scale = 0: must be above 0 and at most 1000"),
            (DenseShape { hidden_scale: f32::NAN, ..shape }, "hidden_scale = NaN: must be above 0 and at most 1000"),
        ] {
            assert_eq!(shape.validate().expect_err("not allowed").to_string(), message);
        }
    }

    #[test]
    fn a_file_is_checked_and_may_leave_defaults_out() {
        let read = serde_json::from_str::<DenseShape>;
        let shape = read(r#"{"inputs": 9, "hidden": [10], "outputs": 8}"#).expect("a shape");
        assert_eq!(shape, DenseShape::new(9, vec![10], 8));
        let error = read(r#"{"inputs": 9, "hidden": [0], "outputs": 8}"#).expect_err("no neuron").to_string();
        assert!(error.contains("hidden[0] = 0: must be from 1 to 4096"), "{error}");
        assert!(read(r#"{"inputs": 9, "hidden": [1], "outputs": 8, "layers": 3}"#).is_err());
    }
}
