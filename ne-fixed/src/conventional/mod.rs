//! Conventional neuroevolution: a genetic algorithm over weights.

mod conventional_ne;
mod settings;
mod stagnation_boost;
mod state;

pub use {conventional_ne::ConventionalNe, settings::ConventionalNeSettings, stagnation_boost::StagnationBoost};
