use crate::Activation;
use ne_core::SettingError;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Neurons and the connections between them, in the order they are computed: everything of a graph net but its weights.
///
/// Nodes are numbered: first the inputs, from 0, then the neurons in the order of [`neurons`](Self::neurons). A neuron
/// puts out `activation(weight of its bias + Σ weight · source)`, sources summed in the order listed.
///
/// Neurons are computed one after the other. A source that stands before its neuron gives what it puts out in this
/// step; the neuron itself or one behind it gives what it put out in the step before, 0 in the first. So every listing
/// of a recurrent net is a net; a net that is not recurrent lists all sources before their neurons, which is possible
/// exactly if there is no cycle.
///
/// # Order of the weights
/// Neuron by neuron; for a neuron first the weight of its bias, if it has one, then those of its sources, in order.
///
/// ```
/// use ne_net::{Activation, GraphNeuron, GraphShape};
///
/// // Two inputs (nodes 0 and 1), a hidden neuron (node 2), and an output (node 3), which hears the first input too.
/// let hidden = GraphNeuron { activation: Activation::Tanh, bias: true, sources: vec![0, 1] };
/// let output = GraphNeuron { activation: Activation::Tanh, bias: false, sources: vec![2, 0] };
/// let shape = GraphShape { inputs: 2, recurrent: false, neurons: vec![hidden, output], outputs: vec![3] };
/// assert_eq!((shape.weight_count(), shape.validate()), (5, Ok(())));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "UncheckedShape")]
#[cfg_attr(feature = "schema", schemars(!try_from, deny_unknown_fields))]
pub struct GraphShape {
    /// Number of inputs, from 1 to 4096.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 4096)))]
    pub inputs: usize,
    /// Whether a neuron may have itself or a later neuron as source.
    pub recurrent: bool,
    /// Hidden neurons and outputs in the order they are computed; from 1 to 65,536.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 65_536)))]
    pub neurons: Vec<GraphNeuron>,
    /// The node of each output: a neuron; from 1 to 4096 of them.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 4096), inner(range(min = 1))))]
    pub outputs: Vec<usize>,
}

/// A neuron of a [`GraphShape`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GraphNeuron {
    /// Its activation.
    pub activation: Activation,
    /// Whether it has a bias: a weight of its own for a constant 1.
    pub bias: bool,
    /// The nodes it gets its input from, each once.
    pub sources: Vec<usize>,
}

impl GraphShape {
    /// The most inputs, and the most outputs.
    pub const MAX_WIDTH: usize = 4096;
    /// The most neurons.
    pub const MAX_NEURONS: usize = 1 << 16;
    /// The most weights.
    pub const MAX_WEIGHTS: usize = 1 << 24;

    /// The number of weights, biases included.
    pub fn weight_count(&self) -> usize {
        self.neurons.iter().map(GraphNeuron::weight_count).sum()
    }

    /// The number of connections, biases not counted.
    pub fn connection_count(&self) -> usize {
        self.neurons.iter().map(|neuron| neuron.sources.len()).sum()
    }

    /// The number of neurons that are not outputs.
    pub fn hidden_count(&self) -> usize {
        self.neurons.len().saturating_sub(self.outputs.len())
    }

    /// Checks numbers and connections.
    ///
    /// # Errors
    /// Names the field and what is allowed: `neurons[0].sources[1] = 4: must be below 3, …`.
    pub fn validate(&self) -> Result<(), SettingError> {
        check_count("inputs", self.inputs, Self::MAX_WIDTH)?;
        check_count("neurons", self.neurons.len(), Self::MAX_NEURONS)?;
        check_count("outputs", self.outputs.len(), Self::MAX_WIDTH)?;
        if self.weight_count() > Self::MAX_WEIGHTS {
            let (found, allowed) = (format!("{} weights", self.weight_count()), Self::MAX_WEIGHTS);
            return Err(SettingError::new("neurons", found, format!("at most {allowed} weights")));
        }
        let nodes = self.inputs + self.neurons.len();
        let mut seen_by = vec![0; nodes];
        for (index, neuron) in self.neurons.iter().enumerate() {
            let node = self.inputs + index;
            for (place, &source) in neuron.sources.iter().enumerate() {
                let wrong =
                    |allowed| Err(SettingError::new(format!("neurons[{index}].sources[{place}]"), source, allowed));
                if source >= nodes {
                    return wrong(format!("below {nodes}, the number of nodes"));
                }
                if !self.recurrent && source >= node {
                    return wrong(format!(
                        "below {node}, the node of this neuron: a net that is not recurrent has no cycles, and lists \
                         sources before the neurons they lead to"
                    ));
                }
                if std::mem::replace(&mut seen_by[source], node) == node {
                    return wrong("listed once".into());
                }
            }
        }
        let mut is_output = vec![false; nodes];
        for (place, &output) in self.outputs.iter().enumerate() {
            let wrong = |allowed| Err(SettingError::new(format!("outputs[{place}]"), output, allowed));
            if !(self.inputs..nodes).contains(&output) {
                return wrong(format!("a neuron, from {} to {}", self.inputs, nodes - 1));
            }
            if std::mem::replace(&mut is_output[output], true) {
                return wrong("listed once".into());
            }
        }
        Ok(())
    }
}

impl GraphNeuron {
    /// The number of its weights: bias and sources.
    pub fn weight_count(&self) -> usize {
        usize::from(self.bias) + self.sources.len()
    }
}

fn check_count(field: &str, count: usize, most: usize) -> Result<(), SettingError> {
    if (1..=most).contains(&count) {
        Ok(())
    } else {
        Err(SettingError::new(field, format!("{count} {field}"), format!("from 1 to {most} {field}")))
    }
}

/// Inputs, hidden neurons, outputs and connections: `9 inputs, 3 hidden, 8 outputs, 78 connections`.
impl fmt::Display for GraphShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (hidden, outputs) = (self.hidden_count(), self.outputs.len());
        write!(f, "{} inputs, {hidden} hidden, {outputs} outputs, {} connections", self.inputs, self.connection_count())
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "GraphShape")]
struct UncheckedShape {
    inputs: usize,
    recurrent: bool,
    neurons: Vec<GraphNeuron>,
    outputs: Vec<usize>,
}

impl TryFrom<UncheckedShape> for GraphShape {
    type Error = SettingError;

    fn try_from(unchecked: UncheckedShape) -> Result<Self, SettingError> {
        let UncheckedShape { inputs, recurrent, neurons, outputs } = unchecked;
        let shape = Self { inputs, recurrent, neurons, outputs };
        shape.validate()?;
        Ok(shape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn neuron(sources: &[usize]) -> GraphNeuron {
        GraphNeuron { activation: Activation::Tanh, bias: true, sources: sources.to_vec() }
    }

    /// Two inputs, a hidden neuron, an output.
    fn shape() -> GraphShape {
        GraphShape { inputs: 2, recurrent: false, neurons: vec![neuron(&[0, 1]), neuron(&[2, 0])], outputs: vec![3] }
    }

    #[test]
    fn errors_name_the_field_and_what_is_allowed() {
        let one_place = |sources: &[usize]| GraphShape { neurons: vec![neuron(sources), neuron(&[0])], ..shape() };
        let outputs = |outputs: &[usize]| GraphShape { outputs: outputs.to_vec(), ..shape() };
        let all = neuron(&(0..4096).collect::<Vec<_>>());
        for (shape, message) in [
            (GraphShape { inputs: 0, ..shape() }, "inputs = 0 inputs: must be from 1 to 4096 inputs"),
            (GraphShape { inputs: 4097, ..shape() }, "inputs = 4097 inputs: must be from 1 to 4096 inputs"),
            (GraphShape { neurons: vec![], ..shape() }, "neurons = 0 neurons: must be from 1 to 65536 neurons"),
            (
                GraphShape { neurons: vec![neuron(&[]); 65_537], ..shape() },
                "neurons = 65537 neurons: must be from 1 to 65536 neurons",
            ),
            (
                GraphShape { inputs: 4096, neurons: vec![all; 4096], ..shape() },
                "neurons = 16781312 weights: must be at most 16777216 weights",
            ),
            (outputs(&[]), "outputs = 0 outputs: must be from 1 to 4096 outputs"),
            (outputs(&[2; 4097]), "outputs = 4097 outputs: must be from 1 to 4096 outputs"),
            (outputs(&[3, 1]), "outputs[1] = 1: must be a neuron, from 2 to 3"),
            (outputs(&[4]), "outputs[0] = 4: must be a neuron, from 2 to 3"),
            (outputs(&[3, 2, 3]), "outputs[2] = 3: must be listed once"),
            (one_place(&[0, 4]), "neurons[0].sources[1] = 4: must be below 4, the number of nodes"),
            (one_place(&[0, 1, 0]), "neurons[0].sources[2] = 0: must be listed once"),
            (GraphShape { recurrent: true, ..one_place(&[3, 3]) }, "neurons[0].sources[1] = 3: must be listed once"),
            (
                one_place(&[2]),
                "neurons[0].sources[0] = 2: must be below 2, the node of this neuron: a net that is not recurrent has no \
                 cycles, and lists sources before the neurons they lead to",
            ),
            (
                one_place(&[0, 3]),
                "neurons[0].sources[1] = 3: must be below 2, the node of this neuron: a net that is not recurrent has no \
                 cycles, and lists sources before the neurons they lead to",
            ),
        ] {
            assert_eq!(shape.validate().expect_err("not allowed").to_string(), message);
        }
    }

    #[test]
    fn a_recurrent_net_may_have_any_source() {
        let shape = GraphShape { recurrent: true, neurons: vec![neuron(&[3, 2]), neuron(&[3, 2, 0])], ..shape() };
        assert_eq!((shape.validate(), shape.weight_count(), shape.connection_count()), (Ok(()), 7, 5));
    }

    #[test]
    fn a_file_is_checked() {
        let read = |text: &str| serde_json::from_str::<GraphShape>(text);
        let text = serde_json::to_string(&shape()).expect("serialises");
        assert_eq!(read(&text).expect("a shape"), shape());
        let error = read(&text.replace("\"inputs\":2", "\"inputs\":1")).expect_err("another numbering").to_string();
        assert!(error.contains("neurons[0].sources[1] = 1: must be below 1, the node of this neuron"), "{error}");
        let error = read(&text.replace("recurrent", "cyclic")).expect_err("unknown field").to_string();
        assert!(error.contains("unknown field `cyclic`, expected one of `inputs`, `recurrent`"), "{error}");
        let error = read(r#"{"inputs": 2}"#).expect_err("half a shape").to_string();
        assert!(error.contains("missing field `recurrent`"), "{error}");
    }
}
