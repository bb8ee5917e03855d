use crate::{Activation, DenseShape, GraphShape, Network, Topology};

/// A net of any kind as neurons and connections: for those that draw it, name its weights or compute it otherwise.
///
/// Nodes are numbered: first the inputs, from 0, then the neurons in the order they are computed. A source that is not
/// before its neuron gives what it put out in the step before.
#[derive(Clone, Debug, PartialEq)]
pub struct NetView {
    /// The number of inputs.
    pub inputs: usize,
    /// The neurons, in the order they are computed.
    pub neurons: Vec<NeuronView>,
    /// The node of each output.
    pub outputs: Vec<usize>,
}

/// A neuron of a [`NetView`]: `scale · activation(weight of the bias + Σ weight · source)`, summed in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct NeuronView {
    /// Its activation.
    pub activation: Activation,
    /// What its output is multiplied by.
    pub scale: f32,
    /// Which weight is that of its bias, if it has one.
    pub bias: Option<usize>,
    /// Its sources: which node, and which weight.
    pub sources: Vec<(usize, usize)>,
}

impl NetView {
    /// The number of neurons that are not outputs.
    pub fn hidden_count(&self) -> usize {
        self.neurons.len().saturating_sub(self.outputs.len())
    }
}

impl Topology {
    /// Its nets as neurons and connections. With shared weights and in copies too the weights are those of the net.
    pub fn view(&self) -> NetView {
        match self {
            Self::Dense(shape) => dense(shape),
            Self::Graph(shape) => graph(shape),
            Self::Shared(shape) => graph(&shape.net),
            Self::Copied(_) => self.network(&vec![0.0; self.weight_count()]).view(),
        }
    }
}

impl Network {
    /// The net as neurons and connections.
    pub fn view(&self) -> NetView {
        self.topology().view()
    }
}

/// Layer by layer.
fn dense(shape: &DenseShape) -> NetView {
    let mut neurons = Vec::with_capacity(shape.widths().skip(1).sum());
    let (mut first_source, mut weight) = (0, 0);
    for (layer, (sources, targets)) in shape.connections().enumerate() {
        let (activation, scale) = match layer < shape.hidden.len() {
            true => (shape.hidden_activation, shape.hidden_scale),
            false => (shape.output_activation, 1.0),
        };
        for _ in 0..targets {
            let bias = Some(weight + sources);
            neurons.push(NeuronView {
                activation,
                scale,
                bias,
                sources: (first_source..).zip(weight..weight + sources).collect(),
            });
            weight += sources + 1;
        }
        first_source += sources;
    }
    let nodes = shape.inputs + neurons.len();
    NetView { inputs: shape.inputs, neurons, outputs: (nodes - shape.outputs..nodes).collect() }
}

fn graph(shape: &GraphShape) -> NetView {
    let mut weights = 0..;
    let neurons = shape.neurons.iter().map(|neuron| NeuronView {
        activation: neuron.activation,
        scale: 1.0,
        bias: neuron.bias.then(|| weights.next()).flatten(),
        sources: neuron.sources.iter().copied().zip(weights.by_ref()).collect(),
    });
    NetView { inputs: shape.inputs, neurons: neurons.collect(), outputs: shape.outputs.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GraphNeuron;
    use ne_core::Phenotype;

    /// Activates a net by its view.
    fn activate(view: &NetView, weights: &[f32], inputs: &[f32], nodes: &mut [f32]) -> Vec<f32> {
        nodes[..view.inputs].copy_from_slice(inputs);
        for (node, neuron) in (view.inputs..).zip(&view.neurons) {
            let bias = neuron.bias.map_or(0.0, |weight| weights[weight]);
            let sum = neuron.sources.iter().fold(bias, |sum, &(source, weight)| sum + weights[weight] * nodes[source]);
            nodes[node] = neuron.activation.apply(sum) * neuron.scale;
        }
        view.outputs.iter().map(|&node| nodes[node]).collect()
    }

    #[test]
    fn a_view_has_the_bits_of_its_net() {
        let neuron =
            |bias, sources: &[usize]| GraphNeuron { activation: Activation::Sine, bias, sources: sources.into() };
        let neurons = vec![neuron(true, &[0, 3, 2]), neuron(false, &[4, 2]), neuron(true, &[3, 1])];
        let graph = GraphShape { inputs: 2, recurrent: true, neurons, outputs: vec![4, 2] };
        for (topology, hidden) in [(DenseShape::new(2, vec![3, 9], 4).into(), 12), (Topology::from(graph), 1)] {
            let weights: Vec<f32> = (0..topology.weight_count()).map(|index| (index as f32 * 0.7).sin()).collect();
            let (mut network, view) = (topology.network(&weights), topology.view());
            assert_eq!((network.view(), view.hidden_count()), (view.clone(), hidden));
            let mut nodes = vec![0.0; view.inputs + view.neurons.len()];
            for step in 0..3 {
                let (inputs, mut outputs) = ([0.3, step as f32], vec![0.0; topology.outputs()]);
                network.activate(&inputs, &mut outputs);
                assert_eq!(activate(&view, &weights, &inputs, &mut nodes), outputs);
                assert_eq!(network.activations(), nodes);
            }
        }
    }
}
