//! The evolution strategy with covariance matrix adaptation.

mod strategy;
mod covariance;
mod distribution;
mod history;
mod parameters;
mod restart;
mod settings;
mod state;
mod triangle;

pub use {strategy::CmaEs, covariance::CovarianceModel, restart::Restart, settings::CmaEsSettings};
