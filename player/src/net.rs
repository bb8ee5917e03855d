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
    /// What the output of each neuron is multiplied by.
    scales: Vec<f32>,
    groups: Vec<Group>,
    blocks: Vec<Block>,
    /// Of all blocks, one after the other.
    sources: Vec<Source>,
    outputs: Vec<u16>,
}

/// Neurons that stand side by side, are alike and do not hear each other.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Group {
    activation: Activation,
    neurons: u32,
    blocks: u32,
}

/// So many sums are computed at once.
const LANES: usize = 4;

/// Up to [`LANES`] neurons of a group that hear the same nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Block {
    neurons: u8,
    sources: u32,
    biases: [f32; LANES],
}

/// A node, and its weight in each neuron of a block; 0 where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Source {
    node: u16,
    weights: [f32; LANES],
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
        let scales = neurons.iter().map(|neuron| neuron.scale).collect();
        let mut net = Self { inputs, scales, groups: Vec::new(), blocks: Vec::new(), sources: Vec::new(), outputs };
        let mut first = 0;
        while first < neurons.len() {
            let group = group(inputs, neurons, first);
            let last = first + group;
            let before = net.blocks.len();
            while first < last {
                first += net.add_block(&neurons[first..last])?;
            }
            let (activation, blocks) = (neurons[last - 1].activation, net.blocks.len() - before);
            let [neurons, blocks] = [group, blocks].map(u32::try_from);
            net.groups.push(Group { activation, neurons: neurons.ok()?, blocks: blocks.ok()? });
        }
        Some(net)
    }

    /// As many of these neurons as hear the same nodes as the first; how many.
    fn add_block(&mut self, neurons: &[Neuron]) -> Option<usize> {
        let nodes = |neuron: &'_ Neuron| neuron.sources.iter().map(|&(node, _)| node).collect::<Vec<u16>>();
        let first = neurons.first()?;
        let heard = nodes(first);
        let alike = neurons.iter().take(LANES).take_while(|neuron| nodes(neuron) == heard).count();
        let mut biases = [0.0; LANES];
        biases.iter_mut().zip(&neurons[..alike]).for_each(|(bias, neuron)| *bias = neuron.bias);
        self.sources.extend(heard.iter().enumerate().map(|(index, &node)| {
            let mut weights = [0.0; LANES];
            weights.iter_mut().zip(&neurons[..alike]).for_each(|(weight, neuron)| *weight = neuron.sources[index].1);
            Source { node, weights }
        }));
        let sources = u32::try_from(heard.len()).ok()?;
        self.blocks.push(Block { neurons: alike as u8, sources, biases });
        Some(alike)
    }

    /// The number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The number of inputs and neurons.
    pub fn nodes(&self) -> usize {
        self.inputs + self.scales.len()
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
        let places = self.blocks.iter().flat_map(move |block| {
            let (sources, later) = rest.split_at(block.sources as usize);
            rest = later;
            (0..usize::from(block.neurons)).map(move |lane| (block.biases[lane], lane, sources))
        });
        places.zip(activations).zip(&self.scales).map(|(((bias, lane, sources), activation), &scale)| {
            let sources = sources.iter().map(|source| (source.node, source.weights[lane])).collect();
            Neuron { activation, scale, bias, sources }
        })
    }

    /// Computes every neuron. `nodes` holds the inputs, and for each neuron what it put out in the frame before.
    pub(crate) fn activate(&self, nodes: &mut [f32]) {
        let mut first = self.inputs;
        let (mut blocks, mut sources) = (self.blocks.as_slice(), self.sources.as_slice());
        for group in &self.groups {
            let last = first + group.neurons as usize;
            let mut node = first;
            let (own, later) = blocks.split_at(group.blocks as usize);
            blocks = later;
            for block in own {
                let (own, later) = sources.split_at(block.sources as usize);
                sources = later;
                // Each neuron's sum in its own order: the bits are those it would have alone.
                let mut sums = block.biases;
                for source in own {
                    let value = nodes[usize::from(source.node)];
                    for (sum, weight) in sums.iter_mut().zip(source.weights) {
                        *sum += weight * value;
                    }
                }
                let next = node + usize::from(block.neurons);
                nodes[node..next].iter_mut().zip(sums).for_each(|(node, sum)| *node = sum);
                node = next;
            }
            group.activation.apply_all(&mut nodes[first..last]);
            let scales = &self.scales[first - self.inputs..last - self.inputs];
            nodes[first..last].iter_mut().zip(scales).for_each(|(node, scale)| *node *= scale);
            first = last;
        }
    }
}

/// How many neurons from this one on make up a group: as many as possible. A neuron hears no other of its group, so that sums
/// may stand where outputs will.
fn group(inputs: usize, neurons: &[Neuron], first: usize) -> usize {
    let activation = neurons[first].activation;
    let belongs = |&(index, neuron): &(usize, &Neuron)| {
        // What the group has computed so far, and what it has not and must not lose.
        let own = inputs + first..=inputs + index;
        neuron.activation == activation
            && (index == first || !neuron.sources.iter().any(|&(source, _)| own.contains(&usize::from(source))))
    };
    neurons.iter().enumerate().skip(first).take_while(belongs).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use proptest::prelude::*;

    const INPUTS: usize = 3;

    /// Neurons of which many hear the same nodes, some nodes that are computed later, and themselves.
    fn neurons() -> impl Strategy<Value = Vec<Neuron>> {
        let activation = prop_oneof![Just(Activation::Tanh), Just(Activation::Tanh), Just(Activation::Relu)];
        let neuron = (activation, 0..3_usize, prop::collection::vec(-1.0..1.0_f32, 6));
        prop::collection::vec(neuron, 1..20).prop_map(|made| {
            let nodes = (INPUTS + made.len()) as u16;
            let heard = |kind: usize| [vec![0, 1, 2], vec![2, nodes / 2, nodes - 1], vec![nodes - 1, 0]][kind].clone();
            let neuron = |(activation, kind, numbers): (Activation, usize, Vec<f32>)| Neuron {
                activation,
                scale: 1.0 + numbers[0],
                bias: numbers[1],
                sources: heard(kind).into_iter().zip(numbers[2..].iter().copied()).collect(),
            };
            made.into_iter().map(neuron).collect()
        })
    }

    proptest! {
        /// However they are put together, they put out the bits that each alone would, one after the other.
        #[test]
        fn neurons_are_computed_as_if_one_after_the_other(neurons in neurons(), inputs in prop::array::uniform3(-1.0..1.0_f32)) {
            let net = Net::new(INPUTS, &neurons, vec![0]).expect("the sources are nodes");
            prop_assert_eq!(net.neurons().collect::<Vec<_>>(), neurons.clone());
            let mut found = vec![0.0; net.nodes()];
            let mut expected = found.clone();
            for frame in 0..4 {
                for nodes in [&mut found, &mut expected] {
                    nodes[..INPUTS].copy_from_slice(&inputs.map(|input| input * (1 + frame) as f32));
                }
                net.activate(&mut found);
                for (index, neuron) in neurons.iter().enumerate() {
                    let sum = |sum: f32, &(node, weight): &(u16, f32)| sum + weight * expected[usize::from(node)];
                    let sum = neuron.sources.iter().fold(neuron.bias, sum);
                    expected[INPUTS + index] = neuron.scale * neuron.activation.apply(sum);
                }
                prop_assert_eq!(&found, &expected);
            }
        }
    }
}
