//! The traps of rapier for small creatures with strong motors. Each test measures with our settings, then undoes the
//! one that avoids the trap, and sees it close.

use crate::gauge::{self, energy, joint_error, limit_overshoot, penetration, restless, run};
use creatures::{Blueprint, Motor};
use envs_rapier::PhysicsSettings;
use ne_core::Seed;
use rapier2d::prelude::*;
use tasks::{Environment, Snapshot};

/// The worst value of a gauge over three restless motor programs of 10 s.
fn worst(name: &str, settings: PhysicsSettings, gauge: impl Fn(&Blueprint, &Snapshot) -> f32) -> f32 {
    let blueprint = gauge::blueprint(name);
    let mut environment = gauge::environment(blueprint.clone(), settings);
    let mut worst = f32::NEG_INFINITY;
    for seed in 0..3 {
        let program = restless(seed, environment.outputs(), 500);
        run(&mut environment, &program, |environment| worst = worst.max(gauge(&blueprint, environment.snapshot())));
    }
    worst
}

/// A shipped creature, higher above the ground, with motors changed.
fn altered(name: &str, height: f32, motor: impl Fn(Motor) -> Motor) -> Blueprint {
    let mut creature = creatures::find(name).expect("shipped");
    for part in &mut creature.parts {
        part.position[1] += height;
    }
    for joint in &mut creature.joints {
        joint.anchor[1] += height;
        joint.motor = joint.motor.map(&motor);
    }
    Blueprint::new(creature).expect("valid")
}

const OURS: fn() -> PhysicsSettings = PhysicsSettings::default;

#[test]
fn a_strong_motor_does_not_turn_a_leg_through_its_limit() {
    let ours = worst("tetrapod-2", OURS(), limit_overshoot);
    let undone = worst("tetrapod-2", PhysicsSettings { corrective_speed: 3.0, ..OURS() }, limit_overshoot);
    assert!(ours < 0.4, "{ours} rad beyond the limit");
    assert!(undone > 0.8, "corrective_speed no longer matters: {undone} rad beyond the limit");
}

#[test]
fn joints_hold_together() {
    let ours = worst("tetrapod-2", OURS(), joint_error);
    let undone = worst("tetrapod-2", PhysicsSettings { internal_iterations: 1, ..OURS() }, joint_error);
    assert!(ours < 0.08, "a joint is {ours} m apart");
    assert!(undone > 0.12, "internal_iterations no longer matters: a joint is {undone} m apart");
}

#[test]
fn feet_do_not_sink_into_the_ground() {
    let ours = worst("tetrapod-2", OURS(), penetration);
    let undone = worst("tetrapod-2", PhysicsSettings { prediction_distance: 0.02, ..OURS() }, penetration);
    assert!(ours < 0.04, "{ours} m deep");
    assert!(undone > 0.08, "prediction_distance no longer matters: {undone} m deep");
}

/// The energy a limp creature gains, step by step, while it drops from 1 m and comes to rest, J.
fn energy_gained(joint_frequency: f32) -> f64 {
    let limp = |motor: Motor| Motor { top_torque: 0.01, ..motor };
    let blueprint = altered("tetrapod-2", 1.0, limp);
    let settings = PhysicsSettings { settle_time: 0.0, joint_frequency, ..OURS() };
    let mut environment = gauge::environment(blueprint.clone(), settings);
    let energy_now = |snapshot: &Snapshot| energy(&blueprint, snapshot, settings.gravity);
    let (mut last, mut gained) = (energy_now(environment.snapshot()), 0.0);
    let idle = vec![vec![0.0; environment.outputs()]; 500];
    run(&mut environment, &idle, |environment| {
        let now = energy_now(environment.snapshot());
        gained += (now - last).max(0.0);
        last = now;
    });
    gained
}

#[test]
fn a_passive_drop_gains_no_energy() {
    let (ours, undone) = (energy_gained(60.0), energy_gained(1e6));
    assert!(ours < 12.0, "{ours} J of 268 J");
    assert!(undone > 3.0 * ours, "joint_frequency no longer matters: {undone} J against {ours} J");
}

/// The torque on a free body in weightlessness, from its angular acceleration, over the motor's top torque.
fn torque_ratio(motor_gain: f32) -> f32 {
    let blueprint = altered("biped-1", 5.0, |_| Motor { top_torque: 5.0, top_speed: 100.0 });
    let settings = PhysicsSettings { gravity: 0.0, settle_time: 0.0, motor_gain, ..OURS() };
    let mut environment = gauge::environment(blueprint.clone(), settings);
    environment.reset(Seed::of_run(1)).expect("settles");
    environment.act(&[1.0, 1.0]);
    // Two steps, so that the acceleration is taken between two moments when the motors already pull.
    environment.step().expect("stable");
    let before: Vec<f32> = environment.snapshot().parts.iter().map(|part| part.spin).collect();
    environment.step().expect("stable");
    let torso = &blueprint.parts()[0];
    let inertia = match torso.shape {
        creatures::Shape::Box { width, height } => torso.mass() * (width * width + height * height) / 12.0,
        _ => unreachable!("a box"),
    };
    for torque in environment.motor_torques() {
        assert!(torque.abs() <= 5.0 * 1.001, "a motor gives {torque} N·m, its limit is 5");
    }
    // Both motors push the legs one way and the torso the other; hinge forces on the torso act 0.25 m below its centre
    // and add to that, so the torso alone shows at least the torque of both.
    let acceleration = (environment.snapshot().torso().spin - before[0]).abs() / settings.time_step;
    acceleration * inertia / (2.0 * 5.0)
}

#[test]
fn a_motor_gives_its_top_torque_and_no_more() {
    let (ours, undone) = (torque_ratio(OURS().motor_gain), torque_ratio(0.01));
    assert!(ours > 0.9, "the torso feels {ours} of the torque of its motors");
    assert!(undone < 0.7, "motor_gain no longer matters: {undone}");
}

/// rapier tells what a motor gave in the last substep. One that holds its speed hard has it after the first, and gives next to
/// nothing in the last: its work would look like energy from nowhere.
#[test]
fn the_work_of_motors_is_booked_whatever_the_substeps() {
    for solver_iterations in 1..=8 {
        for motor_gain in [20.0, 200.0, 2000.0, 10_000.0] {
            let blueprint = altered("biped-1", 5.0, |_| Motor { top_torque: 250.0, top_speed: 10.0 });
            let settings = PhysicsSettings { gravity: 0.0, settle_time: 0.0, motor_gain, solver_iterations, ..OURS() };
            let mut environment = gauge::environment(blueprint.clone(), settings);
            environment.reset(Seed::of_run(1)).expect("settles");
            let at_first = energy(&blueprint, environment.snapshot(), 0.0);
            environment.act(&[1.0, -1.0]);
            environment.step().expect("stable");
            let gained = energy(&blueprint, environment.snapshot(), 0.0) - at_first;
            let work = environment.snapshot().motor_work;
            let told = format!("{solver_iterations} iterations, gain {motor_gain}: {work} J for {gained} J");
            assert!(gained > 1.0 && work > 0.9 * gained, "{told}");
            assert!(work < 2.6 * gained, "{told}");
            // Of two substeps the last speaks for all.
            if solver_iterations <= 2 {
                let parts = &environment.snapshot().parts;
                let speeds =
                    environment.actuated().iter().map(|hinge| parts[hinge.child].spin - parts[hinge.parent].spin);
                let power: f32 =
                    environment.motor_torques().zip(speeds).map(|(torque, speed)| (torque * speed).abs()).sum();
                assert!((work / f64::from(power * settings.time_step) - 1.0).abs() < 1e-6, "{told}");
            }
        }
    }
}

/// Our ground is a half-space, which continuous collision detection passes over. On ground made of boxes, which terrain
/// will be, it moves a fast foot without its leg: so the setting is 0, and this is why.
fn joint_error_on_boxes(substeps: usize) -> f32 {
    let mut world = PhysicsWorld::new();
    world.integration_parameters = IntegrationParameters {
        dt: 0.02,
        num_solver_iterations: 2,
        num_internal_pgs_iterations: 4,
        normalized_max_corrective_velocity: 20.0,
        max_ccd_substeps: substeps,
        ..IntegrationParameters::default()
    };
    world.insert_collider(ColliderBuilder::cuboid(50.0, 0.5).translation(Vector::new(0.0, -0.5)), None);
    let part = |world: &mut PhysicsWorld, y: f32, half_height: f32, density: f32| {
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, y)).linvel(Vector::new(0.0, -15.0));
        let groups = InteractionGroups::new(Group::GROUP_2, Group::GROUP_1, InteractionTestMode::And);
        let collider = ColliderBuilder::cuboid(0.04, half_height).density(density).collision_groups(groups);
        world.insert(body, collider).0
    };
    let (thigh, shin) = (part(&mut world, 2.6, 0.2, 300.0), part(&mut world, 2.2, 0.2, 30.0));
    let joint = RevoluteJointBuilder::new()
        .local_anchor1(Vector::new(0.0, -0.2))
        .local_anchor2(Vector::new(0.0, 0.2))
        .contacts_enabled(false)
        .softness(SpringCoefficients::new(60.0, 1.0));
    world.insert_impulse_joint(thigh, shin, joint);
    let mut worst = 0.0_f32;
    for _ in 0..50 {
        world.step();
        let anchor = |body: RigidBodyHandle, y: f32| *world.bodies[body].position() * Vector::new(0.0, y);
        worst = worst.max((anchor(thigh, -0.2) - anchor(shin, 0.2)).length());
    }
    worst
}

#[test]
fn continuous_collision_detection_would_tear_joints() {
    assert_eq!(OURS().continuous_collision_substeps, 0);
    let (off, on) = (joint_error_on_boxes(0), joint_error_on_boxes(1));
    assert!(on > 1.2 * off, "continuous collision detection has become harmless: {on} m against {off} m");
}

#[test]
fn a_creature_that_has_long_stood_still_still_answers_its_motors() {
    let mut environment = gauge::shipped("tetrapod-2", OURS());
    let motors = environment.outputs();
    let mut program = vec![vec![0.0; motors]; 500];
    program.extend(vec![vec![1.0; motors]; 10]);
    let mut spin = 0.0_f32;
    run(&mut environment, &program, |environment| spin = environment.snapshot().parts[1].spin.abs());
    assert!(spin > 0.5, "a sleeping body ignores its motors: {spin} rad/s");
}
