//! Dense feed-forward nets.

mod net;
mod shape;

pub use {net::DenseNet, shape::DenseShape};
