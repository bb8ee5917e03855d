//! What all engines share, tried on a toy engine whose motion can be worked out by hand.

mod conformance;
mod environment;
mod ground;
mod puppet;
mod settings;
mod terrain;
mod variation;
mod water;
