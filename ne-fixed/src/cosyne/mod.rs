//! Cooperative synapse neuroevolution.

mod cauchy;
mod strategy;
mod permutation;
mod settings;
mod state;

pub use {strategy::Cosyne, permutation::Permutation, settings::CosyneSettings};
