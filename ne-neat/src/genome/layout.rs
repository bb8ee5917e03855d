use ne_core::SettingError;
use ne_net::GraphShape;
use serde::{Deserialize, Serialize};

/// The number of a node, the same in all genomes of a run: first the inputs, from 0, then the bias node if there is
/// one, then the outputs, then hidden neurons as they are invented.
pub type NodeId = u32;

/// What all genomes of a run have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layout {
    /// Number of inputs, from 1 to 4096; the bias node is not counted.
    pub inputs: usize,
    /// Number of outputs, from 1 to 4096.
    pub outputs: usize,
    /// How neurons get a bias.
    pub bias: BiasKind,
    /// Whether connections may form cycles. A connection that closes one carries what its source put out in the step
    /// before.
    pub recurrent: bool,
}

/// How neurons get a bias.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum BiasKind {
    /// From a node that always puts out 1, as in the paper: a bias is the weight of a connection from it, and evolves as
    /// connections do. A neuron can be without.
    InputNode,
    /// Every neuron has one in its gene; it mutates as weights do.
    PerNeuron,
    /// No neuron has one.
    None,
}

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// It puts out what the net is given.
    Input,
    /// It puts out 1.
    Bias,
    /// A neuron that the net's output is read from.
    Output,
    /// A neuron between the others.
    Hidden,
}

impl Layout {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        for (field, width) in [("inputs", self.inputs), ("outputs", self.outputs)] {
            if !(1..=GraphShape::MAX_WIDTH).contains(&width) {
                return Err(SettingError::new(field, width, format!("from 1 to {}", GraphShape::MAX_WIDTH)));
            }
        }
        Ok(())
    }

    /// What the node is. Whether a genome has a hidden neuron of that number is another question.
    pub fn kind(&self, node: NodeId) -> NodeKind {
        let node = node as usize;
        if node < self.inputs {
            NodeKind::Input
        } else if node < self.sources() {
            NodeKind::Bias
        } else if node < self.sources() + self.outputs {
            NodeKind::Output
        } else {
            NodeKind::Hidden
        }
    }

    /// The number of nodes that are not neurons: inputs, and the bias node if there is one.
    pub fn sources(&self) -> usize {
        self.inputs + usize::from(self.bias == BiasKind::InputNode)
    }

    /// The lowest number a hidden neuron can have.
    pub fn first_hidden(&self) -> NodeId {
        (self.sources() + self.outputs) as NodeId
    }
}
