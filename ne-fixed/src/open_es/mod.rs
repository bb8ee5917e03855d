//! The evolution strategy of OpenAI.

mod adam;
mod settings;
mod state;
mod strategy;

pub use {adam::Adam, settings::OpenEsSettings, strategy::OpenEs};
