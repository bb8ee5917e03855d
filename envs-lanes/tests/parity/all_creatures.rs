//! Whatever a creature file can say, in whatever world: the lanes do what rapier does.

use crate::{
    any_creature::{any_actuation, any_creature, any_settings, any_variation},
    stage::{all_sensors, assert_same_evaluations, drive, told, try_both},
};
use creatures::{Actuation, Blueprint, Creature, Joint, Motor, Part, Shape};
use envs_core::{PhysicsSettings, Variation};
use proptest::{prelude::*, test_runner::RngSeed};

/// A world, and what outputs mean there.
#[derive(Clone, Copy, Debug)]
struct World {
    settings: PhysicsSettings,
    variation: Variation,
    actuation: Actuation,
}

fn any_world() -> impl Strategy<Value = World> {
    let drawn = (any_settings(), any_variation(), any_actuation());
    drawn.prop_map(|(settings, variation, actuation)| World { settings, variation, actuation })
}

/// Builds a creature in both engines, drives it, and evaluates a few nets. Errors must be the same.
fn check(creature: Creature, world: World, seed: u64, hold: u32) {
    let blueprint = Blueprint::new(creature).expect("the generator makes valid creatures");
    match try_both(&blueprint, &all_sensors(&blueprint), world.settings, world.variation) {
        (Ok(rapier), Ok(lanes)) => {
            let rapier = rapier.with_actuation(world.actuation).expect("a gain in range");
            let lanes = lanes.with_actuation(world.actuation).expect("a gain in range");
            let (mut rapier, mut lanes) = told(rapier, lanes);
            drive(&mut rapier, &mut lanes, seed, 200, hold);
            assert_same_evaluations(rapier, lanes, seed, 40);
        }
        (rapier, lanes) => {
            let (rapier, lanes) = (rapier.err().map(|error| error.to_string()), lanes.err().map(|e| e.to_string()));
            assert_eq!(rapier, lanes);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        failure_persistence: None,
        // The same creatures each time; `PROPTEST_RNG_SEED` draws others.
        rng_seed: RngSeed::Fixed(std::env::var("PROPTEST_RNG_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(7)),
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_creature_in_any_world_moves_as_in_rapier(
        creature in any_creature(),
        world in any_world(),
        seed in any::<u64>(),
        hold in 1..30_u32,
    ) {
        check(creature, world, seed, hold);
    }
}

/// From 64 joints of a colour on, rapier solves them several at a time, and before the others.
#[test]
fn a_snake_of_150_parts_moves_as_in_rapier() {
    let mut snake = Creature::new("snake");
    for index in 0..150 {
        let x = 0.1 * index as f32;
        snake.parts.push(Part {
            name: format!("part {index}"),
            tag: "leg".to_owned(),
            shape: Shape::Box { width: 0.1, height: 0.05 },
            density: 50.0,
            friction: 1.0,
            position: [x, 0.025],
            angle: 0.0,
            leg: true,
            look: Default::default(),
        });
        if index > 0 {
            snake.joints.push(Joint {
                parent: format!("part {}", index - 1),
                child: format!("part {index}"),
                anchor: [x - 0.05, 0.025],
                limits: [-30.0, 30.0],
                motor: (index % 3 > 0).then_some(Motor { top_speed: 6.0, top_torque: 5.0 }),
            });
        }
    }
    for (seed, actuation) in [(1, Actuation::Speed), (2, Actuation::angle()), (3, Actuation::Speed)] {
        let world = World { settings: PhysicsSettings::default(), variation: Variation::light(), actuation };
        check(snake.clone(), world, seed, 8);
    }
}
