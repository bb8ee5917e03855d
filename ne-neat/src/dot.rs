//! A genome as a picture.

use crate::{ConnectionGene, NeatGenome, NodeId, NodeKind, genome::graph::computation_order};
use petgraph::{
    dot::{Config, Dot, RankDir},
    graph::DiGraph,
};
use std::collections::BTreeMap;

impl NeatGenome {
    /// The genome in the language DOT, for Graphviz and everything else that draws graphs.
    ///
    /// Inputs and outputs are labelled with these names, or with their place where there is none (`input 2`), hidden
    /// neurons with number and activation, connections with their weights. Disabled connections are dashed. Recurrent
    /// ones, which carry what their source put out in the step before, are blue and do not move nodes.
    pub fn to_dot(&self, inputs: &[&str], outputs: &[&str]) -> String {
        let sources = 0..self.layout().sources() as NodeId;
        let mut graph = DiGraph::<String, String>::new();
        let mut indices = BTreeMap::new();
        for node in sources.chain(self.nodes().iter().map(|gene| gene.id)) {
            indices.insert(node, graph.add_node(self.node_attributes(node, inputs, outputs)));
        }
        let mut computed = vec![None; self.nodes().len()];
        computation_order(self).into_iter().enumerate().for_each(|(place, neuron)| computed[neuron] = Some(place));
        for gene in self.connections() {
            graph.add_edge(indices[&gene.from], indices[&gene.to], self.connection_attributes(gene, &computed));
        }
        let config = [Config::NodeNoLabel, Config::EdgeNoLabel, Config::RankDir(RankDir::LR)];
        let dot = Dot::with_attr_getters(&graph, &config, &|_, connection| connection.weight().clone(), &|_,
                                                                                                          (
            _,
            attributes,
        )| {
            attributes.clone()
        });
        format!("{dot:?}")
    }

    fn node_attributes(&self, node: NodeId, inputs: &[&str], outputs: &[&str]) -> String {
        let named = |names: &[&str], place: usize, kind: &str| match names.get(place) {
            Some(&name) => name.to_owned(),
            None => format!("{kind} {place}"),
        };
        let (label, shape) = match self.layout().kind(node) {
            NodeKind::Input => (named(inputs, node as usize, "input"), "box"),
            NodeKind::Bias => ("bias".to_owned(), "box"),
            NodeKind::Output => (named(outputs, node as usize - self.layout().sources(), "output"), "doublecircle"),
            NodeKind::Hidden => {
                let activation = self.neuron_index(node).map(|index| self.nodes()[index].activation);
                (format!("{node} {}", activation.unwrap_or_default()), "circle")
            }
        };
        format!("label = {label:?} shape = {shape}")
    }

    /// `computed` has the place of each neuron in the order of computation.
    fn connection_attributes(&self, gene: &ConnectionGene, computed: &[Option<usize>]) -> String {
        let place = |node| self.neuron_index(node).and_then(|neuron| computed[neuron]);
        let is_recurrent = matches!((place(gene.from), place(gene.to)), (Some(from), Some(to)) if from >= to);
        let mut attributes = format!("label = \"{}\"", gene.weight);
        if !gene.enabled {
            attributes += " style = dashed";
        }
        if is_recurrent {
            attributes += " color = blue constraint = false";
        }
        attributes
    }
}
