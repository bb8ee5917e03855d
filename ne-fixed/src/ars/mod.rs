//! Augmented random search.

mod settings;
mod state;
mod strategy;

pub use {settings::ArsSettings, strategy::Ars};
