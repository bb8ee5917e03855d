//! The evolution strategy of OpenAI.

mod adam;
mod strategy;
mod settings;
mod state;

pub use {adam::Adam, strategy::OpenEs, settings::OpenEsSettings};
