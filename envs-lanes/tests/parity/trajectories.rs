//! Where every part is after every step, and what the sensors see.

use crate::stage::{SHIPPED, both, drive, shipped};
use creatures::Sensor;
use envs_core::{PhysicsSettings, Variation};

fn all_sensors() -> Vec<Sensor> {
    vec![
        Sensor::TorsoRotation,
        Sensor::JointAngles,
        Sensor::JointSpeeds,
        Sensor::TorsoVelocity,
        Sensor::TorsoHeight,
        Sensor::FootContacts,
        Sensor::Rangefinder { angles: vec![-80.0, -45.0, -10.0, 30.0], length: 2.0 },
        Sensor::Clock { period: 0.7 },
    ]
}

#[test]
fn every_shipped_creature_moves_as_in_rapier() {
    for name in SHIPPED {
        let (mut rapier, mut lanes) =
            both(&shipped(name), &all_sensors(), PhysicsSettings::default(), Variation::default());
        for (seed, hold) in [(1, 1), (2, 7), (3, 25)] {
            drive(&mut rapier, &mut lanes, seed, 600, hold);
        }
    }
}

#[test]
fn every_shipped_creature_moves_as_in_rapier_in_varied_worlds() {
    for name in SHIPPED {
        let (mut rapier, mut lanes) =
            both(&shipped(name), &all_sensors(), PhysicsSettings::default(), Variation::light());
        for seed in 1..4 {
            drive(&mut rapier, &mut lanes, seed, 300, 9);
        }
    }
}
