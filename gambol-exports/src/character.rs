use crate::ExportError;
use envs_rapier::{PhysicsSettings, RapierEnvironment};
use gambol_runs::{Registry, champion::Champion, judge::Judge};
use ne_core::Seed;
use player::{Character, CharacterParts, Medium};

/// The character of a champion. The body comes to rest in rapier, so that its net hears of heights what it heard in training.
///
/// # Errors
/// If its episode cannot be built, or a player cannot play it: a sensor is of another crate, the net is too large.
pub fn character_of(champion: &Champion, registry: &Registry) -> Result<Character, ExportError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    of(champion, judge.environment())
}

/// `world`: that in which the champion is judged.
pub(crate) fn of(champion: &Champion, world: &RapierEnvironment) -> Result<Character, ExportError> {
    let PhysicsSettings { time_step, gravity, ground_friction, motor_gain, water, .. } = *world.settings();
    let settled = world.settled(Seed::of_run(0)).map_err(|failure| ExportError::Failed { failure })?;
    let blueprint = world.blueprint();
    let medium = water.map_or(Medium::Air, |water| Medium::Water {
        density: water.density_around(blueprint, 1.0),
        drag: water.drag,
        slip: water.slip,
    });
    Ok(Character::new(CharacterParts {
        blueprint,
        senses: world.senses(),
        motors: world.motors(),
        network: &champion.network,
        movement: &champion.movement.name,
        time_step,
        gravity,
        ground_friction,
        motor_gain,
        medium,
        rest_height: settled.rest.height(),
    })?)
}
