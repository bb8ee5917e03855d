//! A net as operations: neurons that do not hear each other are computed together.
//!
//! A trained net may have weights of 1000: another order of summation, or another approximation of tanh, is then seen in the
//! outputs. So sums are added up in the order of the net (`CumSum`, where a matrix product would have an order of its own), and
//! [activations](super::activations) are made of the operations that the net has. A program that computes each operation with 32
//! bits gives the bits of the net.

use super::{activations::activate, graph::Graph};
use crate::ExportError;
use ne_net::{NetView, NeuronView};
use std::{collections::BTreeSet, ops::Range};

/// The most numbers of all weights together, with the zeros of those that are not there: each takes 12 bytes with the place of
/// its source, and a file holds no more than 2 GB.
const LARGEST: usize = 1 << 27;

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
        graph.begin(&format!("neurons{}", blocks.len() - 1));
        let neurons = &view.neurons[group.start - inputs..group.end - inputs];
        size += most_sources(neurons) * group.len();
        if size > LARGEST {
            return Err(ExportError::TooLarge { weights: size, most: LARGEST });
        }
        let heard = Heard::by(view, &group, &blocks);
        let sums = heard.sums(&mut graph, neurons, weights);
        let activated = activate(&mut graph, neurons[0].activation, &sums);
        let scales: Vec<f32> = neurons.iter().map(|neuron| neuron.scale).collect();
        let name = if scales.iter().all(|&scale| scale == 1.0) {
            activated
        } else {
            let scales = graph.numbers(&[scales.len()], &scales);
            graph.apply("Mul", &[&activated, &scales])
        };
        blocks.push(Block { name, nodes: group });
    }
    graph.begin("net");
    outputs(&mut graph, view, &blocks);
    if is_recurrent {
        graph.output("next_state", neurons, "the state of the next step");
        let names: Vec<&str> = blocks[1..].iter().map(|block| &*block.name).collect();
        graph.along_to(1, "Concat", &names, "next_state");
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

    fn column(&self, source: usize) -> usize {
        let place = self.columns.iter().find(|(nodes, _)| nodes.contains(&source));
        place.map_or(0, |(nodes, first)| first + source - nodes.start)
    }

    /// Weighted sums: for each neuron the weight of its bias, then weight times source for each source, added one after the
    /// other. Neurons with fewer sources than others have weights of 0 at the end.
    fn sums(&self, graph: &mut Graph, neurons: &[NeuronView], weights: &[f32]) -> String {
        let (count, most) = (neurons.len(), most_sources(neurons));
        let (mut columns, mut factors) = (vec![0; count * most], vec![0.0; count * most]);
        for (neuron, target) in neurons.iter().enumerate() {
            for (place, &(source, weight)) in (neuron * most..).zip(&target.sources) {
                (columns[place], factors[place]) = (self.column(source), weights[weight]);
            }
        }
        let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
        let heard = match names[..] {
            [name] => name.into(),
            _ => graph.along(1, "Concat", &names),
        };
        let sources = self.taken(graph, heard, &columns, most);
        let factors = graph.numbers(&[1, count, most], &factors);
        let products = graph.apply("Mul", &[&sources, &factors]);
        let biases: Vec<f32> = neurons.iter().map(|neuron| neuron.bias.map_or(0.0, |weight| weights[weight])).collect();
        let biases = graph.numbers(&[1, count, 1], &biases);
        let terms = graph.along(2, "Concat", &[&biases, &products]);
        let [axis, last] = [2, most].map(|number| graph.whole(number));
        let sums = graph.apply("CumSum", &[&terms, &axis]);
        graph.along(2, "Gather", &[&sums, &last])
    }

    /// The columns that are asked for, of which each neuron has so many.
    fn taken(&self, graph: &mut Graph, heard: String, columns: &[usize], count: usize) -> String {
        let first = &columns[..count];
        let indices = match columns.chunks_exact(count).all(|columns| columns == first) {
            true if first.iter().copied().eq(0..self.width) => return heard,
            true => graph.indices(&[count], first),
            false => graph.indices(&[columns.len() / count, count], columns),
        };
        graph.along(1, "Gather", &[&heard, &indices])
    }
}

/// The most sources of a neuron, but at least one.
fn most_sources(neurons: &[NeuronView]) -> usize {
    neurons.iter().map(|neuron| neuron.sources.len()).max().unwrap_or(0).max(1)
}

/// Picks the outputs out of the blocks.
fn outputs(graph: &mut Graph, view: &NetView, blocks: &[Block]) {
    let is_block = |block: &&Block| block.nodes.clone().eq(view.outputs.iter().copied());
    if let Some(block) = blocks.iter().find(is_block) {
        graph.identity(&block.name, "outputs");
        return;
    }
    let names: Vec<&str> = blocks.iter().map(|block| &*block.name).collect();
    let nodes = graph.along(1, "Concat", &names);
    let indices = graph.indices(&[view.outputs.len()], &view.outputs);
    graph.along_to(1, "Gather", &[&nodes, &indices], "outputs");
}
