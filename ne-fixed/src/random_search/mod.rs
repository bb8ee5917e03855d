//! Random search: the baseline that any search must beat.

mod settings;
mod state;
mod strategy;

pub use {settings::RandomSearchSettings, strategy::RandomSearch};
