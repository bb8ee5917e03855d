//! The net of a character: neurons in the order they are computed.

use alloc::vec::Vec;
use ne_net::Activation;

/// A neuron: its output is `scale · activation(bias + Σ weight · source)`, summed in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct Neuron {
    /// Its activation.
    pub activation: Activation,
    /// What its output is multiplied by.
    pub scale: f32,
    /// What its sum begins with; without a bias 0.
    pub bias: f32,
    /// Its sources: node and weight. Nodes are the inputs, from 0, and then the neurons. One that is computed later, or the
    /// neuron itself, gives what it put out in the frame before.
    pub sources: Vec<(u16, f32)>,
}

/// A net of any kind, ready to be computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Net {
    inputs: usize,
    neurons: Vec<Flat>,
    /// Of all neurons, one after the other.
    sources: Vec<(u16, f32)>,
    outputs: Vec<u16>,
    /// Neurons that stand side by side, are alike and do not hear each other: how many.
    groups: Vec<Group>,
}

/// A neuron without its sources.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flat {
    scale: f32,
    bias: f32,
    sources: u32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Group {
    activation: Activation,
    neurons: u32,
}

/// Nodes are numbered with 16 bits.
pub(crate) const MOST_NODES: usize = 1 << 16;

impl Net {
    /// A net, or `None` if a source or an output is no node of it, or there are more than 65,536 nodes.
    pub fn new(inputs: usize, neurons: &[Neuron], outputs: Vec<u16>) -> Option<Self> {
        let nodes = inputs.checked_add(neurons.len()).filter(|&nodes| nodes <= MOST_NODES)?;
        let is_node = |node: u16| usize::from(node) < nodes;
        let sources_are_nodes = neurons.iter().flat_map(|neuron| &neuron.sources).all(|&(source, _)| is_node(source));
        if !sources_are_nodes || !outputs.iter().copied().all(is_node) {
            return None;
        }
        let flat = |neuron: &Neuron| {
            let sources = u32::try_from(neuron.sources.len()).ok()?;
            Some(Flat { scale: neuron.scale, bias: neuron.bias, sources })
        };
        Some(Self {
            inputs,
            neurons: neurons.iter().map(flat).collect::<Option<_>>()?,
            sources: neurons.iter().flat_map(|neuron| neuron.sources.iter().copied()).collect(),
            outputs,
            groups: groups(inputs, neurons),
        })
    }

    /// The number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The number of inputs and neurons.
    pub fn nodes(&self) -> usize {
        self.inputs + self.neurons.len()
    }

    /// The node of each output.
    pub fn outputs(&self) -> &[u16] {
        &self.outputs
    }

    /// The neurons, in the order they are computed.
    pub fn neurons(&self) -> impl Iterator<Item = Neuron> + '_ {
        let activations =
            self.groups.iter().flat_map(|group| core::iter::repeat_n(group.activation, group.neurons as usize));
        let mut rest = self.sources.as_slice();
        self.neurons.iter().zip(activations).map(move |(neuron, activation)| {
            let (own, later) = rest.split_at(neuron.sources as usize);
            rest = later;
            Neuron { activation, scale: neuron.scale, bias: neuron.bias, sources: own.to_vec() }
        })
    }

    /// Computes every neuron. `nodes` holds the inputs, and for each neuron what it put out in the frame before.
    pub(crate) fn activate(&self, nodes: &mut [f32]) {
        let (mut first, mut source) = (self.inputs, 0);
        let mut neurons = self.neurons.iter();
        for group in &self.groups {
            let last = first + group.neurons as usize;
            for (node, neuron) in (first..last).zip(neurons.by_ref()) {
                let next = source + neuron.sources as usize;
                let sum = |sum, &(source, weight): &(u16, f32)| sum + weight * nodes[usize::from(source)];
                nodes[node] = self.sources[source..next].iter().fold(neuron.bias, sum);
                source = next;
            }
            // Gives the bits that each alone would have.
            group.activation.apply_all(&mut nodes[first..last]);
            let scales = &self.neurons[first - self.inputs..last - self.inputs];
            nodes[first..last].iter_mut().zip(scales).for_each(|(node, neuron)| *node *= neuron.scale);
            first = last;
        }
    }
}

/// As long as possible. A neuron hears no other of its group, so that sums may stand where outputs will.
fn groups(inputs: usize, neurons: &[Neuron]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (index, neuron) in neurons.iter().enumerate() {
        let node = inputs + index;
        // What the group has computed so far, and what it has not and must not lose.
        let hears =
            |first: usize| neuron.sources.iter().any(|&(source, _)| (first..=node).contains(&usize::from(source)));
        match groups.last_mut() {
            Some(group) if group.activation == neuron.activation && !hears(node - group.neurons as usize) => {
                group.neurons += 1;
            }
            _ => groups.push(Group { activation: neuron.activation, neurons: 1 }),
        }
    }
    groups
}
