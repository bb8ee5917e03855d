//! What the weights of a net are for, in words: by them a grown net finds again what it had.

use creatures::Channel;
use ne_net::{DenseShape, GraphShape, Topology};

/// The name of each weight of a topology, in the order of its weights; equal names in two nets mean the same connection.
///
/// Of a topology with shared weights, whose genes only its maker can name, the numbers of the genes.
pub(crate) fn of_weights(topology: &Topology, inputs: &[String], outputs: &[String]) -> Vec<String> {
    match topology {
        Topology::Dense(shape) => dense(shape, inputs, outputs),
        Topology::Graph(shape) => graph(shape, inputs, outputs),
        other => (0..other.weight_count()).map(|gene| format!("gene {gene}")).collect(),
    }
}

fn name(names: &[String], index: usize) -> String {
    names.get(index).cloned().unwrap_or_else(|| index.to_string())
}

fn dense(shape: &DenseShape, inputs: &[String], outputs: &[String]) -> Vec<String> {
    let layers = shape.hidden.len() + 1;
    let neuron = |layer: usize, index: usize| match layer {
        0 => format!("input {}", name(inputs, index)),
        _ if layer == layers => format!("output {}", name(outputs, index)),
        _ => format!("hidden {layer}.{index}"),
    };
    let mut names = Vec::with_capacity(shape.weight_count());
    for (layer, (sources, targets)) in shape.connections().enumerate() {
        for target in 0..targets {
            let target = neuron(layer + 1, target);
            names.extend((0..sources).map(|source| format!("{} to {target}", neuron(layer, source))));
            names.push(format!("bias of {target}"));
        }
    }
    names
}

fn graph(shape: &GraphShape, inputs: &[String], outputs: &[String]) -> Vec<String> {
    let mut hidden = 0;
    let mut nodes: Vec<String> = (0..shape.inputs).map(|input| format!("input {}", name(inputs, input))).collect();
    for neuron in 0..shape.neurons.len() {
        let output = shape.outputs.iter().position(|&node| node == shape.inputs + neuron);
        hidden += usize::from(output.is_none());
        nodes.push(match output {
            Some(output) => format!("output {}", name(outputs, output)),
            None => format!("hidden {hidden}"),
        });
    }
    let mut names = Vec::with_capacity(shape.weight_count());
    for (neuron, target) in shape.neurons.iter().zip(&nodes[shape.inputs..]) {
        names.extend(neuron.bias.then(|| format!("bias of {target}")));
        names.extend(neuron.sources.iter().map(|&source| format!("{} to {target}", nodes[source])));
    }
    names
}

/// The names of a topology's weights, for these inputs and outputs.
pub(crate) fn weight_names(topology: &Topology, inputs: &[Channel], outputs: &[Channel]) -> Vec<String> {
    let names = |channels: &[Channel]| channels.iter().map(|channel| channel.name.clone()).collect::<Vec<_>>();
    of_weights(topology, &names(inputs), &names(outputs))
}
