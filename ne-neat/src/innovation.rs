//! Which number a new gene gets.

use crate::{ConnectionGene, InnovationNumber, Layout, NeatGenome, NodeId};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Gives numbers to new genes: the same invention gets the same number within a generation, any other a new one.
///
/// Genes with the same number come from the same invention; crossover and the distance between genomes are built on
/// that. Mutations only *propose* new structure; numbers are given afterwards, individual by individual, so that it does
/// not matter in which order individuals were mutated.
///
/// Connections from inputs to outputs have their numbers from the beginning and keep them: a genome that has lost one,
/// or started without it, has the same gene again if it invents the connection later. Those of a [hidden
/// layer](crate::StartTopology::HiddenLayer) have numbers from the beginning too.
///
/// Source: Stanley & Miikkulainen, *Evolving Neural Networks through Augmenting Topologies*, Evolutionary Computation
/// 10(2), 2002, section 3.2.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Innovations {
    pub(crate) next_node: NodeId,
    pub(crate) next_innovation: InnovationNumber,
    /// The next node and the next innovation before the generation that was asked and not told yet; `None` where none got numbers.
    /// Asked again, it gets the same ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) before_asked: Option<[u32; 2]>,
    /// The connections invented in this generation. Not saved: a generation begins without any.
    #[serde(skip)]
    connections: BTreeMap<(NodeId, NodeId), InnovationNumber>,
    /// The splits of connections invented in this generation, by the number of the connection split.
    #[serde(skip)]
    splits: BTreeMap<InnovationNumber, Vec<Split>>,
}

/// The numbers of a neuron that splits a connection, and of the connections to and from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Split {
    pub(crate) node: NodeId,
    pub(crate) incoming: InnovationNumber,
    pub(crate) outgoing: InnovationNumber,
}

impl Innovations {
    /// Of a run whose first generation has hidden neurons and connections numbered below these.
    pub(crate) fn new(next_node: NodeId, next_innovation: InnovationNumber) -> Self {
        Self { next_node, next_innovation, before_asked: None, connections: BTreeMap::new(), splits: BTreeMap::new() }
    }

    /// Forgets the inventions of the generation before, or those of this one where it is asked again.
    pub(crate) fn begin_generation(&mut self) {
        [self.next_node, self.next_innovation] = self.next_of_parents();
        self.before_asked = Some([self.next_node, self.next_innovation]);
        self.connections.clear();
        self.splits.clear();
    }

    /// The generation that was asked is told: its numbers are given for good.
    pub(crate) fn end_generation(&mut self) {
        self.before_asked = None;
    }

    /// The next node and the next innovation when the generation last told was told.
    pub(crate) fn next_of_parents(&self) -> [u32; 2] {
        self.before_asked.unwrap_or([self.next_node, self.next_innovation])
    }

    /// The number of a new connection; `None` when numbers have run out.
    pub(crate) fn connection(&mut self, from: NodeId, to: NodeId, layout: &Layout) -> Option<InnovationNumber> {
        if let Some(number) = direct_connection(from, to, layout) {
            return Some(number);
        }
        if let Some(&number) = self.connections.get(&(from, to)) {
            return Some(number);
        }
        let number = self.next_innovation;
        self.next_innovation = number.checked_add(1)?;
        self.connections.insert((from, to), number);
        Some(number)
    }

    /// The numbers of a neuron that splits a connection of this genome; `None` when numbers have run out.
    pub(crate) fn split(&mut self, gene: &ConnectionGene, genome: &NeatGenome) -> Option<Split> {
        let splits = self.splits.entry(gene.innovation).or_default();
        // A genome that has that neuron already splits the connection a second time.
        if let Some(&split) = splits.iter().find(|split| !genome.has_neuron(split.node)) {
            return Some(split);
        }
        let split = Split {
            node: self.next_node,
            incoming: self.next_innovation,
            outgoing: self.next_innovation.checked_add(1)?,
        };
        let next_innovation = split.outgoing.checked_add(1)?;
        self.next_node = split.node.checked_add(1)?;
        self.next_innovation = next_innovation;
        splits.push(split);
        Some(split)
    }
}

/// The number of a connection from an input or the bias node to an output.
pub(crate) fn direct_connection(from: NodeId, to: NodeId, layout: &Layout) -> Option<InnovationNumber> {
    let sources = layout.sources() as NodeId;
    let is_direct = from < sources && (sources..layout.first_hidden()).contains(&to);
    is_direct.then(|| from * layout.outputs as NodeId + (to - sources))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BiasKind, NodeGene};
    use ne_net::Activation;

    const LAYOUT: Layout = Layout { inputs: 2, outputs: 1, bias: BiasKind::InputNode, recurrent: true };

    fn genome(hidden: &[NodeId]) -> NeatGenome {
        let node = |&id: &NodeId| NodeGene { id, activation: Activation::Tanh, bias: 0.0 };
        let connection = ConnectionGene { innovation: 0, from: 0, to: 3, weight: 1.0, enabled: true };
        NeatGenome::new(LAYOUT, [3].iter().chain(hidden).map(node).collect(), vec![connection]).expect("valid")
    }

    #[test]
    fn the_same_invention_has_the_same_number_within_a_generation() {
        let mut innovations = Innovations::new(4, 3);
        assert_eq!(innovations.connection(3, 3, &LAYOUT), Some(3));
        assert_eq!(innovations.connection(0, 4, &LAYOUT), Some(4));
        assert_eq!(innovations.connection(3, 3, &LAYOUT), Some(3));
        innovations.end_generation();
        innovations.begin_generation();
        assert_eq!(innovations.connection(3, 3, &LAYOUT), Some(5));
    }

    #[test]
    fn direct_connections_keep_their_numbers() {
        let mut innovations = Innovations::new(4, 3);
        for generation in 0..2 {
            for from in 0..3 {
                assert_eq!(innovations.connection(from, 3, &LAYOUT), Some(from), "generation {generation}");
            }
            innovations.end_generation();
            innovations.begin_generation();
        }
        assert_eq!(innovations.next_innovation, 3);
    }

    #[test]
    fn the_same_split_has_the_same_numbers_unless_the_genome_has_that_neuron() {
        let mut innovations = Innovations::new(4, 3);
        let plain = genome(&[]);
        let gene = plain.connections()[0];
        let first = Split { node: 4, incoming: 3, outgoing: 4 };
        let second = Split { node: 5, incoming: 5, outgoing: 6 };
        assert_eq!(innovations.split(&gene, &plain), Some(first));
        assert_eq!(innovations.split(&gene, &plain), Some(first));
        assert_eq!(innovations.split(&gene, &genome(&[4])), Some(second));
        assert_eq!(innovations.split(&gene, &genome(&[4])), Some(second));
        innovations.end_generation();
        innovations.begin_generation();
        assert_eq!(innovations.split(&gene, &plain), Some(Split { node: 6, incoming: 7, outgoing: 8 }));
    }

    #[test]
    fn nothing_is_invented_when_numbers_have_run_out() {
        let last = InnovationNumber::MAX;
        let plain = genome(&[]);
        for (node, innovation) in [(4, last), (4, last - 1), (last, 3)] {
            let mut innovations = Innovations::new(node, innovation);
            assert_eq!(innovations.split(&plain.connections()[0], &plain), None);
            assert_eq!((innovations.next_node, innovations.next_innovation), (node, innovation));
        }
        assert_eq!(Innovations::new(4, last).connection(3, 3, &LAYOUT), None);
    }
}
