//! A net as a drawing: Graphviz' DOT language.

use gambol_runs::champion::{Champion, ChannelRecord};
use ne_net::NeuronView;
use std::fmt::Write;

/// The net of a champion in the DOT language: inputs on the left, outputs on the right, each connection with its weight,
/// the stronger the thicker; negative ones red, connections from the step before dashed. Biases stand in the neurons.
pub fn dot(champion: &Champion) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_dot(&mut text, champion);
    text
}

/// A node of either kind of net, to be drawn.
struct Node {
    name: String,
    bias: Option<f32>,
    /// Which node, and the weight.
    sources: Vec<(usize, f32)>,
}

fn write_dot(text: &mut String, champion: &Champion) -> std::fmt::Result {
    let (nodes, outputs) = nodes(champion);
    let inputs = champion.inputs.len();
    writeln!(text, "digraph network {{")?;
    writeln!(text, "  rankdir=LR; node [shape=ellipse, fontname=\"sans-serif\"]; edge [fontname=\"sans-serif\"];")?;
    for (index, node) in nodes.iter().enumerate() {
        let bias = node.bias.map_or_else(String::new, |bias| format!("\\nbias {bias:.3}"));
        let shape = if index < inputs || outputs.contains(&index) { ", shape=box" } else { "" };
        writeln!(text, "  n{index} [label=\"{}{bias}\"{shape}];", escaped(&node.name))?;
    }
    for (rank, members) in [("source", (0..inputs).collect::<Vec<_>>()), ("sink", outputs)] {
        let members: Vec<String> = members.iter().map(|node| format!("n{node};")).collect();
        writeln!(text, "  {{ rank={rank}; {} }}", members.join(" "))?;
    }
    for (index, node) in nodes.iter().enumerate() {
        for &(source, weight) in &node.sources {
            let colour = if weight < 0.0 { "firebrick" } else { "steelblue" };
            let style = if source >= index { ", style=dashed" } else { "" };
            let width = (0.5 + weight.abs()).min(4.0);
            writeln!(
                text,
                "  n{source} -> n{index} [label=\"{weight:.3}\", color={colour}, penwidth={width:.2}{style}];"
            )?;
        }
    }
    writeln!(text, "}}")
}

/// All nodes, inputs first, and which are outputs.
fn nodes(champion: &Champion) -> (Vec<Node>, Vec<usize>) {
    let (view, weights) = (champion.network.view(), champion.network.weights());
    let input = |channel: &ChannelRecord| Node { name: channel.name.clone(), bias: None, sources: Vec::new() };
    let neuron = |neuron: &NeuronView| Node {
        name: String::new(),
        bias: neuron.bias.map(|weight| weights[weight]),
        sources: neuron.sources.iter().map(|&(source, weight)| (source, weights[weight])).collect(),
    };
    let mut nodes: Vec<Node> = champion.inputs.iter().map(input).chain(view.neurons.iter().map(neuron)).collect();
    for (&node, channel) in view.outputs.iter().zip(&champion.outputs) {
        nodes[node].name.clone_from(&channel.name);
    }
    let hidden = nodes.iter_mut().skip(view.inputs).filter(|node| node.name.is_empty());
    (1..).zip(hidden).for_each(|(number, node)| node.name = format!("hidden {number}"));
    (nodes, view.outputs)
}

fn escaped(name: &str) -> String {
    name.replace('\\', "\\\\").replace('"', "\\\"")
}
