use super::{BiasKind, NeatGenome, NodeKind, graph::computation_order};
use ne_core::Genome;
use ne_net::{GraphNet, GraphNeuron, GraphShape};
use std::sync::Arc;

/// What a neuron of the net gets.
struct Incoming {
    /// The neuron's index in the order of computation.
    target: usize,
    /// The node it comes from; `None` for the bias node.
    source: Option<usize>,
    weight: f32,
}

impl Genome for NeatGenome {
    type Phenotype = GraphNet;

    /// Sources of a neuron stand in the order of the innovation numbers.
    fn express(&self) -> GraphNet {
        let order = computation_order(self);
        let inputs = self.layout.inputs;
        let has_biases = self.layout.bias == BiasKind::PerNeuron;
        let mut computed = vec![None; self.nodes.len()];
        order.iter().enumerate().for_each(|(index, &neuron)| computed[neuron] = Some(index));

        let mut incoming = Vec::with_capacity(self.connections.len());
        for gene in self.connections.iter().filter(|gene| gene.enabled) {
            let index = |node| self.neuron_index(node).and_then(|neuron| computed[neuron]);
            let Some(target) = index(gene.to) else { continue };
            let source = match self.layout.kind(gene.from) {
                NodeKind::Input => Some(gene.from as usize),
                NodeKind::Bias => None,
                // A source of a neuron that is computed is computed too.
                NodeKind::Output | NodeKind::Hidden => index(gene.from).map(|index| inputs + index),
            };
            incoming.push(Incoming { target, source, weight: gene.weight });
        }
        // The bias comes first; those of one neuron keep their order otherwise.
        incoming.sort_by_key(|connection| (connection.target, connection.source.is_some()));

        let mut rest = &incoming[..];
        let mut neurons = Vec::with_capacity(order.len());
        let mut weights = Vec::with_capacity(incoming.len() + order.len());
        for (index, &neuron) in order.iter().enumerate() {
            let (own, later) = rest.split_at(rest.partition_point(|connection| connection.target == index));
            rest = later;
            let mut sources = Vec::with_capacity(own.len());
            sources.extend(own.iter().filter_map(|connection| connection.source));
            let bias = has_biases || sources.len() < own.len();
            neurons.push(GraphNeuron { activation: self.nodes[neuron].activation, bias, sources });
            weights.extend(has_biases.then_some(self.nodes[neuron].bias));
            weights.extend(own.iter().map(|connection| connection.weight));
        }
        let outputs = computed[..self.layout.outputs].iter().flatten().map(|index| inputs + index).collect();
        let shape = GraphShape { inputs, recurrent: self.layout.recurrent, neurons, outputs };
        let net = GraphNet::from_checked(Arc::new(shape), &weights);
        match &self.copies {
            Some(copies) => copies.whole(&net),
            None => net,
        }
    }
}
