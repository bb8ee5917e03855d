//! Worlds that are almost the one a gait is judged in. A gait that is not usable in them is a lucky trajectory.

use envs_core::{Conditions, Variation};
use ne_core::{Purpose, Seed};
use rand::RngExt;
use tasks::gait::NEAR_WORLDS;

const NEAR: Purpose = Purpose::new("near worlds");

/// The near worlds of a creature with so many actuated joints: the same for all its champions and all runs.
pub(crate) fn near_worlds(motors: usize) -> Vec<Conditions> {
    let lot = Seed::of_run(Seed::of_run(0).stream(NEAR).random());
    (0..NEAR_WORLDS as u32).map(|index| Variation::near().draw(lot.trial(index), motors)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_worlds_are_near_and_none_is_another() {
        let worlds = near_worlds(3);
        assert_eq!(worlds.len(), NEAR_WORLDS);
        assert_eq!(worlds, near_worlds(3));
        for (index, world) in worlds.iter().enumerate() {
            for factor in [world.friction, world.mass, world.time_step, world.gravity] {
                assert!(factor != 1.0 && (factor - 1.0).abs() <= 0.01 + 1e-6, "{world:?}");
            }
            assert_eq!((world.torque, world.solver_iterations), (1.0, None));
            assert!(world.pushes.is_empty() && world.torso_spin != 0.0 && world.torso_spin.abs() <= 0.05);
            assert!(world.turns.iter().all(|turn| *turn != 0.0 && turn.abs() <= 0.0175), "{world:?}");
            assert!(!worlds[..index].contains(world));
            assert_eq!(world.validate(3), Ok(()));
        }
    }
}
