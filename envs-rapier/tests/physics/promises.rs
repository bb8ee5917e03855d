//! What every creature in this physics is promised.

use crate::gauge::{self, restless};
use envs_rapier::{EnvironmentError, PhysicsSettings, RAPIER_VERSION, RapierEnvironment, Variation};
use ne_core::{Failure, Seed};
use tasks::{Environment, Snapshot, conformance};

#[test]
fn every_shipped_creature_passes_the_conformance_kit() {
    for shipped in creatures::shipped() {
        let environment = gauge::shipped(shipped.name, PhysicsSettings::default());
        conformance::check_environment(&environment, Seed::of_run(3))
            .unwrap_or_else(|broken| panic!("{}: {broken}", shipped.name));
    }
}

#[test]
fn every_shipped_creature_starts_settled_in_its_start_pose() {
    for shipped in creatures::shipped() {
        let environment = gauge::shipped(shipped.name, PhysicsSettings::default());
        let parts = environment.blueprint().parts();
        for (part, state) in parts.iter().zip(&environment.snapshot().parts) {
            assert!((part.y - state.y).abs() < 0.03, "{}: {} sank or jumped to {}", shipped.name, part.name, state.y);
            assert!(state.vx.abs().max(state.vy.abs()) < 0.2, "{}: {} moves", shipped.name, part.name);
        }
        assert!(environment.snapshot().parts.iter().any(|part| part.touching), "{} floats", shipped.name);
        assert_eq!(environment.snapshot().time, 0.0);
    }
}

/// A copy of a settled world goes on as the original would: rapier keeps nothing between steps that a copy lacks.
#[test]
fn a_copy_in_the_middle_of_an_episode_goes_on_the_same() {
    let mut original = gauge::shipped("decapod-2", PhysicsSettings::default());
    let program = restless(5, original.outputs(), 400);
    let run = |environment: &mut RapierEnvironment, program: &[Vec<f32>]| -> Vec<Snapshot> {
        let step = |outputs: &Vec<f32>| {
            environment.act(outputs);
            environment.step().expect("stable");
            environment.snapshot().clone()
        };
        program.iter().map(step).collect()
    };
    original.reset(Seed::of_run(1)).expect("settles");
    run(&mut original, &program[..200]);
    let mut copy = original.clone();
    assert_eq!(run(&mut original, &program[200..]), run(&mut copy, &program[200..]));
}

#[test]
fn variation_changes_the_world_by_seed_and_trial_alone() {
    let blueprint = gauge::blueprint("biped-1");
    let sensors = blueprint.creature().sensors.clone();
    let variation = Variation { friction: 0.3, mass: 0.1, torque: 0.1, ..Variation::default() };
    let mut environment =
        RapierEnvironment::new(blueprint, &sensors, 3.0, PhysicsSettings::default(), variation).expect("builds");
    let mut ends_at = |seed: Seed| {
        environment.reset(seed).expect("settles");
        for outputs in restless(1, 2, 200) {
            environment.act(&outputs);
            environment.step().expect("stable");
        }
        environment.snapshot().torso().x
    };
    let first = ends_at(Seed::of_run(1));
    assert_ne!(first, ends_at(Seed::of_run(1).trial(1)));
    assert_ne!(first, ends_at(Seed::of_run(2)));
    assert_eq!(first, ends_at(Seed::of_run(1)));
}

#[test]
fn a_controller_that_is_no_number_is_a_failure() {
    let mut environment = gauge::shipped("biped-1", PhysicsSettings::default());
    environment.reset(Seed::of_run(1)).expect("settles");
    environment.act(&[0.0, f32::NAN]);
    let failure = environment.step().expect_err("NaN must not pass");
    assert_eq!(failure.to_string(), "output 1 of the controller is not finite");
}

#[test]
fn a_part_that_is_too_fast_is_a_failure() {
    let settings = PhysicsSettings { unstable_speed: 1.0, ..PhysicsSettings::default() };
    let mut environment = gauge::shipped("tetrapod-2", settings);
    environment.reset(Seed::of_run(1)).expect("settles");
    let failure = restless(1, 8, 200)
        .iter()
        .find_map(|outputs| {
            environment.act(outputs);
            environment.step().err()
        })
        .expect("a running tetrapod is faster than 1 m/s");
    assert!(matches!(failure, Failure::Unstable { .. }), "{failure}");
}

#[test]
fn settings_out_of_range_name_field_and_range() {
    let build = |settings, variation| {
        let blueprint = gauge::blueprint("biped-1");
        let sensors = blueprint.creature().sensors.clone();
        match RapierEnvironment::new(blueprint, &sensors, 3.0, settings, variation) {
            Err(EnvironmentError::Setting(error)) => error.to_string(),
            _ => panic!("must be refused"),
        }
    };
    let ours = PhysicsSettings::default();
    let time_step = PhysicsSettings { time_step: 0.0, ..ours };
    assert_eq!(build(time_step, Variation::default()), "physics.time_step = 0: must be from 0.001 to 0.05");
    let gravity = PhysicsSettings { gravity: f32::NAN, ..ours };
    assert_eq!(build(gravity, Variation::default()), "physics.gravity = NaN: must be from 0 to 100");
    let mass = Variation { mass: 1.0, ..Variation::default() };
    assert_eq!(build(ours, mass), "variation.mass = 1: must be from 0 to 0.9");
}

/// Champion files carry the version: it must be the one that is built in.
#[test]
fn the_version_is_the_one_in_the_lock_file() {
    let lock = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.lock")).expect("there is one");
    assert!(lock.contains(&format!("name = \"rapier2d\"\nversion = \"{RAPIER_VERSION}\"")));
}

/// The biped moved up or down, in its file.
fn raised(height: f32, settings: PhysicsSettings) -> Result<RapierEnvironment, EnvironmentError> {
    let blueprint = gauge::raised("biped-1", height);
    let sensors = blueprint.creature().sensors.clone();
    RapierEnvironment::new(blueprint, &sensors, 3.0, settings, Variation::default())
}

#[test]
fn a_creature_that_cannot_settle_is_refused() {
    let ours = PhysicsSettings::default();
    let refusal = |height| raised(height, ours).err().expect("must be refused").to_string();
    assert_eq!(
        refusal(-3.0),
        "the creature \"biped-1\" starts 3 m below the ground: its lowest point must be near y = 0"
    );
    assert_eq!(
        refusal(40.0),
        "the creature \"biped-1\" does not survive settling in its start pose: it is still in the air after settling \
         for 1 s"
    );
    assert!(raised(40.0, PhysicsSettings { settle_time: 0.0, ..ours }).is_ok());
    assert!(raised(0.3, ours).is_ok());
}
