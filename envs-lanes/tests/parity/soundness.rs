//! How far joints, limits and the ground give way, and what energy comes from nowhere: the bits are equal, so these are.

use crate::{
    any_creature::raise,
    gauges::{energy, joint_error, limit_overshoot, penetration},
    stage::{SHIPPED, both, shipped},
};
use creatures::Blueprint;
use envs_core::{CreatureEnvironment, Engine, PhysicsSettings, Variation};
use ne_core::{Purpose, Seed};
use rand::RngExt;
use tasks::Environment;

/// The worst joint error, m, limit overshoot, rad, and penetration, m, of a random motor program of 10 s.
fn worst<E: Engine>(environment: &mut CreatureEnvironment<E>, seed: Seed) -> [f32; 3] {
    environment.reset(seed).expect("settles");
    let mut stream = seed.stream(Purpose::new("motor program"));
    let mut outputs = vec![0.0; environment.outputs()];
    let mut worst = [f32::NEG_INFINITY; 3];
    for step in 0..500 {
        if step % 12 == 0 {
            outputs.fill_with(|| stream.random::<f32>() * 2.0 - 1.0);
        }
        environment.act(&outputs);
        environment.step().expect("stable");
        let (blueprint, now) = (environment.blueprint(), environment.snapshot());
        let gauged = [joint_error(blueprint, now), limit_overshoot(blueprint, now), penetration(blueprint, now)];
        worst = [0, 1, 2].map(|gauge| worst[gauge].max(gauged[gauge]));
    }
    worst
}

#[test]
fn joints_limits_and_ground_give_way_exactly_as_in_rapier() {
    for name in SHIPPED {
        let blueprint = shipped(name);
        let sensors = blueprint.creature().sensors.clone();
        let (mut rapier, mut lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), Variation::default());
        for run in 0..3 {
            let (found, wanted) = (worst(&mut lanes, Seed::of_run(run)), worst(&mut rapier, Seed::of_run(run)));
            assert_eq!(found.map(f32::to_bits), wanted.map(f32::to_bits), "{name}: {found:?}, {wanted:?}");
        }
    }
}

/// The energy a limp creature gains, step by step, while it drops from 1 m, J.
fn gained<E: Engine>(mut environment: CreatureEnvironment<E>) -> f64 {
    environment.reset(Seed::of_run(1)).expect("settles");
    let of = |environment: &CreatureEnvironment<E>| energy(environment.blueprint(), environment.snapshot(), 9.81);
    let (mut last, mut gained) = (of(&environment), 0.0);
    for _ in 0..500 {
        environment.step().expect("stable");
        let now = of(&environment);
        gained += (now - last).max(0.0);
        last = now;
    }
    gained
}

#[test]
fn a_limp_creature_gains_exactly_the_energy_it_gains_in_rapier() {
    for name in SHIPPED {
        let mut creature = shipped(name).creature().clone();
        raise(&mut creature, 1.0);
        for motor in creature.joints.iter_mut().filter_map(|joint| joint.motor.as_mut()) {
            motor.top_torque = 0.01;
        }
        let blueprint = Blueprint::new(creature).expect("valid");
        let sensors = blueprint.creature().sensors.clone();
        let settings = PhysicsSettings { settle_time: 0.0, ..PhysicsSettings::default() };
        let (rapier, lanes) = both(&blueprint, &sensors, settings, Variation::default());
        assert_eq!(gained(lanes).to_bits(), gained(rapier).to_bits(), "{name}");
    }
}
