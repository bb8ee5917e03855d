//! Where every part is after every step, and what the sensors see.

use crate::stage::{SHIPPED, all_sensors, both, drive, shipped};
use envs_core::{PhysicsSettings, Variation};

#[test]
fn every_shipped_creature_moves_as_in_rapier() {
    for name in SHIPPED {
        let blueprint = shipped(name);
        let (mut rapier, mut lanes) =
            both(&blueprint, &all_sensors(&blueprint), PhysicsSettings::default(), Variation::default());
        for (seed, hold) in [(1, 1), (2, 7), (3, 25)] {
            assert_eq!(drive(&mut rapier, &mut lanes, seed, 600, hold), None, "{name}");
        }
    }
}

#[test]
fn every_shipped_creature_moves_as_in_rapier_in_varied_worlds() {
    for name in SHIPPED {
        let blueprint = shipped(name);
        let (mut rapier, mut lanes) =
            both(&blueprint, &all_sensors(&blueprint), PhysicsSettings::default(), Variation::light());
        for seed in 1..4 {
            assert_eq!(drive(&mut rapier, &mut lanes, seed, 300, 9), None, "{name}");
        }
    }
}
