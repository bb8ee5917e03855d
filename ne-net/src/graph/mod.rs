//! Nets of any graph: what NEAT evolves, and what a frozen topology of it is.

mod net;
mod shape;

pub use net::GraphNet;
pub use shape::{GraphNeuron, GraphShape};
