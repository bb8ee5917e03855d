//! A genome as a graph, for as long as a question about it takes to answer.
//!
//! A graph holds the connections between neurons: those from inputs and the bias node can be part of no cycle. Its nodes
//! are the indices of the node genes. It is built from the genes in their order each time it is needed, so that no order
//! of petgraph's own can reach a result.

use super::{ConnectionGene, NeatGenome};
use petgraph::{
    acyclic::Acyclic,
    algo::is_cyclic_directed,
    data::Build,
    graph::{DiGraph, NodeIndex},
    visit::{Bfs, Reversed, VisitMap},
};
use std::{cmp::Reverse, collections::BinaryHeap};

pub(crate) type NeuronGraph = DiGraph<(), ()>;

/// The graph of all connections, disabled ones included.
pub(crate) fn of_all_connections(genome: &NeatGenome) -> NeuronGraph {
    graph(genome, |_| true)
}

/// Whether connections, disabled ones included, form a cycle.
pub(crate) fn is_cyclic(genome: &NeatGenome) -> bool {
    is_cyclic_directed(&of_all_connections(genome))
}

/// For each neuron whether a way leads to it from the one at `start`, which counts itself.
pub(crate) fn reachable_from(start: usize, graph: &NeuronGraph) -> Vec<bool> {
    let mut reachable = vec![false; graph.node_count()];
    let mut walk = Bfs::new(graph, NodeIndex::new(start));
    while let Some(neuron) = walk.next(graph) {
        reachable[neuron.index()] = true;
    }
    reachable
}

/// The neurons from which a way of enabled connections leads to an output, in the order they are computed.
///
/// Sources come before the neurons they lead to; of those that are ready the one with the lowest number comes first. In
/// a net with cycles older connections decide: one that closes a cycle with older ones leads backwards, and carries what
/// its source put out in the step before. Disabled connections have their say where there are cycles, so that a split
/// seldom turns an old connection around.
pub(crate) fn computation_order(genome: &NeatGenome) -> Vec<usize> {
    let expressed = graph(genome, |gene| gene.enabled && gene.from != gene.to);
    let is_needed = leads_to_output(genome.layout.outputs, &expressed);
    sources_first(&expressed, &is_needed)
        .or_else(|| sources_first(&forward_connections(genome), &is_needed))
        .expect("forward connections form no cycle")
}

fn graph(genome: &NeatGenome, is_part: impl Fn(&ConnectionGene) -> bool) -> NeuronGraph {
    let mut graph = NeuronGraph::with_capacity(genome.nodes.len(), genome.connections.len());
    for _ in genome.nodes() {
        graph.add_node(());
    }
    for gene in genome.connections.iter().filter(|gene| is_part(gene)) {
        if let Some((from, to)) = ends(genome, gene) {
            graph.add_edge(from, to, ());
        }
    }
    graph
}

/// The neurons at both ends, unless the connection comes from an input or the bias node.
fn ends(genome: &NeatGenome, gene: &ConnectionGene) -> Option<(NodeIndex, NodeIndex)> {
    let neuron = |node| genome.neuron_index(node).map(NodeIndex::new);
    neuron(gene.from).zip(neuron(gene.to))
}

fn leads_to_output(outputs: usize, graph: &NeuronGraph) -> Vec<bool> {
    let reversed = Reversed(graph);
    let mut leads = vec![false; graph.node_count()];
    let mut walk = Bfs::new(reversed, NodeIndex::new(0));
    for output in (1..outputs).map(NodeIndex::new) {
        walk.discovered.visit(output);
        walk.stack.push_back(output);
    }
    while let Some(neuron) = walk.next(reversed) {
        leads[neuron.index()] = true;
    }
    leads
}

/// The needed neurons in topological order, the lowest first of those that are ready; `None` if there is a cycle.
///
/// Source: Kahn, *Topological Sorting of Large Networks*, Communications of the ACM 5(11), 1962.
fn sources_first(graph: &NeuronGraph, is_needed: &[bool]) -> Option<Vec<usize>> {
    let needed = || (0..is_needed.len()).filter(|&neuron| is_needed[neuron]);
    let next = |neuron: usize| graph.neighbors(NodeIndex::new(neuron)).map(NodeIndex::index);
    let mut waits_for = vec![0_usize; is_needed.len()];
    needed().flat_map(next).for_each(|neuron| waits_for[neuron] += 1);
    let mut ready: BinaryHeap<_> = needed().filter(|&neuron| waits_for[neuron] == 0).map(Reverse).collect();
    let mut order = Vec::with_capacity(is_needed.len());
    while let Some(Reverse(neuron)) = ready.pop() {
        order.push(neuron);
        for target in next(neuron) {
            waits_for[target] -= 1;
            if waits_for[target] == 0 && is_needed[target] {
                ready.push(Reverse(target));
            }
        }
    }
    (order.len() == needed().count()).then_some(order)
}

/// The graph of the connections that close no cycle with older ones.
fn forward_connections(genome: &NeatGenome) -> NeuronGraph {
    let mut forward = Acyclic::<NeuronGraph>::new();
    for _ in genome.nodes() {
        forward.add_node(());
    }
    for gene in genome.connections() {
        if let Some((from, to)) = ends(genome, gene) {
            // Refused if it closes a cycle.
            let _ = forward.try_add_edge(from, to, ());
        }
    }
    forward.into_inner()
}
