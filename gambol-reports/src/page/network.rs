//! The champion's net for the page: one form for every kind of net.

use gambol_runs::champion::ChannelRecord;
use ne_net::{Activation, NetView, Network};
use serde::Serialize;

/// A net as nodes and connections. Nodes are numbered: inputs first, then neurons in the order they are computed, so that
/// a connection whose source is not before its target carries what the source put out in the step before.
#[derive(Clone, Debug, Serialize)]
pub struct NetworkData {
    nodes: Vec<Node>,
    inputs: usize,
    /// The node of each output.
    outputs: Vec<usize>,
    /// Source, target, weight.
    connections: Vec<(usize, usize, f32)>,
    /// For each frame every node's activation, in hundredths.
    activations: Vec<Vec<i32>>,
}

#[derive(Clone, Debug, Default, Serialize)]
struct Node {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<String>,
    /// What turns its sum into its output; inputs have none.
    #[serde(skip_serializing_if = "Option::is_none")]
    activation: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bias: Option<f32>,
}

impl NetworkData {
    /// The net, the names of its inputs and outputs, and what it did.
    pub fn new(
        network: &Network,
        input_channels: &[ChannelRecord],
        output_channels: &[ChannelRecord],
        activations: &[Vec<f32>],
    ) -> Self {
        let (NetView { inputs, neurons, outputs }, weights) = (network.view(), network.weights());
        let mut nodes: Vec<Node> = (0..inputs).map(|_| Node::default()).collect();
        let mut connections = Vec::new();
        for neuron in neurons {
            let (target, bias) = (nodes.len(), neuron.bias.map(|weight| weights[weight]));
            connections.extend(neuron.sources.into_iter().map(|(source, weight)| (source, target, weights[weight])));
            nodes.push(Node { activation: Some(name(neuron.activation, neuron.scale)), bias, ..Node::default() });
        }
        let hidden = (inputs..nodes.len()).filter(|node| !outputs.contains(node)).collect::<Vec<_>>();
        for (number, node) in (1..).zip(hidden) {
            nodes[node].name = format!("hidden {number}");
        }
        let outputs_named = outputs.iter().copied().zip(output_channels);
        for (node, channel) in (0..inputs).zip(input_channels).chain(outputs_named) {
            nodes[node].name.clone_from(&channel.name);
            nodes[node].unit = Some(channel.unit.clone());
        }
        let hundredths = |frame: &Vec<f32>| frame.iter().map(|value| (value * 100.0).round() as i32).collect();
        let activations = activations.iter().map(hundredths).collect();
        Self { nodes, inputs, outputs, connections, activations }
    }
}

/// `3 × steep tanh`: as in files, with a space for the hyphen, and with what the output is multiplied by.
fn name(activation: Activation, scale: f32) -> String {
    let name = activation.to_string().replace('-', " ");
    if scale == 1.0 { name } else { format!("{scale} × {name}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_net::{DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape};
    use serde_json::json;

    fn channels(names: &[&str]) -> Vec<ChannelRecord> {
        let channel = |name: &&str| ChannelRecord { name: (*name).into(), unit: "m".into(), range: [-1.0, 1.0] };
        names.iter().map(channel).collect()
    }

    fn data(network: Network, activations: &[Vec<f32>]) -> serde_json::Value {
        let data = NetworkData::new(&network, &channels(&["a", "b"]), &channels(&["c"]), activations);
        serde_json::to_value(data).expect("plain data")
    }

    #[test]
    fn a_dense_net_is_nodes_and_connections() {
        let shape = DenseShape { hidden_scale: 3.0, ..DenseShape::new(2, vec![2], 1) };
        let net = DenseNet::new(shape, &[0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5]).expect("a net");
        let expected = json!({
            "nodes": [
                { "name": "a", "unit": "m" },
                { "name": "b", "unit": "m" },
                { "name": "hidden 1", "activation": "3 × tanh", "bias": 1.5 },
                { "name": "hidden 2", "activation": "3 × tanh", "bias": 3.0 },
                { "name": "c", "unit": "m", "activation": "tanh", "bias": 4.5 },
            ],
            "inputs": 2,
            "outputs": [4],
            "connections": [[0, 2, 0.5], [1, 2, 1.0], [0, 3, 2.0], [1, 3, 2.5], [2, 4, 3.5], [3, 4, 4.0]],
            "activations": [[0, 100, -50, 12, 0]],
        });
        assert_eq!(data(net.into(), &[vec![0.0, 1.0, -0.5, 0.12, 0.004]]), expected);
    }

    #[test]
    fn a_graph_net_keeps_its_order_its_biases_and_its_ways_back() {
        let neuron = |activation, bias, sources: &[usize]| GraphNeuron { activation, bias, sources: sources.into() };
        let neurons = vec![
            neuron(Activation::SteepTanh, false, &[0, 2, 4]),
            neuron(Activation::Relu, true, &[2]),
            neuron(Activation::Sine, true, &[]),
        ];
        let shape = GraphShape { inputs: 2, recurrent: true, neurons, outputs: vec![3] };
        let net = GraphNet::new(shape, &[0.5, 1.0, 1.5, 2.0, 2.5, 3.0]).expect("a net");
        let expected = json!({
            "nodes": [
                { "name": "a", "unit": "m" },
                { "name": "b", "unit": "m" },
                { "name": "hidden 1", "activation": "steep tanh" },
                { "name": "c", "unit": "m", "activation": "relu", "bias": 2.0 },
                { "name": "hidden 2", "activation": "sine", "bias": 3.0 },
            ],
            "inputs": 2,
            "outputs": [3],
            "connections": [[0, 2, 0.5], [2, 2, 1.0], [4, 2, 1.5], [2, 3, 2.5]],
            "activations": [],
        });
        assert_eq!(data(net.into(), &[]), expected);
    }

    #[test]
    fn channels_that_do_not_match_leave_nodes_without_names() {
        let net = DenseNet::new(DenseShape::new(3, vec![], 2), &[0.0; 8]).expect("a net");
        let names: Vec<_> = data(net.into(), &[])["nodes"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|node| node["name"].clone())
            .collect();
        assert_eq!(names, ["a", "b", "", "c", ""]);
    }
}
