//! What can be named.

use crate::{
    episodes::{built, registry},
    errors::wrong,
};
use envs_rapier::PhysicsSettings;
use pyo3::{PyResult, pyfunction};

/// The names of the shipped creatures.
#[pyfunction]
pub(crate) fn creature_names() -> Vec<&'static str> {
    creatures::shipped().iter().map(|creature| creature.name).collect()
}

/// A movement, the steps of an episode, and how many seconds a step lasts.
pub(crate) type Length = (String, u32, f32);

/// The longer side of a creature's bounding box in its start pose, m; and of each movement how many steps an episode has with the
/// preset `plain`, and how many seconds a step lasts. `creature`: the name of a shipped one, or the path of a file.
#[pyfunction]
pub(crate) fn episode_facts(creature: &str) -> PyResult<(f32, Vec<Length>)> {
    let creature = gambol_runs::source::creature(creature, &registry()).map_err(wrong)?;
    let facts = |movement: String| {
        let config = registry().config("plain", creature.clone(), &movement).map_err(wrong)?;
        let steps = registry().movements.steps(&config.movement).map_err(wrong)?;
        Ok((movement, steps, config.physics.time_step))
    };
    let movements = movement_names().into_iter().map(facts).collect::<PyResult<_>>()?;
    Ok((creatures::Blueprint::new(creature).map_err(wrong)?.body_length(), movements))
}

/// Seconds a step lasts unless the settings say otherwise.
#[pyfunction]
pub(crate) fn default_time_step() -> f32 {
    PhysicsSettings::default().time_step
}

/// The names of the movements.
#[pyfunction]
pub(crate) fn movement_names() -> Vec<String> {
    // Whether or not there is a registry yet.
    let usual = tasks::MovementCatalogue::default();
    let built = built();
    let movements = built.as_ref().map_or(&usual, |registry| &registry.movements);
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
