//! Neural networks as plain data: built from a shape and weights, activated, saved, loaded.
//!
//! The one decision behind this crate: **a net is the same everywhere.** Its maths uses nothing but IEEE addition,
//! subtraction, multiplication, division and operations on bits, in a fixed order, so that a net gives the same bits on
//! every platform, at every optimisation level, in training as in a game that plays the result. There is no physics and
//! no search in here, so a game embeds this crate alone.
//!
//! | type | what it is |
//! |---|---|
//! | [`Activation`] | the function of a neuron |
//! | [`DenseShape`] | the layers of a dense net, without weights |
//! | [`DenseNet`] | a dense feed-forward net, ready to activate |
//! | [`GraphShape`] | neurons and their connections, without weights |
//! | [`GraphNet`] | a net of any graph, feed-forward or recurrent, ready to activate |
//! | [`Network`] | a net of any kind: what a file stores |
//! | [`SharedShape`] | a graph whose weights are computed from fewer genes, so that copies of a small net share them |
//! | [`Topology`] | a net of any kind without its weights: what a search for weights keeps fixed |
//! | [`NetView`] | a net of any kind as neurons and connections |
//!
//! ```
//! use ne_core::Phenotype;
//! use ne_net::{DenseNet, DenseShape};
//!
//! let shape = DenseShape::new(2, vec![3], 1);
//! let mut net = DenseNet::new(shape, &[0.5; 13])?;
//! let mut outputs = [0.0];
//! net.activate(&[0.1, -0.2], &mut outputs);
//! assert!(outputs[0].abs() <= 1.0);
//! # Ok::<(), ne_net::NetworkError>(())
//! ```
//!
//! A graph net lists its neurons in the order they are computed. Nodes are numbered, inputs first. This one swings: its
//! only neuron, node 1, hears the input and what it put out itself in the step before.
//!
//! ```
//! use ne_core::Phenotype;
//! use ne_net::{Activation, GraphNet, GraphNeuron, GraphShape, Network};
//!
//! let neuron = GraphNeuron { activation: Activation::Tanh, bias: false, sources: vec![0, 1] };
//! let shape = GraphShape { inputs: 1, recurrent: true, neurons: vec![neuron], outputs: vec![1] };
//! let mut net = Network::from(GraphNet::new(shape, &[1.0, -2.0])?);
//! let mut outputs = [0.0];
//! net.activate(&[1.0], &mut outputs);
//! assert!(outputs[0] > 0.7);
//! net.activate(&[0.0], &mut outputs);
//! assert!(outputs[0] < -0.7);
//! # Ok::<(), ne_net::NetworkError>(())
//! ```

mod activation;
mod copies;
mod dense;
mod error;
mod graph;
mod mathematics;
mod network;
mod shared;
mod topology;
mod topology_map;
mod view;

pub use activation::Activation;
pub use copies::{CopiedShape, Copies, CopySense, NetCopy};
pub use dense::{DenseNet, DenseShape};
pub use error::NetworkError;
pub use graph::{GraphNet, GraphNeuron, GraphShape};
pub use network::Network;
pub use shared::{SharedShape, SharedWeight, Turn};
pub use topology::Topology;
pub use topology_map::TopologyMap;
pub use view::{NetView, NeuronView};
