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
//! | [`Network`] | a net of any kind: what a file stores |
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
//! # Ok::<(), ne_net::DenseNetError>(())
//! ```
//!
//! Nets of any graph, which NEAT evolves, will be a module `graph` beside `dense` and a variant of [`Network`].

mod activation;
mod dense;
mod mathematics;
mod network;

pub use activation::Activation;
pub use dense::{DenseNet, DenseNetError, DenseShape};
pub use network::Network;
