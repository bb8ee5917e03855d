use crate::{DenseNet, GraphNet};
use ne_core::Phenotype;
use serde::{Deserialize, Serialize};
use std::{any::Any, borrow::Cow};

/// A net of any kind: what a champion's file stores and a game loads.
///
/// In JSON the kind stands beside the fields of the net: `{"kind": "dense", "shape": …, "weights": […]}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Network {
    /// Layers, each fully connected with the next.
    Dense(DenseNet),
    /// Any graph.
    Graph(GraphNet),
}

impl Network {
    /// The net that a controller is, if it is one.
    pub fn of(phenotype: &dyn Phenotype) -> Option<Cow<'_, Self>> {
        let phenotype: &dyn Any = phenotype;
        if let Some(network) = phenotype.downcast_ref::<Self>() {
            return Some(Cow::Borrowed(network));
        }
        let dense = phenotype.downcast_ref::<DenseNet>().map(|net| Self::Dense(net.clone()));
        dense.or_else(|| phenotype.downcast_ref::<GraphNet>().map(|net| Self::Graph(net.clone()))).map(Cow::Owned)
    }

    /// The weights, in the order the shape documents.
    pub fn weights(&self) -> &[f32] {
        match self {
            Self::Dense(net) => net.weights(),
            Self::Graph(net) => net.weights(),
        }
    }

    /// What each node put out when the net was last activated: inputs, then neurons in the order they are computed, as the
    /// next ones get it. Zeros before.
    pub fn activations(&self) -> Vec<f32> {
        match self {
            Self::Dense(net) => net.activations().flatten().copied().collect(),
            Self::Graph(net) => net.activations().to_vec(),
        }
    }
}

impl From<DenseNet> for Network {
    fn from(net: DenseNet) -> Self {
        Self::Dense(net)
    }
}

impl From<GraphNet> for Network {
    fn from(net: GraphNet) -> Self {
        Self::Graph(net)
    }
}

impl Phenotype for Network {
    fn inputs(&self) -> usize {
        match self {
            Self::Dense(net) => net.inputs(),
            Self::Graph(net) => net.inputs(),
        }
    }

    fn outputs(&self) -> usize {
        match self {
            Self::Dense(net) => net.outputs(),
            Self::Graph(net) => net.outputs(),
        }
    }

    fn reset(&mut self) {
        match self {
            Self::Dense(net) => net.reset(),
            Self::Graph(net) => net.reset(),
        }
    }

    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        match self {
            Self::Dense(net) => net.activate(inputs, outputs),
            Self::Graph(net) => net.activate(inputs, outputs),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Activation, DenseShape, GraphNeuron, GraphShape};

    #[test]
    fn survives_serialisation_and_says_its_kind() {
        let dense = DenseNet::new(DenseShape::new(1, vec![], 1), &[0.25, -0.5]).expect("two weights");
        let neuron = GraphNeuron { activation: Activation::SteepTanh, bias: false, sources: vec![0] };
        let shape = GraphShape { inputs: 1, recurrent: false, neurons: vec![neuron], outputs: vec![1] };
        let graph = GraphNet::new(shape, &[0.25]).expect("one weight");
        for (network, start) in [
            (Network::from(dense), r#"{"kind":"dense","shape":{"inputs":1,"#),
            (Network::from(graph), r#"{"kind":"graph","shape":{"inputs":1,"recurrent":false,"#),
        ] {
            let text = serde_json::to_string(&network).expect("serialises");
            assert!(text.starts_with(start), "{text}");
            assert_eq!(serde_json::from_str::<Network>(&text).expect("deserialises"), network);
        }
    }

    #[test]
    fn another_kind_or_field_is_an_error() {
        for (text, part) in [
            (r#"{"kind": "cloud"}"#, "unknown variant `cloud`, expected `dense` or `graph`"),
            (r#"{"weights": []}"#, "missing field `kind`"),
            (
                r#"{"kind": "dense", "shape": {"inputs": 1, "hidden": [], "outputs": 1}, "weights": [0, 1], "bias": 1}"#,
                "unknown field `bias`",
            ),
            (
                r#"{"kind": "graph", "weights": [1], "shape": {"inputs": 1, "recurrent": false, "outputs": [1],
                    "neurons": [{"activation": "tanh", "bias": false, "sources": [1]}]}}"#,
                "neurons[0].sources[0] = 1: must be below 1, the node of this neuron",
            ),
            (
                r#"{"kind": "graph", "weights": [1], "shape": {"inputs": 1, "recurrent": false, "outputs": [1],
                    "neurons": [{"activation": "swish", "bias": false, "sources": [0]}]}}"#,
                "unknown variant `swish`, expected one of `logistic`, `tanh`, ",
            ),
            (
                r#"{"kind": "graph", "weights": [], "shape": {"inputs": 1, "recurrent": false, "outputs": [1],
                    "neurons": [{"activation": "tanh", "bias": false, "sources": [0]}]}}"#,
                "weights: found 0, a net of 1 inputs, 0 hidden, 1 outputs, 1 connections has 1",
            ),
        ] {
            let error = serde_json::from_str::<Network>(text).expect_err("not a network").to_string();
            assert!(error.contains(part), "{error}");
        }
    }
}
