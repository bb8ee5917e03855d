use super::{ConnectionGene, Layout, NeatGenome, NodeGene, NodeId, NodeKind, graph::is_cyclic};
use ne_core::SettingError;
use ne_net::{Copies, GraphShape};
use serde::Deserialize;
use std::{collections::BTreeMap, sync::Arc};

/// Why genes are not a genome.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GenomeError {
    /// The layout is out of range.
    #[error("layout.{0}")]
    Layout(SettingError),
    /// The genes of the outputs are missing, or there is one of an input.
    #[error("nodes: found {found} outputs, the layout has {expected}, numbered from {first}")]
    Outputs {
        /// How many there must be.
        expected: usize,
        /// The number of the first.
        first: NodeId,
        /// How many there are.
        found: usize,
    },
    /// There are too many genes.
    #[error("{field}: found {found}, at most {most} are allowed")]
    TooMany {
        /// Which genes: `nodes` or `connections`.
        field: String,
        /// The most there may be.
        most: usize,
        /// How many there are.
        found: usize,
    },
    /// Genes are not in the order of their numbers, or one is there twice.
    #[error("{field}[{index}]: {number} does not come after {before}")]
    Order {
        /// Which genes: `nodes` or `connections`.
        field: String,
        /// Which gene, from 0.
        index: usize,
        /// Its number.
        number: u32,
        /// The number of the gene before.
        before: u32,
    },
    /// A connection comes from or leads to a node that it cannot.
    #[error("connections[{index}].{end} = {node}: must be {allowed}")]
    End {
        /// Which connection, from 0.
        index: usize,
        /// Which end: `from` or `to`.
        end: String,
        /// The node there.
        node: NodeId,
        /// What is allowed, in words.
        allowed: String,
    },
    /// Two connections lead from and to the same nodes.
    #[error("connections[{index}]: leads from {from} to {to}, as connections[{other}] does")]
    Double {
        /// Which connection, from 0.
        index: usize,
        /// The earlier one.
        other: usize,
        /// Where both come from.
        from: NodeId,
        /// Where both lead to.
        to: NodeId,
    },
    /// A number is NaN or infinite.
    #[error("{field} = {value}: must be finite")]
    NotFinite {
        /// Which one: `nodes[2].bias`.
        field: String,
        /// The number.
        value: f32,
    },
    /// Connections form a cycle where none may be.
    #[error("connections: form a cycle, which a layout that is not recurrent does not allow")]
    Cycle,
    /// The copies are out of range.
    #[error("copies.{0}")]
    CopySettings(SettingError),
    /// The copies are not copies of this net.
    #[error("copies: of a net of {expected} {what}, the layout has {found}")]
    Copies {
        /// `inputs` or `outputs`.
        what: String,
        /// How many the copies are of.
        expected: usize,
        /// How many there are.
        found: usize,
    },
}

impl NeatGenome {
    /// Checks everything that a genome promises.
    pub(super) fn check(&self) -> Result<(), GenomeError> {
        self.layout.validate().map_err(GenomeError::Layout)?;
        self.check_copies()?;
        self.check_nodes()?;
        self.check_connections()?;
        if !self.layout.recurrent && is_cyclic(self) { Err(GenomeError::Cycle) } else { Ok(()) }
    }

    fn check_copies(&self) -> Result<(), GenomeError> {
        let Some(copies) = &self.copies else { return Ok(()) };
        copies.validate().map_err(GenomeError::CopySettings)?;
        for (what, expected, found) in [
            ("inputs", copies.small_inputs(), self.layout.inputs),
            ("outputs", copies.small_outputs(), self.layout.outputs),
        ] {
            if expected != found {
                return Err(GenomeError::Copies { what: what.into(), expected, found });
            }
        }
        Ok(())
    }

    fn check_nodes(&self) -> Result<(), GenomeError> {
        check_count("nodes", self.nodes.len(), self.most_neurons())?;
        check_order("nodes", self.nodes.iter().map(|gene| gene.id))?;
        let Layout { outputs, .. } = self.layout;
        let first = self.layout.sources() as NodeId;
        let expected = first..self.layout.first_hidden();
        let found = self.nodes.iter().filter(|gene| expected.contains(&gene.id)).count();
        // Sorted and without a double: all of them are there if the first is and their number is right.
        if found != outputs || self.nodes[0].id != first {
            return Err(GenomeError::Outputs { expected: outputs, first, found });
        }
        match self.nodes.iter().position(|gene| !gene.bias.is_finite()) {
            Some(index) => {
                Err(GenomeError::NotFinite { field: format!("nodes[{index}].bias"), value: self.nodes[index].bias })
            }
            None => Ok(()),
        }
    }

    fn check_connections(&self) -> Result<(), GenomeError> {
        check_count("connections", self.connections.len(), GraphShape::MAX_WEIGHTS / 2)?;
        check_order("connections", self.connections.iter().map(|gene| gene.innovation))?;
        let mut seen = BTreeMap::new();
        for (index, &ConnectionGene { from, to, weight, .. }) in self.connections.iter().enumerate() {
            let wrong = |end: &str, node, allowed: &str| {
                Err(GenomeError::End { index, end: end.into(), node, allowed: allowed.into() })
            };
            let is_source = matches!(self.layout.kind(from), NodeKind::Input | NodeKind::Bias);
            if !is_source && !self.has_neuron(from) {
                return wrong("from", from, "a node of the genome");
            }
            if !self.has_neuron(to) {
                return wrong("to", to, "a neuron of the genome");
            }
            if let Some(other) = seen.insert((from, to), index) {
                return Err(GenomeError::Double { index, other, from, to });
            }
            if !weight.is_finite() {
                return Err(GenomeError::NotFinite { field: format!("connections[{index}].weight"), value: weight });
            }
        }
        Ok(())
    }
}

fn check_count(field: &str, found: usize, most: usize) -> Result<(), GenomeError> {
    if found <= most { Ok(()) } else { Err(GenomeError::TooMany { field: field.into(), most, found }) }
}

fn check_order(field: &str, numbers: impl Iterator<Item = u32> + Clone) -> Result<(), GenomeError> {
    let pairs = numbers.clone().zip(numbers.skip(1));
    match pairs.zip(1..).find(|((before, number), _)| before >= number) {
        Some(((before, number), index)) => Err(GenomeError::Order { field: field.into(), index, number, before }),
        None => Ok(()),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "NeatGenome")]
pub(super) struct UncheckedGenome {
    layout: Layout,
    nodes: Vec<NodeGene>,
    connections: Vec<ConnectionGene>,
    #[serde(default)]
    copies: Option<Arc<Copies>>,
}

impl TryFrom<UncheckedGenome> for NeatGenome {
    type Error = GenomeError;

    fn try_from(unchecked: UncheckedGenome) -> Result<Self, GenomeError> {
        let UncheckedGenome { layout, nodes, connections, copies } = unchecked;
        Self::unchecked(layout, nodes, connections, copies).checked()
    }
}
