//! What can be named.

use crate::episodes::registry;
use pyo3::pyfunction;

/// The names of the shipped creatures.
#[pyfunction]
pub(crate) fn creature_names() -> Vec<&'static str> {
    creatures::shipped().iter().map(|creature| creature.name).collect()
}

/// The names of the movements.
#[pyfunction]
pub(crate) fn movement_names() -> Vec<String> {
    let movements = tasks::MovementCatalogue::default();
    movements.entries().iter().filter(|entry| entry.steps.is_some()).map(|entry| entry.name.clone()).collect()
}

/// The names of the terrains.
#[pyfunction]
pub(crate) fn terrain_names() -> Vec<String> {
    registry().terrains.names().into_iter().map(str::to_owned).collect()
}

/// The names of the variations of the world.
#[pyfunction]
pub(crate) fn variation_names() -> Vec<String> {
    registry().variations.names().into_iter().map(str::to_owned).collect()
}

/// The names of the strategies.
#[pyfunction]
pub(crate) fn strategy_names() -> Vec<String> {
    registry().strategies.entries().iter().map(|entry| entry.name().to_owned()).collect()
}
