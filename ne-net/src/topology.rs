use crate::{
    CopiedShape, DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape, Network, NetworkError, SharedShape,
    error::check_weights,
};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};
use std::{fmt, sync::Arc};

/// A net of any kind without its weights: what searches for weights keep fixed.
///
/// The shapes are shared, so that a clone is cheap.
///
/// In JSON: `{"dense": {…}}`, `{"graph": {…}}`, `{"shared": {…}}` or `{"copied": {…}}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Topology {
    /// Layers, each fully connected with the next.
    Dense(Arc<DenseShape>),
    /// Any graph, such as one that NEAT has found.
    Graph(Arc<GraphShape>),
    /// A graph whose weights are computed from fewer genes; its nets are graph nets.
    Shared(Arc<SharedShape>),
    /// Copies of one small net, whose weights they all have; its nets are graph nets.
    Copied(Arc<CopiedShape>),
}

impl Topology {
    /// The number of inputs.
    pub fn inputs(&self) -> usize {
        match self {
            Self::Dense(shape) => shape.inputs,
            Self::Graph(shape) => shape.inputs,
            Self::Shared(shape) => shape.net.inputs,
            Self::Copied(shape) => shape.copies.inputs,
        }
    }

    /// The number of outputs.
    pub fn outputs(&self) -> usize {
        match self {
            Self::Dense(shape) => shape.outputs,
            Self::Graph(shape) => shape.outputs.len(),
            Self::Shared(shape) => shape.net.outputs.len(),
            Self::Copied(shape) => shape.copies.outputs.len(),
        }
    }

    /// The number of weights, biases included; of a topology with shared weights the number of its genes,
    /// and of copies that of the small net.
    pub fn weight_count(&self) -> usize {
        match self {
            Self::Dense(shape) => shape.weight_count(),
            Self::Graph(shape) => shape.weight_count(),
            Self::Shared(shape) => shape.gene_count(),
            Self::Copied(shape) => shape.small.weight_count(),
        }
    }

    /// For each neuron the number of its weights, in the order in which they stand; of a topology with shared weights, for each group of
    /// genes their number.
    pub fn weights_of_neurons(&self) -> impl Iterator<Item = usize> + '_ {
        let (dense, graph, shared) = match self {
            Self::Dense(shape) => (Some(shape), None, None),
            Self::Graph(shape) => (None, Some(shape), None),
            Self::Copied(shape) => (None, Some(&shape.small), None),
            Self::Shared(shape) => (None, None, Some(shape)),
        };
        let dense = dense.into_iter().flat_map(|shape| shape.connections());
        let dense = dense.flat_map(|(sources, targets)| std::iter::repeat_n(sources + 1, targets));
        let graph = graph.into_iter().flat_map(|shape| &shape.neurons).map(GraphNeuron::weight_count);
        dense.chain(graph).chain(shared.into_iter().flat_map(|shape| shape.groups.iter().copied()))
    }

    /// Checks the shape.
    ///
    /// # Errors
    /// Names the field and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        match self {
            Self::Dense(shape) => shape.validate(),
            Self::Graph(shape) => shape.validate(),
            Self::Shared(shape) => shape.validate(),
            Self::Copied(shape) => shape.validate(),
        }
    }

    /// Checks that these are weights for a net of this topology, which is not checked itself.
    ///
    /// # Errors
    /// If their number is not the topology's or one is NaN or infinite.
    pub fn check_weights(&self, weights: &[f32]) -> Result<(), NetworkError> {
        let net = match self {
            Self::Dense(shape) => format!("shape {shape}"),
            other => other.to_string(),
        };
        check_weights(net, self.weight_count(), weights)
    }

    /// The net with these weights, for a topology that was validated before: what a genome uses that is expressed often.
    ///
    /// # Panics
    /// If the number of weights is not the topology's.
    pub fn network(&self, weights: &[f32]) -> Network {
        match self {
            Self::Dense(shape) => DenseNet::from_checked(Arc::clone(shape), weights).into(),
            Self::Graph(shape) => GraphNet::from_checked(Arc::clone(shape), weights).into(),
            Self::Shared(shape) => GraphNet::from_checked(Arc::clone(&shape.net), &shape.weights(weights)).into(),
            Self::Copied(shape) => {
                shape.copies.whole(&GraphNet::from_checked(Arc::clone(&shape.small), weights)).into()
            }
        }
    }
}

impl Network {
    /// The net without its weights.
    pub fn topology(&self) -> Topology {
        match self {
            Self::Dense(net) => Topology::Dense(net.shape().clone()),
            Self::Graph(net) => Topology::Graph(net.shape().clone()),
        }
    }
}

impl From<DenseShape> for Topology {
    fn from(shape: DenseShape) -> Self {
        Self::Dense(shape.into())
    }
}

impl From<SharedShape> for Topology {
    fn from(shape: SharedShape) -> Self {
        Self::Shared(shape.into())
    }
}

impl From<CopiedShape> for Topology {
    fn from(shape: CopiedShape) -> Self {
        Self::Copied(shape.into())
    }
}

impl From<GraphShape> for Topology {
    fn from(shape: GraphShape) -> Self {
        Self::Graph(shape.into())
    }
}

impl fmt::Display for Topology {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dense(shape) => shape.fmt(f),
            Self::Graph(shape) => shape.fmt(f),
            Self::Shared(shape) => shape.fmt(f),
            Self::Copied(shape) => shape.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Activation;
    use ne_core::Phenotype;

    fn dense() -> Topology {
        DenseShape::new(3, vec![2], 1).into()
    }

    fn graph() -> Topology {
        let neuron =
            |bias, sources: &[usize]| GraphNeuron { activation: Activation::Tanh, bias, sources: sources.to_vec() };
        let neurons = vec![neuron(true, &[0, 1]), neuron(false, &[]), neuron(false, &[3, 0, 2]), neuron(true, &[])];
        GraphShape { inputs: 2, recurrent: false, neurons, outputs: vec![4, 5] }.into()
    }

    #[test]
    fn weights_of_neurons_stand_in_the_order_of_the_weights() {
        assert_eq!(dense().weights_of_neurons().collect::<Vec<_>>(), [4, 4, 3]);
        assert_eq!(graph().weights_of_neurons().collect::<Vec<_>>(), [3, 0, 3, 1]);
        for topology in [dense(), graph()] {
            assert_eq!(topology.weights_of_neurons().sum::<usize>(), topology.weight_count());
        }
    }

    #[test]
    fn a_network_has_its_topology() {
        for (topology, inputs, outputs, text) in
            [(dense(), 3, 1, "3-2-1"), (graph(), 2, 2, "2 inputs, 2 hidden, 2 outputs, 5 connections")]
        {
            let weights: Vec<f32> = (0..topology.weight_count()).map(|index| index as f32 * 0.1).collect();
            let network = topology.network(&weights);
            assert_eq!((network.topology(), network.weights()), (topology.clone(), weights.as_slice()));
            assert_eq!((network.inputs(), network.outputs()), (inputs, outputs));
            assert_eq!((topology.inputs(), topology.outputs(), topology.to_string().as_str()), (inputs, outputs, text));
            assert_eq!((topology.validate(), topology.check_weights(&weights)), (Ok(()), Ok(())));
            let json = serde_json::to_string(&topology).expect("serialises");
            assert_eq!(serde_json::from_str::<Topology>(&json).expect("deserialises"), topology, "{json}");
        }
    }

    #[test]
    fn errors_name_the_field() {
        for (topology, weights, message) in [
            (dense(), vec![0.0; 10], "weights: found 10, a net of shape 3-2-1 has 11"),
            (graph(), vec![0.0; 8], "weights: found 8, a net of 2 inputs, 2 hidden, 2 outputs, 5 connections has 7"),
            (dense(), vec![f32::NAN; 11], "weights[0] = NaN: must be finite"),
            (graph(), vec![f32::NEG_INFINITY; 7], "weights[0] = -inf: must be finite"),
        ] {
            assert_eq!(topology.check_weights(&weights).expect_err("not its weights").to_string(), message);
        }
        let dense = Topology::from(DenseShape::new(0, vec![], 1));
        assert_eq!(dense.validate().expect_err("no input").to_string(), "inputs = 0: must be from 1 to 4096");
        let graph = Topology::from(GraphShape { inputs: 1, recurrent: false, neurons: vec![], outputs: vec![] });
        let error = graph.validate().expect_err("no neuron").to_string();
        assert_eq!(error, "neurons = 0 neurons: must be from 1 to 65536 neurons");
    }

    #[test]
    fn files_are_checked_and_name_the_kinds() {
        for (text, part) in [
            (r#"{"cloud": {}}"#, "unknown variant `cloud`, expected one of `dense`, `graph`, `shared`"),
            (r#"{"dense": {"inputs": 0, "hidden": [], "outputs": 1}}"#, "inputs = 0: must be from 1 to 4096"),
            (
                r#"{"graph": {"inputs": 1, "recurrent": false, "neurons": [], "outputs": [1]}}"#,
                "neurons = 0 neurons: must be from 1 to 65536 neurons",
            ),
        ] {
            let error = serde_json::from_str::<Topology>(text).expect_err("not a topology").to_string();
            assert!(error.contains(part), "{error}");
        }
    }
}
