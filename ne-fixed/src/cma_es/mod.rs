//! The evolution strategy with covariance matrix adaptation.

mod covariance;
mod distribution;
mod history;
mod parameters;
mod restart;
mod settings;
mod state;
mod strategy;
mod triangle;

pub use {covariance::CovarianceModel, restart::Restart, settings::CmaEsSettings, strategy::CmaEs};
