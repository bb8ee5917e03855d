//! What the weights of a net are for, in words: by them a grown net finds again what it had.

use creatures::Channel;
use ne_net::Topology;

/// The name of each weight of a topology, in the order of its weights; equal names in two nets mean the same connection.
///
/// Of a topology with shared weights, whose genes only its maker can name, the numbers of the genes.
pub(crate) fn of_weights(topology: &Topology, inputs: &[String], outputs: &[String]) -> Vec<String> {
    let hidden: Vec<String> = match topology {
        Topology::Dense(shape) => {
            let layers = (1..).zip(&shape.hidden);
            layers.flat_map(|(layer, &width)| (0..width).map(move |index| format!("hidden {layer}.{index}"))).collect()
        }
        Topology::Graph(shape) => (1..=shape.hidden_count()).map(|number| format!("hidden {number}")).collect(),
        other => return (0..other.weight_count()).map(|gene| format!("gene {gene}")).collect(),
    };
    let (view, mut hidden) = (topology.view(), hidden.into_iter());
    let mut nodes: Vec<String> = (0..view.inputs).map(|input| format!("input {}", name(inputs, input))).collect();
    for node in view.inputs..view.inputs + view.neurons.len() {
        nodes.push(match view.outputs.iter().position(|&output| output == node) {
            Some(output) => format!("output {}", name(outputs, output)),
            None => hidden.next().unwrap_or_default(),
        });
    }
    let mut names = vec![String::new(); topology.weight_count()];
    for (neuron, target) in view.neurons.iter().zip(&nodes[view.inputs..]) {
        if let Some(weight) = neuron.bias {
            names[weight] = format!("bias of {target}");
        }
        for &(source, weight) in &neuron.sources {
            names[weight] = format!("{} to {target}", nodes[source]);
        }
    }
    names
}

fn name(names: &[String], index: usize) -> String {
    names.get(index).cloned().unwrap_or_else(|| index.to_string())
}

/// The names of a topology's weights, for these inputs and outputs.
pub(crate) fn weight_names(topology: &Topology, inputs: &[Channel], outputs: &[Channel]) -> Vec<String> {
    let names = |channels: &[Channel]| channels.iter().map(|channel| channel.name.clone()).collect::<Vec<_>>();
    of_weights(topology, &names(inputs), &names(outputs))
}
