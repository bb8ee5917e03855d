use super::{BiasKind, NeatGenome, NodeKind, graph::computation_order};
use ne_core::Genome;
use ne_net::{GraphNet, GraphNeuron, GraphShape};
use std::sync::Arc;

impl Genome for NeatGenome {
    type Phenotype = GraphNet;

    /// Sources of a neuron stand in the order of the innovation numbers.
    fn express(&self) -> GraphNet {
        let order = computation_order(self);
        let inputs = self.layout.inputs;
        // Of each node gene the index in the order, from 1; 0 if it is not expressed.
        let mut computed = vec![0; self.nodes.len()];
        order.iter().zip(1..).for_each(|(&neuron, index)| computed[neuron] = index);
        let per_neuron = self.layout.bias == BiasKind::PerNeuron;
        let mut neurons: Vec<_> = order
            .iter()
            .map(|&neuron| {
                let activation = self.nodes[neuron].activation;
                GraphNeuron { activation, bias: per_neuron, sources: Vec::new() }
            })
            .collect();
        let mut weights_of: Vec<Vec<f32>> =
            order.iter().map(|&neuron| if per_neuron { vec![self.nodes[neuron].bias] } else { Vec::new() }).collect();
        for gene in self.connections.iter().filter(|gene| gene.enabled) {
            let target = self.neuron_index(gene.to).map_or(0, |neuron| computed[neuron]);
            let Some(target) = usize::checked_sub(target, 1) else { continue };
            let source = match self.layout.kind(gene.from) {
                NodeKind::Input => Some(gene.from as usize),
                NodeKind::Bias => None,
                NodeKind::Output | NodeKind::Hidden => {
                    // What a needed neuron has as source is needed too.
                    self.neuron_index(gene.from).map(|neuron| inputs + computed[neuron] - 1)
                }
            };
            match source {
                Some(source) => {
                    neurons[target].sources.push(source);
                    weights_of[target].push(gene.weight);
                }
                None => {
                    neurons[target].bias = true;
                    weights_of[target].insert(0, gene.weight);
                }
            }
        }
        let outputs = (0..self.layout.outputs).map(|output| inputs + computed[output] - 1).collect();
        let shape = GraphShape { inputs, recurrent: self.layout.recurrent, neurons, outputs };
        GraphNet::from_checked(Arc::new(shape), &weights_of.concat())
    }
}
