use envs_core::{Conditions, Variation};
use ne_core::{Purpose, Seed};
use proptest::prelude::*;
use rand::RngExt;

fn variations() -> impl Strategy<Value = Variation> {
    let share = || 0.0..=0.9_f32;
    (share(), share(), share(), share(), 0.0..=1.0_f32).prop_map(|(friction, mass, torque, time_step, start_pose)| {
        Variation { friction, mass, torque, time_step, start_pose }
    })
}

proptest! {
    #[test]
    fn what_is_drawn_is_in_range_and_a_function_of_the_seed(
        variation in variations(), seed: u64, trial in 0_u32..1000, motors in 0_usize..20,
    ) {
        variation.validate().expect("in range");
        let seed = Seed::of_run(seed).trial(trial);
        let drawn = variation.draw(seed, motors);
        let Conditions { friction, mass, torque, time_step, turns } = &drawn;
        let factors = [
            (friction, variation.friction),
            (mass, variation.mass),
            (torque, variation.torque),
            (time_step, variation.time_step),
        ];
        for (factor, share) in factors {
            prop_assert!((factor - 1.0).abs() <= share + f32::EPSILON, "{factor} of ± {share}");
        }
        prop_assert_eq!(turns.len(), motors);
        prop_assert!(turns.iter().all(|turn| turn.abs() <= variation.start_pose), "{:?}", turns);
        prop_assert_eq!(&drawn, &variation.draw(seed, motors));
    }

    #[test]
    fn no_variation_is_the_world_of_the_settings(seed: u64) {
        prop_assert!(Variation::default().is_none());
        prop_assert_eq!(Variation::default().draw(Seed::of_run(seed), 3), Conditions::nominal(3));
    }
}

#[test]
fn other_seeds_and_trials_draw_other_worlds() {
    let draw = |seed| Variation::light().draw(seed, 4);
    let first = draw(Seed::of_run(1));
    assert_ne!(first, draw(Seed::of_run(2)));
    assert_ne!(first, draw(Seed::of_run(1).trial(1)));
    assert_ne!(first.turns[0], first.turns[1], "each joint has a turn of its own");
}

/// Recorded runs and champions rest on the order: another one gives other worlds for the same seed.
#[test]
fn friction_mass_torque_time_step_and_turns_are_drawn_in_this_order() {
    let seed = Seed::of_run(7).trial(2);
    let mut stream = seed.stream(Purpose::new("trial variation"));
    let mut draw = |share: f32| share * (2.0 * stream.random::<f32>() - 1.0);
    let expected = Conditions {
        friction: 1.0 + draw(0.3),
        mass: 1.0 + draw(0.1),
        torque: 1.0 + draw(0.2),
        time_step: 1.0 + draw(0.05),
        turns: vec![draw(0.4), draw(0.4)],
    };
    let variation = Variation { friction: 0.3, mass: 0.1, torque: 0.2, time_step: 0.05, start_pose: 0.4 };
    assert_eq!(variation.draw(seed, 2), expected);
}

#[test]
fn shares_out_of_range_name_field_and_range() {
    let none = Variation::default();
    let refusals = [
        (Variation { friction: -0.1, ..none }, "friction = -0.1: must be from 0 to 0.9"),
        (Variation { mass: 1.0, ..none }, "mass = 1: must be from 0 to 0.9"),
        (Variation { torque: f32::NAN, ..none }, "torque = NaN: must be from 0 to 0.9"),
        (Variation { time_step: 0.95, ..none }, "time_step = 0.95: must be from 0 to 0.9"),
        (Variation { start_pose: 1.5, ..none }, "start_pose = 1.5: must be from 0 to 1"),
    ];
    for (variation, refusal) in refusals {
        assert_eq!(variation.validate().expect_err("must be refused").to_string(), refusal);
    }
    assert_eq!(Variation::light().validate(), Ok(()));
}

/// Files written before a field was there do not vary it.
#[test]
fn what_a_file_leaves_out_does_not_vary() {
    let read: Variation = serde_json::from_str(r#"{"friction":0.3,"mass":0.1,"torque":0.1}"#).expect("valid");
    assert_eq!(read, Variation { friction: 0.3, mass: 0.1, torque: 0.1, ..Variation::default() });
}
