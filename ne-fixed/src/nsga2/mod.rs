//! NSGA-II: compromises between several objectives.

mod settings;
mod state;
mod strategy;

pub use {settings::Nsga2Settings, strategy::Nsga2};
