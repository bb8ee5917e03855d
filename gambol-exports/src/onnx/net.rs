//! A net as operations: neurons that do not hear each other are computed together.

use super::graph::Graph;
use crate::ExportError;
use ne_net::{Activation, NetView, NeuronView};
use std::{collections::BTreeSet, ops::Range};

/// The most numbers of all weights together, with the zeros of those that are not there: a file holds no more than 2
/// GB.
const LARGEST: usize = 1 << 28;

/// Nodes that are computed together.
struct Block {
    name: String,
    nodes: Range<usize>,
}

/// The graph of a net.
pub(crate) fn graph(view: &NetView, weights: &[f32]) -> Result<Graph, ExportError> {
    let (inputs, neurons) = (view.inputs, view.neurons.len());
    let mut graph = Graph::new("net");
    graph.input("inputs", inputs, "what is sensed, scaled: see the metadata");
    let is_recurrent = is_recurrent(view);
    if is_recurrent {
        graph.input("state", neurons, "zeros at first; then the next_state of the step before");
    }
    graph.output("outputs", view.outputs.len(), "what motors are asked for, from -1 to 1: see the metadata");
    let mut blocks = vec![Block { name: "inputs".into(), nodes: 0..inputs }];
    let mut size = 0;
    for group in groups(view) {
        let name = format!("neurons{}", blocks.len() - 1);
        let heard = Heard::by(view, &group, &blocks);
        size += heard.width * group.len();
        if size > LARGEST {
            return Err(ExportError::TooLarge { weights: size, most: LARGEST });
        }
        let neurons = &view.neurons[group.start - inputs..group.end - inputs];
        let sums = heard.sums(&mut graph, neurons, weights, &name);
        let name = activate(&mut graph, neurons[0].activation, &sums, &name);
        let scales: Vec<f32> = neurons.iter().map(|neuron| neuron.scale).collect();
        let name = if scales.iter().all(|&scale| scale == 1.0) {
            name
        } else {
            let scales = graph.numbers(&[scales.len()], &scales);
            graph.operation("Mul", &[&name, &scales], &format!("{name}.scaled"))
        };
        blocks.push(Block { name, nodes: group });
    }
    outputs(&mut graph, view, &blocks);
    if is_recurrent {
        graph.output("next_state", neurons, "the state of the next step");
        let names: Vec<&str> = blocks[1..].iter().map(|block| &*block.name).collect();
        graph.along_row("Concat", &names, "next_state");
    }
    Ok(graph)
}

/// Whether a neuron hears what another, or itself, put out in the step before.
fn is_recurrent(view: &NetView) -> bool {
    let hears_late = |(node, neuron): (usize, &NeuronView)| neuron.sources.iter().any(|&(source, _)| source >= node);
    (view.inputs..).zip(&view.neurons).any(hears_late)
}

/// Nodes side by side that have the same activation, and of which none hears what another puts out in this step.
fn groups(view: &NetView) -> Vec<Range<usize>> {
    let mut groups: Vec<Range<usize>> = Vec::new();
    for (node, neuron) in (view.inputs..).zip(&view.neurons) {
        let fits = |group: &Range<usize>| {
            let hears = neuron.sources.iter().any(|(source, _)| group.contains(source));
            view.neurons[group.start - view.inputs].activation == neuron.activation && !hears
        };
        match groups.last_mut().filter(|group| fits(group)) {
            Some(group) => group.end += 1,
            None => groups.push(node..node + 1),
        }
    }
    groups
}

/// What a group hears: blocks, and perhaps the state, one after the other.
#[derive(Default)]
struct Heard {
    names: Vec<String>,
    /// Nodes that stand side by side, and the column of the first.
    columns: Vec<(Range<usize>, usize)>,
    width: usize,
}

impl Heard {
    fn by(view: &NetView, group: &Range<usize>, blocks: &[Block]) -> Self {
        let neurons = &view.neurons[group.start - view.inputs..group.end - view.inputs];
        let sources: BTreeSet<usize> =
            neurons.iter().flat_map(|neuron| neuron.sources.iter().map(|&(source, _)| source)).collect();
        let mut heard = Self::default();
        for Block { name, nodes } in blocks {
            if sources.range(nodes.clone()).next().is_some() {
                heard.add(name, nodes.clone(), 0);
            }
        }
        let nodes = view.inputs + view.neurons.len();
        if sources.range(group.start..).next().is_some() {
            heard.add("state", group.start..nodes, group.start - view.inputs);
        }
        if heard.names.is_empty() {
            // Neurons that hear nothing: all weights are zeros.
            heard.add(&blocks[0].name, 0..view.inputs, 0);
        }
        heard
    }

    /// Nodes, of which there are others before in the same list.
    fn add(&mut self, name: &str, nodes: Range<usize>, before: usize) {
        self.names.push(name.into());
        let first = self.width + before;
        self.width = first + nodes.len();
        self.columns.push((nodes, first));
    }

    /// Weighted sums: a matrix with a row for each node that is heard, and a column for each neuron.
    fn sums(&self, graph: &mut Graph, neurons: &[NeuronView], weights: &[f32], name: &str) -> String {
        let mut matrix = vec![0.0; self.width * neurons.len()];
        for (neuron, target) in neurons.iter().enumerate() {
            for &(source, weight) in &target.sources {
                if let Some((nodes, first)) = self.columns.iter().find(|(nodes, _)| nodes.contains(&source)) {
                    matrix[(first + source - nodes.start) * neurons.len() + neuron] = weights[weight];
                }
            }
        }
        let matrix = graph.numbers(&[self.width, neurons.len()], &matrix);
        let biases: Vec<f32> = neurons.iter().map(|neuron| neuron.bias.map_or(0.0, |weight| weights[weight])).collect();
        let biases = graph.numbers(&[neurons.len()], &biases);
        let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
        let heard = match names[..] {
            [name] => name.into(),
            _ => graph.along_row("Concat", &names, &format!("{name}.heard")),
        };
        graph.operation("Gemm", &[&heard, &matrix, &biases], &format!("{name}.sums"))
    }
}

/// The operations of an activation; the name of their result.
fn activate(graph: &mut Graph, activation: Activation, sums: &str, name: &str) -> String {
    let steep = |graph: &mut Graph, factor: f32| {
        let factor = graph.numbers(&[1], &[factor]);
        graph.operation("Mul", &[sums, &factor], &format!("{name}.steep"))
    };
    match activation {
        Activation::Logistic => graph.operation("Sigmoid", &[sums], name),
        Activation::Tanh => graph.operation("Tanh", &[sums], name),
        Activation::Relu => graph.operation("Relu", &[sums], name),
        Activation::Linear => sums.into(),
        Activation::Sine => graph.operation("Sin", &[sums], name),
        Activation::SteepLogistic => {
            let steep = steep(graph, 4.9);
            graph.operation("Sigmoid", &[&steep], name)
        }
        Activation::SteepTanh => {
            let steep = steep(graph, 2.45);
            graph.operation("Tanh", &[&steep], name)
        }
        Activation::Gaussian => {
            let square = graph.operation("Mul", &[sums, sums], &format!("{name}.square"));
            let negative = graph.operation("Neg", &[&square], &format!("{name}.negative"));
            graph.operation("Exp", &[&negative], name)
        }
        Activation::RationalTanh => rational_tanh(graph, sums, name),
    }
}

/// a(27 + a²) / (27 + 9a²), where a is at most 3 from 0.
fn rational_tanh(graph: &mut Graph, sums: &str, name: &str) -> String {
    let part = |part: &str| format!("{name}.{part}");
    let [nine, twenty_seven] = [9.0, 27.0].map(|number| graph.numbers(&[1], &[number]));
    let mut limits = |most: f32| [-most, most].map(|limit| graph.numbers(&[], &[limit]));
    let ([low, high], [least, most]) = (limits(3.0), limits(1.0));
    let a = graph.operation("Clip", &[sums, &low, &high], &part("limited"));
    let square = graph.operation("Mul", &[&a, &a], &part("square"));
    let sum = graph.operation("Add", &[&square, &twenty_seven], &part("sum"));
    let above = graph.operation("Mul", &[&a, &sum], &part("above"));
    let ninefold = graph.operation("Mul", &[&square, &nine], &part("ninefold"));
    let below = graph.operation("Add", &[&ninefold, &twenty_seven], &part("below"));
    let ratio = graph.operation("Div", &[&above, &below], &part("ratio"));
    graph.operation("Clip", &[&ratio, &least, &most], name)
}

/// Picks the outputs out of the blocks.
fn outputs(graph: &mut Graph, view: &NetView, blocks: &[Block]) {
    let is_block = |block: &&Block| block.nodes.clone().eq(view.outputs.iter().copied());
    if let Some(block) = blocks.iter().find(is_block) {
        graph.operation("Identity", &[&block.name], "outputs");
        return;
    }
    let names: Vec<&str> = blocks.iter().map(|block| &*block.name).collect();
    let nodes = graph.along_row("Concat", &names, "nodes");
    let indices = graph.indices(&view.outputs);
    graph.along_row("Gather", &[&nodes, &indices], "outputs");
}
