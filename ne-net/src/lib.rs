//! Neural networks as plain data: built from a shape and weights, activated, saved, loaded.
//!
//! The one decision behind this crate: **a net is the same everywhere.** Its maths uses nothing but IEEE addition,
//! subtraction, multiplication, division and operations on bits, in a fixed order, so that a net gives the same bits on
//! every platform, at every optimisation level, in training as in a game that plays the result. There is no physics and
//! no search in here, so a game embeds this crate alone.
//!
//! | type | what it is |
//! |---|---|
//! | [`Activation`] | the function of a neuron; all there is without the feature `nets`, and then without `std` |
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
//! # #[cfg(feature = "nets")] {
//! use ne_core::Phenotype;
//! use ne_net::{DenseNet, DenseShape};
//!
//! let shape = DenseShape::new(2, vec![3], 1);
//! let mut net = DenseNet::new(shape, &[0.5; 13])?;
//! let mut outputs = [0.0];
//! net.activate(&[0.1, -0.2], &mut outputs);
//! assert!(outputs[0].abs() <= 1.0);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A graph net lists its neurons in the order they are computed. Nodes are numbered, inputs first. This one swings: its
//! only neuron, node 1, hears the input and what it put out itself in the step before.
//!
//! ```
//! # #[cfg(feature = "nets")] {
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
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(feature = "nets"), no_std)]

mod activation;
#[cfg(feature = "nets")]
mod copies;
#[cfg(feature = "nets")]
mod dense;
#[cfg(feature = "nets")]
mod error;
#[cfg(feature = "nets")]
mod graph;
#[cfg(feature = "nets")]
mod held;
mod mathematics;
#[cfg(feature = "nets")]
mod network;
#[cfg(feature = "nets")]
mod shared;
#[cfg(feature = "nets")]
mod topology;
#[cfg(feature = "nets")]
mod topology_map;
#[cfg(feature = "nets")]
mod view;

pub use activation::Activation;
#[cfg(feature = "nets")]
pub use copies::{CopiedShape, Copies, CopySense, NetCopy};
#[cfg(feature = "nets")]
pub use dense::{DenseNet, DenseShape};
#[cfg(feature = "nets")]
pub use error::NetworkError;
#[cfg(feature = "nets")]
pub use graph::{GraphNet, GraphNeuron, GraphShape};
#[cfg(feature = "nets")]
pub use network::Network;
#[cfg(feature = "nets")]
pub use shared::{SharedShape, SharedWeight, Turn};
#[cfg(feature = "nets")]
pub use topology::Topology;
#[cfg(feature = "nets")]
pub use topology_map::TopologyMap;
#[cfg(feature = "nets")]
pub use view::{NetView, NeuronView};
