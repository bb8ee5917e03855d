//! Whatever a creature file can say, in whatever world: the lanes do what rapier does.

use crate::{
    any_creature::{any_creature, any_settings, any_variation},
    stage::{all_sensors, drive, try_both},
};
use creatures::{Blueprint, Creature};
use envs_core::{PhysicsSettings, Variation};
use proptest::prelude::*;

/// Builds a creature in both engines and drives it. Errors must be the same.
fn check(creature: Creature, settings: PhysicsSettings, variation: Variation, seed: u64, hold: u32) {
    let blueprint = Blueprint::new(creature).expect("the generator makes valid creatures");
    match try_both(&blueprint, &all_sensors(&blueprint), settings, variation) {
        (Ok(mut rapier), Ok(mut lanes)) => {
            drive(&mut rapier, &mut lanes, seed, 200, hold);
        }
        (rapier, lanes) => {
            let (rapier, lanes) = (rapier.err().map(|error| error.to_string()), lanes.err().map(|e| e.to_string()));
            assert_eq!(rapier, lanes);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_creature_in_any_world_moves_as_in_rapier(
        creature in any_creature(),
        settings in any_settings(),
        variation in any_variation(),
        seed in any::<u64>(),
        hold in 1..30_u32,
    ) {
        check(creature, settings, variation, seed, hold);
    }
}
