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

impl Neuron {
    /// How far from 0 its output is at most; infinite where there is no bound.
    fn bound(&self) -> f32 {
        let (least, most) = self.activation.range();
        self.scale.abs() * least.abs().max(most.abs())
    }
}

/// A net of any kind, ready to be computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Net {
    inputs: usize,
    /// No neuron whose output is bounded puts out more than this, either way.
    bound: f32,
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
    /// `None`: there is none.
    gate: Option<Gate>,
}

/// A node that silences a block: where it is open, whatever else the neurons hear, all of them put out 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Gate {
    node: u16,
    weight: f32,
    /// The most that the other nodes add to a sum, either way, if none is beyond ±1.
    others: f32,
}

/// From this sum on, neurons that can be silenced put out 1, to the bit.
const SILENT: f32 = 100.0;

/// A smaller weight makes no gate.
const GATE_WEIGHT: f32 = 500.0;

impl Gate {
    /// What silences these neurons, which hear the same nodes. `is_bounded`: whether a node is an input, or its output is bounded.
    fn of(neurons: &[Neuron], is_bounded: impl Fn(u16) -> bool) -> Option<Self> {
        let first = neurons.first()?;
        let &(node, weight) = first.sources.iter().find(|&&(_, weight)| weight >= GATE_WEIGHT)?;
        let saturates = first.activation.range().1 == 1.0 && first.activation.apply(SILENT) == 1.0;
        let is_gate = |&(source, strength): &(u16, f32)| source == node && strength == weight;
        let alike = neurons.iter().all(|neuron| neuron.sources.iter().filter(|source| is_gate(source)).count() == 1);
        if !saturates || !alike || !first.sources.iter().all(|&(source, _)| is_bounded(source)) {
            return None;
        }
        let others = |neuron: &Neuron| {
            let others = neuron.sources.iter().filter(|source| !is_gate(source));
            others.fold(neuron.bias.abs(), |sum, (_, weight)| sum + weight.abs())
        };
        Some(Self { node, weight, others: neurons.iter().map(others).fold(0.0, f32::max) })
    }

    /// Whether its neurons are silent, if no other node is beyond ± `largest`.
    fn is_open(&self, nodes: &[f32], largest: f32) -> bool {
        self.weight * nodes[usize::from(self.node)] - self.others * largest >= SILENT
    }
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
        let bounds: Vec<f32> = neurons.iter().map(Neuron::bound).collect();
        let bound = bounds.iter().copied().filter(|bound| bound.is_finite()).fold(1.0, f32::max);
        let is_bounded =
            |node: u16| usize::from(node).checked_sub(inputs).is_none_or(|neuron| bounds[neuron].is_finite());
        let (groups, blocks, sources) = (Vec::new(), Vec::new(), Vec::new());
        let mut net = Self { inputs, bound, scales, groups, blocks, sources, outputs };
        let mut first = 0;
        while first < neurons.len() {
            let group = group(inputs, neurons, first);
            let last = first + group;
            let before = net.blocks.len();
            while first < last {
                first += net.add_block(&neurons[first..last], is_bounded)?;
            }
            let (activation, blocks) = (neurons[last - 1].activation, net.blocks.len() - before);
            let [neurons, blocks] = [group, blocks].map(u32::try_from);
            net.groups.push(Group { activation, neurons: neurons.ok()?, blocks: blocks.ok()? });
        }
        Some(net)
    }

    /// As many of these neurons as hear the same nodes as the first; how many.
    fn add_block(&mut self, neurons: &[Neuron], is_bounded: impl Fn(u16) -> bool) -> Option<usize> {
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
        let gate = Gate::of(&neurons[..alike], is_bounded);
        self.blocks.push(Block { neurons: alike as u8, sources, biases, gate });
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

    /// Computes every neuron. `nodes` holds the inputs, none of them NaN, and for each neuron what it put out in the frame before.
    pub(crate) fn activate(&self, nodes: &mut [f32]) {
        let largest = nodes[..self.inputs].iter().fold(self.bound, |largest, input| largest.max(input.abs()));
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
                if block.gate.is_some_and(|gate| gate.is_open(nodes, largest)) {
                    sums = [SILENT; LANES];
                } else {
                    for source in own {
                        let value = nodes[usize::from(source.node)];
                        for (sum, weight) in sums.iter_mut().zip(source.weights) {
                            *sum += weight * value;
                        }
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

    /// One neuron after the other.
    fn compute(neurons: &[Neuron], nodes: &mut [f32]) {
        for (index, neuron) in neurons.iter().enumerate() {
            let sum = |sum: f32, &(node, weight): &(u16, f32)| sum + weight * nodes[usize::from(node)];
            let sum = neuron.sources.iter().fold(neuron.bias, sum);
            nodes[INPUTS + index] = neuron.scale * neuron.activation.apply(sum);
        }
    }

    #[test]
    fn a_gate_is_found_and_skips() {
        let silenced = |weight: f32, activation: Activation| Neuron {
            activation,
            scale: 1.0,
            bias: 0.5,
            sources: vec![(0, 1.0), (1, -2.0), (2, weight)],
        };
        let gate = |neurons: &[Neuron]| Net::new(INPUTS, neurons, vec![0]).expect("nodes").blocks[0].gate;
        let found = gate(&[silenced(1000.0, Activation::Tanh)]).expect("a gate");
        assert_eq!((found.node, found.weight, found.others), (2, 1000.0, 3.5));
        assert!(found.is_open(&[1.0, 1.0, 1.0], 1.0) && !found.is_open(&[1.0, 1.0, 0.0], 1.0));
        assert!(!found.is_open(&[1.0, 400.0, 1.0], 400.0), "what is far out may count for more");
        assert_eq!(gate(&[silenced(90.0, Activation::Tanh)]), None);
        assert_eq!(gate(&[silenced(1000.0, Activation::Relu)]), None);
    }

    /// Some neurons are silenced by what a gate puts out, which opens and closes; what they put out is as if they were not skipped.
    fn gated() -> impl Strategy<Value = Vec<Neuron>> {
        let silenced =
            (prop::sample::select(Activation::ALL.to_vec()), prop::collection::vec(-3.0..3.0_f32, 4), 0..3_usize);
        prop::collection::vec(silenced, 1..12).prop_map(|made| {
            let gate = |bias: f32, weight: f32| Neuron {
                activation: Activation::Logistic,
                scale: 1.0,
                bias,
                sources: vec![(0, weight)],
            };
            let silenced = |(activation, numbers, kind): (Activation, Vec<f32>, usize)| Neuron {
                activation,
                scale: 1.0,
                bias: numbers[0],
                sources: vec![
                    (1, numbers[1]),
                    (2, numbers[2]),
                    (INPUTS as u16 + (kind % 2) as u16, [1000.0, 600.0, 90.0][kind]),
                ],
            };
            let gates = [gate(0.0, 40.0), gate(0.0, -40.0)];
            gates.into_iter().chain(made.into_iter().map(silenced)).collect()
        })
    }

    proptest! {
        #[test]
        fn silenced_neurons_put_out_the_bits_of_any_other(neurons in gated(), inputs in prop::array::uniform3(-1.0..1.0_f32), far in 0..40_i32) {
            let net = Net::new(INPUTS, &neurons, vec![0]).expect("the sources are nodes");
            let mut found = vec![0.0; net.nodes()];
            // Now and then an input that is far out, which no gate may hide.
            found[..INPUTS].copy_from_slice(&[inputs[0], inputs[1] * 1.5_f32.powi(far), inputs[2]]);
            let mut expected = found.clone();
            net.activate(&mut found);
            compute(&neurons, &mut expected);
            prop_assert_eq!(&found, &expected);
        }

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
                compute(&neurons, &mut expected);
                prop_assert_eq!(&found, &expected);
            }
        }
    }
}
