//! Species: which individuals belong together, and how many children each species may have.

mod assignment;
mod settings;
mod sharing;
mod species;

pub use settings::{FitnessBaseline, PopulationStagnation, SpeciationSettings, TargetSpecies};

pub(crate) use assignment::assign;
pub(crate) use sharing::{breeders, offspring};
pub(crate) use species::Species;
