use crate::lanes::Lanes;
use ne_net::{Activation, DenseShape, GraphShape, Network, Topology};
use std::ops::Range;

/// Nets of one topology, each lane with weights of its own. Sums are added in the order the nets of `ne-net` add them in,
/// and activations are theirs, so a lane gives the bits of its net.
#[derive(Clone, Debug)]
pub(crate) struct LaneNet<const W: usize> {
    inputs: usize,
    neurons: Vec<Neuron>,
    /// The nodes each neuron gets its input from: inputs from 0, then neurons.
    sources: Vec<u32>,
    /// For each neuron that of its bias, if it has one, then one a source.
    weights: Vec<Lanes<W>>,
    /// For each of `weights`, its place among the weights of a net.
    place: Vec<u32>,
    /// What each node last put out.
    values: Vec<Lanes<W>>,
    outputs: Vec<u32>,
}

#[derive(Clone, Debug)]
struct Neuron {
    activation: Activation,
    /// What the output is multiplied by.
    scale: f32,
    bias: bool,
    sources: Range<usize>,
}

impl<const W: usize> LaneNet<W> {
    /// None for a kind of net that has no lanes.
    pub(crate) fn new(topology: &Topology) -> Option<Self> {
        let mut net = Self {
            inputs: topology.inputs(),
            neurons: Vec::new(),
            sources: Vec::new(),
            weights: Vec::new(),
            place: Vec::new(),
            values: Vec::new(),
            outputs: Vec::new(),
        };
        match topology {
            Topology::Dense(shape) => net.lay_out_dense(shape),
            Topology::Graph(shape) => net.lay_out_graph(shape),
            _ => return None,
        }
        net.weights = vec![Lanes::ZERO; net.place.len()];
        net.values = vec![Lanes::ZERO; net.inputs + net.neurons.len()];
        Some(net)
    }

    fn lay_out_dense(&mut self, shape: &DenseShape) {
        let widths: Vec<usize> = shape.widths().collect();
        let (mut first_source, mut first_weight) = (0, 0);
        for (layer, pair) in widths.windows(2).enumerate() {
            let (sources, targets) = (pair[0], pair[1]);
            let last = layer + 2 == widths.len();
            for _ in 0..targets {
                let from = self.sources.len();
                self.sources.extend((first_source..first_source + sources).map(|source| source as u32));
                self.neurons.push(Neuron {
                    activation: if last { shape.output_activation } else { shape.hidden_activation },
                    scale: if last { 1.0 } else { shape.hidden_scale },
                    bias: true,
                    sources: from..self.sources.len(),
                });
                // In the file the bias comes last.
                self.place.push((first_weight + sources) as u32);
                self.place.extend((first_weight..first_weight + sources).map(|weight| weight as u32));
                first_weight += sources + 1;
            }
            first_source += sources;
        }
        let nodes = self.inputs + self.neurons.len();
        self.outputs = (nodes - shape.outputs..nodes).map(|node| node as u32).collect();
    }

    fn lay_out_graph(&mut self, shape: &GraphShape) {
        for neuron in &shape.neurons {
            let from = self.sources.len();
            self.sources.extend(neuron.sources.iter().map(|&source| source as u32));
            self.neurons.push(Neuron {
                activation: neuron.activation,
                scale: 1.0,
                bias: neuron.bias,
                sources: from..self.sources.len(),
            });
        }
        self.place = (0..shape.weight_count() as u32).collect();
        self.outputs = shape.outputs.iter().map(|&output| output as u32).collect();
    }

    /// Puts a net of the same topology into a lane; it remembers nothing.
    pub(crate) fn load(&mut self, lane: usize, network: &Network) {
        let theirs = network.weights();
        for (weight, &place) in self.weights.iter_mut().zip(&self.place) {
            weight.0[lane] = theirs[place as usize];
        }
        self.forget(lane);
    }

    /// Lets a lane's net forget what it put out.
    pub(crate) fn forget(&mut self, lane: usize) {
        for value in &mut self.values {
            value.0[lane] = 0.0;
        }
    }

    #[inline(always)]
    pub(crate) fn activate(&mut self, inputs: &[Lanes<W>], outputs: &mut [Lanes<W>]) {
        self.values[..self.inputs].copy_from_slice(inputs);
        let mut weights = self.weights.as_slice();
        for (node, neuron) in (self.inputs..).zip(&self.neurons) {
            let (bias, rest) = weights.split_at(usize::from(neuron.bias));
            let (mine, later) = rest.split_at(neuron.sources.len());
            weights = later;
            let mut sum = bias.first().copied().unwrap_or(Lanes::ZERO);
            for (&weight, &source) in mine.iter().zip(&self.sources[neuron.sources.clone()]) {
                sum += weight * self.values[source as usize];
            }
            neuron.activation.apply_to_lanes(&mut sum.0);
            if neuron.scale != 1.0 {
                sum = sum * Lanes::splat(neuron.scale);
            }
            self.values[node] = sum;
        }
        for (output, &node) in outputs.iter_mut().zip(&self.outputs) {
            *output = self.values[node as usize];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::Phenotype;
    use ne_net::GraphNeuron;
    use proptest::prelude::*;
    use std::sync::Arc;

    /// Runs a net and a lane with its weights side by side for some steps.
    fn check(topology: &Topology, numbers: &[f32]) {
        let mut numbers = numbers.iter().copied().cycle();
        let mut next = || numbers.next().expect("there are numbers");
        let mut nets: Vec<Network> = (0..3)
            .map(|_| {
                let weights: Vec<f32> = (0..topology.weight_count()).map(|_| next()).collect();
                topology.network(&weights)
            })
            .collect();
        let mut lanes = LaneNet::<4>::new(topology).expect("a kind with lanes");
        for (lane, net) in nets.iter().enumerate() {
            lanes.load(lane + 1, net);
        }
        let mut outputs = vec![Lanes::ZERO; topology.outputs()];
        for _ in 0..5 {
            let inputs: Vec<Lanes<4>> = (0..topology.inputs()).map(|_| Lanes([0; 4].map(|_| next()))).collect();
            lanes.activate(&inputs, &mut outputs);
            for (lane, net) in nets.iter_mut().enumerate() {
                let mine: Vec<f32> = inputs.iter().map(|input| input.0[lane + 1]).collect();
                let mut wanted = vec![0.0; topology.outputs()];
                net.activate(&mine, &mut wanted);
                let found: Vec<f32> = outputs.iter().map(|output| output.0[lane + 1]).collect();
                assert_eq!(found, wanted);
            }
        }
    }

    fn dense(hidden: Vec<usize>, activation: Activation) -> Topology {
        let shape = DenseShape {
            inputs: 5,
            hidden,
            outputs: 3,
            hidden_activation: activation,
            output_activation: Activation::Tanh,
            hidden_scale: 1.7,
        };
        Topology::Dense(Arc::new(shape))
    }

    fn graph() -> Topology {
        let neuron = |activation, bias, sources: &[usize]| GraphNeuron { activation, bias, sources: sources.to_vec() };
        let shape = GraphShape {
            inputs: 2,
            recurrent: true,
            neurons: vec![
                neuron(Activation::Tanh, true, &[0, 1, 3]),
                neuron(Activation::Sine, false, &[2, 3, 0]),
                neuron(Activation::SteepTanh, true, &[3, 2, 4]),
            ],
            outputs: vec![4, 2],
        };
        Topology::Graph(Arc::new(shape))
    }

    proptest! {
        #[test]
        fn lanes_have_the_bits_of_their_nets(numbers in prop::collection::vec(-3.0f32..3.0, 97)) {
            for activation in Activation::ALL {
                check(&dense(vec![4], activation), &numbers);
            }
            check(&dense(vec![], Activation::Tanh), &numbers);
            check(&dense(vec![9, 6], Activation::Relu), &numbers);
            check(&graph(), &numbers);
        }
    }
}
