use envs_core::{Conditions, Push, Variation};
use ne_core::{Purpose, Seed};
use proptest::prelude::*;
use rand::RngExt;

fn variations() -> impl Strategy<Value = Variation> {
    let share = || 0.0..=0.9_f32;
    let time_step = (0.1..=1.0_f32, 1.0..=2.0_f32);
    let factors = || (0.1..=100.0_f32, 0.1..=100.0_f32).prop_map(|(one, other)| [one.min(other), one.max(other)]);
    let iterations = (1..=32_u32, 1..=32_u32).prop_map(|(one, other)| [one.min(other), one.max(other)]);
    let old = (share(), share(), share(), time_step, 0.0..=1.0_f32);
    let physics = (factors(), prop::option::of(iterations), factors(), factors(), factors());
    (old, share(), physics, 0.0..=5.0_f32, 0.0..=5.0_f32).prop_map(|(old, gravity, physics, torso_spin, pushes)| {
        let (friction, mass, torque, time_step, start_pose) = old;
        let (motor_gain, solver_iterations, joint_frequency, contact_frequency, contact_damping) = physics;
        Variation {
            near_first: false,
            friction,
            mass,
            torque,
            time_step: time_step.into(),
            start_pose,
            bumps: 0.0,
            terrain: false,
            gravity,
            motor_gain,
            solver_iterations,
            joint_frequency,
            contact_frequency,
            contact_damping,
            torso_spin,
            pushes,
        }
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
        let Conditions { friction, mass, torque, time_step, turns, gravity, .. } = &drawn;
        let factors = [
            (friction, variation.friction),
            (mass, variation.mass),
            (torque, variation.torque),
            (gravity, variation.gravity),
        ];
        for (factor, share) in factors {
            prop_assert!((factor - 1.0).abs() <= share + f32::EPSILON, "{factor} of ± {share}");
        }
        let [least, greatest] = variation.time_step;
        prop_assert!((least * 0.999..=greatest * 1.001).contains(time_step), "{time_step} of {least} to {greatest}");
        let factors = [
            (drawn.motor_gain, variation.motor_gain),
            (drawn.joint_frequency, variation.joint_frequency),
            (drawn.contact_frequency, variation.contact_frequency),
            (drawn.contact_damping, variation.contact_damping),
        ];
        for (factor, [least, greatest]) in factors {
            prop_assert!((least * 0.999..=greatest * 1.001).contains(&factor), "{factor} of {least} to {greatest}");
        }
        let iterations = drawn.solver_iterations.zip(variation.solver_iterations);
        prop_assert!(iterations.is_none_or(|(drawn, [fewest, most])| (fewest..=most).contains(&drawn)));
        prop_assert_eq!(drawn.solver_iterations.is_some(), variation.solver_iterations.is_some());
        prop_assert!(drawn.torso_spin.abs() <= variation.torso_spin);
        prop_assert_eq!(drawn.validate(motors), Ok(()));
        prop_assert_eq!(turns.len(), motors);
        prop_assert!(turns.iter().all(|turn| turn.abs() <= variation.start_pose), "{:?}", turns);
        prop_assert_eq!(&drawn, &variation.draw(seed, motors));
    }

    #[test]
    fn no_variation_is_the_world_of_the_settings(seed: u64) {
        prop_assert!(Variation::default().is_none());
        prop_assert_eq!(Variation::default().draw(Seed::of_run(seed), 3), Conditions::reference(3));
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
        ..Conditions::reference(2)
    };
    let variation = Variation {
        friction: 0.3,
        mass: 0.1,
        torque: 0.2,
        time_step: [0.5, 1.5],
        start_pose: 0.4,
        ..Variation::default()
    };
    assert_eq!(variation.draw(seed, 2), expected);
    // What is drawn besides changes none of it.
    let besides = Variation { pushes: 1.0, torso_spin: 1.0, ..Variation::physics() };
    let drawn = Variation { friction: 0.3, mass: 0.1, torque: 0.2, start_pose: 0.4, time_step: [0.5, 1.5], ..besides };
    let Conditions { friction, mass, torque, time_step, turns, .. } = drawn.draw(seed, 2);
    assert_eq!(Conditions { friction, mass, torque, time_step, turns, ..Conditions::reference(2) }, expected);
}

#[test]
fn physics_and_pushes_are_drawn_in_this_order_from_streams_of_their_own() {
    let seed = Seed::of_run(7).trial(2);
    let mut stream = seed.stream(Purpose::new("trial physics"));
    let mut draw = || stream.random::<f32>();
    let between =
        |[low, high]: [f32; 2], place: f32| libm::expf(libm::logf(low) + (libm::logf(high) - libm::logf(low)) * place);
    let mut expected = Conditions {
        gravity: 1.0 + 0.05 * (2.0 * draw() - 1.0),
        motor_gain: between([0.5, 50.0], draw()),
        joint_frequency: between([0.5, 16.7], draw()),
        contact_frequency: between([0.5, 4.0], draw()),
        contact_damping: between([0.5, 2.0], draw()),
        torso_spin: 0.1 * (2.0 * draw() - 1.0),
        solver_iterations: Some(1 + (8.0 * draw()) as u32),
        ..Conditions::reference(2)
    };
    let mut stream = seed.stream(Purpose::new("trial pushes"));
    let mut draw = || stream.random::<f32>();
    let mut time = 2.0 + 2.0 * draw();
    while time <= 120.0 {
        let size = 0.3 * (0.5 + 0.5 * draw());
        expected.pushes.push(Push { time, velocity: if draw() < 0.5 { -size } else { size } });
        time = time + 2.0 + 2.0 * draw();
    }
    let variation = Variation { time_step: [1.0, 1.0], torso_spin: 0.1, pushes: 0.3, ..Variation::physics() };
    assert_eq!(variation.draw(seed, 2), expected);
}

#[test]
fn pushes_go_either_way_from_half_to_full_size_every_two_to_four_seconds() {
    let mut forwards: i32 = 0;
    for seed in 0..50 {
        let pushes = Variation::pushed().draw(Seed::of_run(seed), 1).pushes;
        assert!((29..=60).contains(&pushes.len()), "{} in 120 s", pushes.len());
        let mut last = 0.0;
        for Push { time, velocity } in pushes {
            assert!((1.999..=4.001).contains(&(time - last)) && time <= 120.0, "{last} s, then {time} s");
            assert!((0.15..=0.3).contains(&velocity.abs()), "{velocity} m/s");
            forwards += if velocity > 0.0 { 1 } else { -1 };
            last = time;
        }
    }
    assert!(forwards.abs() < 200, "of 2000, {forwards} more forwards than backwards");
    let shoves = Variation::shoved().draw(Seed::of_run(1), 1).pushes;
    let mean = shoves.iter().map(|push| push.velocity.abs()).sum::<f32>() / shoves.len() as f32;
    assert!((0.35..0.45).contains(&mean), "{mean} m/s in the mean");
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
        (Variation { gravity: 1.0, ..none }, "gravity = 1: must be from 0 to 0.9"),
        (Variation { torso_spin: -1.0, ..none }, "torso_spin = -1: must be from 0 to 5"),
        (Variation { pushes: f32::INFINITY, ..none }, "pushes = inf: must be from 0 to 5"),
        (
            Variation { motor_gain: [0.05, 1.0], ..none },
            "motor_gain = [0.05, 1]: must be two factors from 0.1 to 100, the least first",
        ),
        (
            Variation { joint_frequency: [1.0, 200.0], ..none },
            "joint_frequency = [1, 200]: must be two factors from 0.1 to 100, the least first",
        ),
        (
            Variation { contact_frequency: [2.0, 1.0], ..none },
            "contact_frequency = [2, 1]: must be two factors from 0.1 to 100, the least first",
        ),
        (
            Variation { contact_damping: [1.0, f32::NAN], ..none },
            "contact_damping = [1, NaN]: must be two factors from 0.1 to 100, the least first",
        ),
        (
            Variation { solver_iterations: Some([0, 8]), ..none },
            "solver_iterations = [0, 8]: must be two numbers from 1 to 32, the fewest first",
        ),
        (
            Variation { solver_iterations: Some([4, 33]), ..none },
            "solver_iterations = [4, 33]: must be two numbers from 1 to 32, the fewest first",
        ),
        (
            Variation { solver_iterations: Some([4, 3]), ..none },
            "solver_iterations = [4, 3]: must be two numbers from 1 to 32, the fewest first",
        ),
    ];
    for (variation, refusal) in refusals {
        assert_eq!(variation.validate().expect_err("must be refused").to_string(), refusal);
    }
    let named = [Variation::light(), Variation::strong(), Variation::near(), Variation::physics(), Variation::pushed()];
    for variation in named {
        assert_eq!(variation.validate(), Ok(()));
        assert!(!variation.is_none());
    }
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

/// A variation that is laid over another replaces it, so that each of its fields is written.
#[test]
fn a_file_has_every_field() {
    let fields = |variation: Variation| {
        let value = serde_json::to_value(variation).expect("writes");
        value.as_object().expect("an object").keys().cloned().collect::<Vec<_>>()
    };
    assert_eq!(fields(Variation::default()), fields(Variation { near_first: true, ..Variation::physics() }));
    let write = |variation: Variation| serde_json::to_string(&variation).expect("writes");
    for variation in [Variation::near(), Variation::physics(), Variation::pushed()] {
        assert_eq!(serde_json::from_str::<Variation>(&write(variation)).expect("reads"), variation);
    }
}
