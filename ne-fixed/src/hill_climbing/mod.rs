//! Hill climbing: the simplest search that learns.

mod settings;
mod state;
mod strategy;

pub use {settings::HillClimbingSettings, strategy::HillClimbing};
