use envs_core::{Conditions, Variation};
use ne_core::{Purpose, Seed};
use proptest::prelude::*;
use rand::RngExt;

fn variations() -> impl Strategy<Value = Variation> {
    let share = || 0.0..=0.9_f32;
    let time_step = (0.1..=1.0_f32, 1.0..=2.0_f32);
    (share(), share(), share(), time_step, 0.0..=1.0_f32).prop_map(|(friction, mass, torque, time_step, start_pose)| {
        Variation { friction, mass, torque, time_step: time_step.into(), start_pose, bumps: 0.0, terrain: false }
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
        ];
        for (factor, share) in factors {
            prop_assert!((factor - 1.0).abs() <= share + f32::EPSILON, "{factor} of ± {share}");
        }
        let [least, greatest] = variation.time_step;
        prop_assert!((least * 0.999..=greatest * 1.001).contains(time_step), "{time_step} of {least} to {greatest}");
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
        time_step: libm::expf(libm::logf(0.5) + (libm::logf(1.5) - libm::logf(0.5)) * 0.5 * (1.0 + draw(1.0))),
        turns: vec![draw(0.4), draw(0.4)],
    };
    let variation = Variation {
        friction: 0.3,
        mass: 0.1,
        torque: 0.2,
        time_step: [0.5, 1.5],
        start_pose: 0.4,
        bumps: 0.0,
        terrain: false,
    };
    assert_eq!(variation.draw(seed, 2), expected);
}

#[test]
fn shares_out_of_range_name_field_and_range() {
    let none = Variation::default();
    let refusals = [
        (Variation { friction: -0.1, ..none }, "friction = -0.1: must be from 0 to 0.9"),
        (Variation { mass: 1.0, ..none }, "mass = 1: must be from 0 to 0.9"),
        (Variation { torque: f32::NAN, ..none }, "torque = NaN: must be from 0 to 0.9"),
        (
            Variation { time_step: [0.05, 1.0], ..none },
            "time_step = [0.05, 1]: must be a factor from 0.1 to 1 and one from 1 to 2",
        ),
        (
            Variation { time_step: [0.9, f32::NAN], ..none },
            "time_step = [0.9, NaN]: must be a factor from 0.1 to 1 and one from 1 to 2",
        ),
        (Variation { start_pose: 1.5, ..none }, "start_pose = 1.5: must be from 0 to 1"),
        (Variation { bumps: 0.005, ..none }, "bumps = 0.005: must be 0, or from 0.01 to 0.1"),
        (Variation { bumps: f32::NAN, ..none }, "bumps = NaN: must be 0, or from 0.01 to 0.1"),
    ];
    for (variation, refusal) in refusals {
        assert_eq!(variation.validate().expect_err("must be refused").to_string(), refusal);
    }
    assert_eq!(Variation::light().validate(), Ok(()));
    assert_eq!(Variation::strong().validate(), Ok(()));
}

/// Files written before a field was there do not vary it.
#[test]
fn what_a_file_leaves_out_does_not_vary() {
    let read: Variation = serde_json::from_str(r#"{"friction":0.3,"mass":0.1,"torque":0.1}"#).expect("valid");
    assert_eq!(read, Variation { friction: 0.3, mass: 0.1, torque: 0.1, ..Variation::default() });
}

#[test]
fn the_time_step_is_two_factors_or_a_share() {
    let read = |text: &str| serde_json::from_str::<Variation>(text).map(|variation| variation.time_step);
    assert_eq!(read(r#"{"time_step":[0.5,1.25]}"#).expect("valid"), [0.5, 1.25]);
    assert_eq!(read(r#"{"time_step":0.25}"#).expect("valid"), [0.75, 1.25]);
    let refusal = read(r#"{"time_step":"long"}"#).expect_err("must be refused").to_string();
    assert!(refusal.contains("expected the least and the greatest factor, such as [0.8, 1.2]"), "{refusal}");
}
