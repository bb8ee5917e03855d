//! Cooperative synapse neuroevolution.

mod cauchy;
mod permutation;
mod settings;
mod state;
mod strategy;

pub use {permutation::Permutation, settings::CosyneSettings, strategy::Cosyne};
