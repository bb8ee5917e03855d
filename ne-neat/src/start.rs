//! The first generation.

use crate::{
    BiasKind, ConnectionGene, InnovationNumber, Layout, NeatGenome, NodeGene, NodeId,
    innovation::{Innovations, direct_connection},
    noise::{NewWeights, happens},
};
use ne_core::{RandomStream, SettingError};
use ne_net::{Activation, GraphShape};
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// What the nets of the first generation look like. The bias node, if there is one, is connected as inputs are.
///
/// In JSON: `"fully-connected"` or `{"partly-connected": {"share": 0.5}}`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum StartTopology {
    /// Every input is connected with every output, and there are no hidden neurons, as in the paper.
    FullyConnected,
    /// As [fully connected](Self::FullyConnected), with so many of the connections, each individual with others.
    PartlyConnected {
        /// The probability of each connection, from 0 to 1.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
        share: f64,
    },
    /// No connections.
    Unconnected,
    /// Every input is connected with every neuron of one hidden layer, and these with every output.
    HiddenLayer {
        /// Number of hidden neurons, from 1 to 4096.
        #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 4096)))]
        neurons: usize,
    },
}

impl StartTopology {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        match *self {
            Self::FullyConnected | Self::Unconnected => Ok(()),
            Self::PartlyConnected { share } => SettingError::check_range("partly-connected.share", share, 0.0, 1.0),
            Self::HiddenLayer { neurons } if (1..=GraphShape::MAX_WIDTH).contains(&neurons) => Ok(()),
            Self::HiddenLayer { neurons } => {
                let allowed = format!("from 1 to {}", GraphShape::MAX_WIDTH);
                Err(SettingError::new("hidden-layer.neurons", neurons, allowed))
            }
        }
    }

    /// The registry of a run that starts so: all numbers that the first generation can use are given.
    pub(crate) fn innovations(&self, layout: &Layout) -> Innovations {
        let hidden = self.hidden();
        let connections = self.numbered_connections(layout);
        Innovations::new(layout.first_hidden() + hidden as NodeId, connections as InnovationNumber)
    }

    /// How many connections have numbers before the first is invented.
    pub(crate) fn numbered_connections(&self, layout: &Layout) -> usize {
        layout.sources() * layout.outputs + (layout.sources() + layout.outputs) * self.hidden()
    }

    /// The hidden neurons that every net of the first generation has.
    pub(crate) fn hidden(&self) -> usize {
        match *self {
            Self::HiddenLayer { neurons } => neurons,
            _ => 0,
        }
    }

    /// Draws an individual of the first generation.
    pub(crate) fn draw(
        &self,
        genome: &mut NeatGenome,
        weights: NewWeights,
        (output, hidden): (Activation, &[Activation]),
        stream: &mut RandomStream,
    ) {
        let layout = *genome.layout();
        let (sources, first_hidden) = (layout.sources() as NodeId, layout.first_hidden());
        let neurons = first_hidden..first_hidden + self.hidden() as NodeId;
        let (nodes, connections) = genome.genes_mut();
        nodes.clear();
        connections.clear();
        for id in sources..neurons.end {
            let activation = if id < first_hidden { output } else { hidden[stream.random_range(0..hidden.len())] };
            let bias = if layout.bias == BiasKind::PerNeuron { weights.draw(stream) } else { 0.0 };
            nodes.push(NodeGene { id, activation, bias });
        }
        let mut connect = |innovation, from, to, stream: &mut RandomStream| {
            connections.push(ConnectionGene { innovation, from, to, weight: weights.draw(stream), enabled: true });
        };
        let share = match *self {
            Self::FullyConnected => 1.0,
            Self::PartlyConnected { share } => share,
            Self::Unconnected | Self::HiddenLayer { .. } => 0.0,
        };
        for (from, to) in pairs(0..sources, sources..first_hidden) {
            if happens(share, stream) {
                let direct = direct_connection(from, to, &layout).expect("from an input to an output");
                connect(direct, from, to, stream);
            }
        }
        let first_innovation = sources * layout.outputs as NodeId;
        let layers = pairs(0..sources, neurons.clone()).chain(pairs(neurons, sources..first_hidden));
        for ((from, to), innovation) in layers.zip(first_innovation..) {
            connect(innovation, from, to, stream);
        }
    }
}

fn pairs(from: Range<NodeId>, to: Range<NodeId>) -> impl Iterator<Item = (NodeId, NodeId)> {
    from.flat_map(move |from| to.clone().map(move |to| (from, to)))
}
