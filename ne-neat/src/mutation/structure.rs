//! Connections and neurons are added: first proposed, then numbered, then written into the genome.

use super::{SplitChoice, one_of};
use crate::{
    ConnectionGene, InnovationNumber, NeatGenome, NodeGene, NodeId, NodeKind,
    genome::graph::{of_all_connections, reachable_from},
    innovation::Innovations,
    noise::NewWeights,
};
use ne_core::RandomStream;
use ne_net::Activation;
use rand::RngExt;

/// New structure without numbers, proposed for a genome.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Proposal {
    /// A new connection.
    pub(super) connection: Option<NewConnection>,
    /// A new neuron.
    pub(super) node: Option<NewNode>,
}

/// A connection between two nodes that have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NewConnection {
    from: NodeId,
    to: NodeId,
    weight: f32,
}

/// A neuron in the middle of a connection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NewNode {
    splits: InnovationNumber,
    activation: Activation,
}

/// A connection between two nodes that have none, any such pair alike.
pub(super) fn new_connection(
    genome: &NeatGenome,
    weights: NewWeights,
    stream: &mut RandomStream,
) -> Option<NewConnection> {
    let sources = genome.layout().sources();
    let (neurons, nodes) = (genome.nodes().len(), sources + genome.nodes().len());
    // Whether a connection from the node (row) to the neuron (column) cannot be added.
    let mut excluded = vec![false; nodes * neurons];
    let place = |node: NodeId| genome.neuron_index(node).map_or(node as usize, |neuron| sources + neuron);
    for gene in genome.connections() {
        excluded[place(gene.from) * neurons + place(gene.to) - sources] = true;
    }
    if !genome.layout().recurrent {
        let graph = of_all_connections(genome);
        for target in 0..neurons {
            let reachable = reachable_from(target, &graph);
            for source in (0..neurons).filter(|&source| reachable[source]) {
                excluded[(sources + source) * neurons + target] = true;
            }
        }
    }
    let pair = one_of(&excluded, |excluded| !excluded, stream)?;
    let (row, column) = (pair / neurons, pair % neurons);
    let from = row.checked_sub(sources).map_or(row as NodeId, |neuron| genome.nodes()[neuron].id);
    Some(NewConnection { from, to: genome.nodes()[column].id, weight: weights.draw(stream) })
}

/// A neuron in the middle of an enabled connection, but not of one of the bias node: there it would put out the same
/// always.
pub(super) fn new_node(
    genome: &NeatGenome,
    choice: SplitChoice,
    activations: &[Activation],
    stream: &mut RandomStream,
) -> Option<NewNode> {
    if genome.nodes().len() >= genome.most_neurons() {
        return None;
    }
    let can_split = |gene: &ConnectionGene| gene.enabled && genome.layout().kind(gene.from) != NodeKind::Bias;
    let splits = choice.choose(genome.connections(), can_split, stream)?;
    Some(NewNode { splits, activation: activations[stream.random_range(0..activations.len())] })
}

/// Numbers what is proposed and adds it to the genome.
pub(crate) fn apply(proposal: Proposal, genome: &mut NeatGenome, innovations: &mut Innovations) {
    if let Some(NewConnection { from, to, weight }) = proposal.connection
        && let Some(innovation) = innovations.connection(from, to, genome.layout())
    {
        genome.insert_connection(ConnectionGene { innovation, from, to, weight, enabled: true });
    }
    let Some(NewNode { splits, activation }) = proposal.node else { return };
    let Ok(index) = genome.connections().binary_search_by_key(&splits, |gene| gene.innovation) else { return };
    let old = genome.connections()[index];
    if let Some(split) = innovations.split(&old, genome) {
        genome.genes_mut().1[index].enabled = false;
        genome.insert_node(NodeGene { id: split.node, activation, bias: 0.0 });
        let (from, to, node) = (old.from, old.to, split.node);
        for (innovation, from, to, weight) in
            [(split.incoming, from, node, 1.0), (split.outgoing, node, to, old.weight)]
        {
            genome.insert_connection(ConnectionGene { innovation, from, to, weight, enabled: true });
        }
    }
}
