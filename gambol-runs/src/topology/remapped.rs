//! A frozen topology for a body that senses or moves something else than the one it was found in.

use crate::config::FrozenTopology;
use creatures::Channel;
use ne_net::{Activation, DenseShape, GraphNeuron, GraphShape, Topology};

impl FrozenTopology {
    /// The topology with these inputs and outputs. A new input of a graph is connected with every output; a new output has a
    /// bias and hears every input. What it has too much is given up if `forget` says so: inputs with all connections from them,
    /// outputs by becoming hidden neurons; else it stays, and is refused when it is used.
    pub(crate) fn remapped(&self, senses: &[Channel], motors: &[Channel], forget: bool) -> Self {
        let names = |channels: &[Channel]| channels.iter().map(|channel| channel.name.clone()).collect::<Vec<_>>();
        let (inputs, outputs) = (names(senses), names(motors));
        let kept = |old: &[String], new: &[String]| old.iter().all(|name| new.contains(name));
        let fits = kept(&self.inputs, &inputs) && kept(&self.outputs, &outputs);
        if !(fits || forget) {
            return self.clone();
        }
        let net = match &self.net {
            Topology::Dense(shape) => {
                DenseShape { inputs: inputs.len(), outputs: outputs.len(), ..DenseShape::clone(shape) }.into()
            }
            Topology::Graph(shape) => self.remapped_graph(shape, &inputs, &outputs).into(),
            other => other.clone(),
        };
        Self { inputs, outputs, net, genes: self.genes.clone() }
    }

    fn remapped_graph(&self, shape: &GraphShape, inputs: &[String], outputs: &[String]) -> GraphShape {
        let place = |name: &String| inputs.iter().position(|other| other == name);
        // What is no neuron stays below them, and is refused when it is used; so is an output that the net does not have.
        let neuron_node = |node: usize| (inputs.len() + node).saturating_sub(shape.inputs);
        let source_node = |&node: &usize| match self.inputs.get(node).filter(|_| node < shape.inputs) {
            Some(name) => place(name),
            None => Some(neuron_node(node)),
        };
        let new_inputs: Vec<usize> = (0..inputs.len()).filter(|&input| !self.inputs.contains(&inputs[input])).collect();
        let mut neurons: Vec<GraphNeuron> = Vec::with_capacity(shape.neurons.len());
        for (index, neuron) in shape.neurons.iter().enumerate() {
            let mut sources: Vec<usize> = neuron.sources.iter().filter_map(source_node).collect();
            if shape.outputs.contains(&(shape.inputs + index)) {
                sources.extend(&new_inputs);
            }
            neurons.push(GraphNeuron { sources, ..neuron.clone() });
        }
        let activation = shape.outputs.first().and_then(|&output| shape.neurons.get(output.checked_sub(shape.inputs)?));
        let activation = activation.map_or(Activation::Tanh, |neuron| neuron.activation);
        let mut output_node = |name: &String| match self.outputs.iter().position(|other| other == name) {
            Some(output) => shape.outputs.get(output).map_or(0, |&node| neuron_node(node)),
            None => {
                neurons.push(GraphNeuron { activation, bias: true, sources: (0..inputs.len()).collect() });
                inputs.len() + neurons.len() - 1
            }
        };
        let outputs = outputs.iter().map(&mut output_node).collect();
        GraphShape { inputs: inputs.len(), recurrent: shape.recurrent, neurons, outputs }
    }
}
