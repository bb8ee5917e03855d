use super::NodeId;
use ne_net::Activation;
use serde::{Deserialize, Serialize};

/// The number of a connection gene: equal in two genomes if the genes come from the same invention.
pub type InnovationNumber = u32;

/// The gene of a neuron.
///
/// Inputs and the bias node have nothing that could evolve, and so no gene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NodeGene {
    /// The neuron's number.
    pub id: NodeId,
    /// Its activation.
    pub activation: Activation,
    /// Its bias; 0 and without effect unless each neuron has [one of its own](crate::BiasKind::PerNeuron).
    pub bias: f32,
}

/// The gene of a connection.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConnectionGene {
    /// The number of the invention it comes from.
    pub innovation: InnovationNumber,
    /// The node it comes from.
    pub from: NodeId,
    /// The neuron it leads to.
    pub to: NodeId,
    /// Its weight.
    pub weight: f32,
    /// Whether it is expressed. A disabled gene is inherited all the same.
    pub enabled: bool,
}

impl ConnectionGene {
    /// Whether it leads from or to this node.
    pub fn touches(&self, node: NodeId) -> bool {
        self.from == node || self.to == node
    }
}
