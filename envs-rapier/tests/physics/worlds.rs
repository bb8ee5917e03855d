//! Worlds that are not flat, and worlds that differ from trial to trial.

use crate::gauge::{self, penetration, restless};
use creatures::Blueprint;
use envs_core::{Engine, Ground, GroundShape};
use envs_rapier::{PhysicsSettings, RapierEnvironment, Variation};
use ne_core::Seed;
use std::f32::consts::FRAC_PI_2;
use tasks::{Environment, Snapshot, conformance};

fn varied(blueprint: Blueprint, settings: PhysicsSettings, variation: Variation) -> RapierEnvironment {
    let sensors = blueprint.creature().sensors.clone();
    RapierEnvironment::new(blueprint, &sensors, 3.0, settings, variation).expect("builds")
}

/// How far a joint is turned against the start pose, rad.
fn joint_angle(blueprint: &Blueprint, snapshot: &Snapshot, hinge: usize) -> f32 {
    let hinge = &blueprint.hinges()[hinge];
    let angle = |part: usize| snapshot.parts[part].angle() - blueprint.parts()[part].angle;
    let turned = angle(hinge.child) - angle(hinge.parent);
    turned.sin().atan2(turned.cos())
}

/// What 200 restless steps of a trial look like.
fn trial(environment: &mut RapierEnvironment, seed: Seed) -> Vec<Snapshot> {
    environment.reset(seed).expect("settles");
    let program = restless(1, environment.outputs(), 200);
    let step = |outputs: &Vec<f32>| {
        environment.act(outputs);
        environment.step().expect("stable");
        environment.snapshot().clone()
    };
    program.iter().map(step).collect()
}

#[test]
fn every_shipped_creature_passes_the_conformance_kit_in_varied_worlds() {
    for shipped in creatures::shipped() {
        let blueprint = gauge::blueprint(shipped.name);
        let environment = varied(blueprint, PhysicsSettings::default(), Variation::light());
        conformance::check_environment(&environment, Seed::of_run(3))
            .unwrap_or_else(|broken| panic!("{}: {broken}", shipped.name));
    }
}

#[test]
fn a_box_carries_a_creature_that_falls_on_it() {
    const TOP: f32 = 0.3;
    let flat = gauge::shipped("tetrapod-2", PhysicsSettings::default());
    let blueprint = gauge::raised("tetrapod-2", TOP + 0.2);
    let sensors = blueprint.creature().sensors.clone();
    let step = GroundShape::Box { x: 0.0, y: TOP - 0.5, width: 6.0, height: 1.0 };
    let ground = Ground { shapes: vec![GroundShape::HalfSpace, step] };
    let (settings, variation) = (PhysicsSettings::default(), Variation::default());
    let environment =
        RapierEnvironment::on_ground(blueprint.clone(), &sensors, 3.0, settings, variation, ground).expect("builds");
    let (carried, on_flat) = (environment.snapshot(), flat.snapshot());
    let deepest = penetration(&blueprint, carried) + TOP;
    assert!((-0.005..0.02).contains(&deepest), "its lowest point is {deepest} m below the top of the box");
    let height = carried.torso().y - on_flat.torso().y;
    assert!((height - TOP).abs() < 0.02, "carried {height} m higher than on flat ground");
    let touching = |snapshot: &Snapshot| snapshot.parts.iter().map(|part| part.touching).collect::<Vec<_>>();
    assert_eq!(touching(carried), touching(on_flat), "the same feet press on the box as on flat ground");
    let engine = environment.settled(Seed::of_run(1)).expect("settles").engine;
    let below = |x: f32| engine.distance_to_ground([x, 2.0], -FRAC_PI_2, 5.0);
    assert!((below(0.0) - (2.0 - TOP)).abs() < 1e-4, "above the box the ground is {} m away", below(0.0));
    assert!((below(4.0) - 2.0).abs() < 1e-4, "beside the box the ground is {} m away", below(4.0));
}

#[test]
fn a_varied_start_pose_turns_joints_by_about_what_was_drawn() {
    let variation = Variation { start_pose: 0.2, ..Variation::default() };
    // Afloat, so that nothing but the motors turns a joint.
    let afloat = PhysicsSettings { gravity: 0.0, settle_time: 0.0, ..PhysicsSettings::default() };
    let blueprint = gauge::raised("tetrapod-2", 2.0);
    let mut environment = varied(blueprint.clone(), afloat, variation);
    let (mut drawn, mut missed) = (0.0, 0.0);
    for run in 0..5 {
        environment.reset(Seed::of_run(run)).expect("settles");
        let turns = variation.draw(Seed::of_run(run), environment.outputs()).turns;
        for (&hinge, turn) in blueprint.actuated().iter().zip(turns) {
            let angle = joint_angle(&blueprint, environment.snapshot(), hinge);
            assert!((angle - turn).abs() < 0.05, "hinge {hinge}: {angle} rad, drawn {turn}");
            drawn += turn.abs();
            missed += (angle - turn).abs();
        }
        assert_eq!(environment.snapshot().time, 0.0);
    }
    assert!(missed < 0.2 * drawn, "{missed} of {drawn} rad are missing");
}

/// On the ground a leg that bears weight turns less than was drawn, but no trial starts as another.
#[test]
fn a_varied_start_pose_is_another_in_each_trial() {
    let variation = Variation { near_first: false, ..Variation::light() };
    let mut environment = varied(gauge::blueprint("tetrapod-2"), PhysicsSettings::default(), variation);
    let blueprint = environment.blueprint().clone();
    let mut poses: Vec<Vec<f32>> = Vec::new();
    for trial in 0..5 {
        environment.reset(Seed::of_run(1).trial(trial)).expect("settles");
        let angle = |&hinge: &usize| joint_angle(&blueprint, environment.snapshot(), hinge);
        let pose: Vec<f32> = blueprint.actuated().iter().map(angle).collect();
        for other in &poses {
            let differs = pose.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(differs > 0.01, "two trials start within {differs} rad of each other");
        }
        poses.push(pose);
    }
}

/// A share this small is lost in rounding, so every factor is 1 though the world is drawn and settled for each trial.
#[test]
fn a_start_pose_that_does_not_vary_changes_no_bit() {
    let blueprint = gauge::blueprint("tetrapod-2");
    let variation = Variation { friction: 1e-12, ..Variation::default() };
    let mut drawn = varied(blueprint.clone(), PhysicsSettings::default(), variation);
    let mut reference = gauge::environment(blueprint, PhysicsSettings::default());
    assert!(trial(&mut drawn, Seed::of_run(1)) == trial(&mut reference, Seed::of_run(1)));
}

#[test]
fn a_varied_time_step_changes_the_time_of_a_step() {
    let variation = Variation { time_step: [0.9, 1.1], ..Variation::default() };
    let mut environment = varied(gauge::blueprint("biped-1"), PhysicsSettings::default(), variation);
    let mut times = Vec::new();
    for run in 0..3 {
        let seed = Seed::of_run(run);
        let time_step = 0.02 * variation.draw(seed, 2).time_step;
        assert!((0.018..=0.022).contains(&time_step));
        for (step, snapshot) in trial(&mut environment, seed).iter().enumerate() {
            assert_eq!(snapshot.time, (step + 1) as f32 * time_step);
        }
        times.push(environment.snapshot().time);
    }
    assert!(times[0] != times[1] && times[1] != times[2], "{times:?}");
}

/// How far the last joint of a biped moves while the others are restless; its lower leg has a tag that is not actuated.
fn passive_swing(motor: bool) -> f32 {
    let mut creature = creatures::find("biped-1").expect("shipped");
    let joint = creature.joints.last_mut().expect("has joints");
    joint.motor = joint.motor.filter(|_| motor);
    let child = joint.child.clone();
    let part = creature.parts.iter_mut().find(|part| part.name == child).expect("is a part");
    part.tag = "cast".to_owned();
    let blueprint = Blueprint::new(creature).expect("valid");
    let hinge = blueprint.hinges().len() - 1;
    assert!(!blueprint.hinges()[hinge].actuated);
    let mut environment = gauge::environment(blueprint.clone(), PhysicsSettings::default());
    let program = restless(1, environment.outputs(), 100);
    let mut widest = 0.0_f32;
    gauge::run(&mut environment, &program, |environment| {
        widest = widest.max(joint_angle(&blueprint, environment.snapshot(), hinge).abs());
    });
    widest
}

#[test]
fn a_motor_that_the_net_does_not_move_holds_still() {
    let (held, limp) = (passive_swing(true), passive_swing(false));
    assert!(held < 0.5 * limp, "{held} rad with its motor, {limp} rad without");
}
