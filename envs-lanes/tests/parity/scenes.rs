//! Single effects whose physics is known, each in both engines: the same bits, and the right ones.

use crate::{
    any_creature::raise,
    gauges::{energy, inertia, joint_angle},
    stage::{SHIPPED, all_sensors, both, follow},
};
use creatures::{Blueprint, Creature, Joint, Motor, Part, Shape};
use envs_core::{PhysicsSettings, Variation};
use envs_rapier::RapierEnvironment;
use ne_core::Seed;
use std::f64::consts::TAU;
use tasks::Environment;

fn part(name: &str, tag: &str, shape: Shape, density: f32, position: [f32; 2]) -> Part {
    let (name, tag) = (name.to_owned(), tag.to_owned());
    Part { name, tag, shape, density, friction: 1.0, position, angle: 0.0, leg: true, look: Default::default() }
}

fn rectangle(width: f32, height: f32) -> Shape {
    Shape::Box { width, height }
}

fn joint(child: &str, anchor: [f32; 2], limits: [f32; 2], motor: Option<Motor>) -> Joint {
    Joint { parent: "torso".into(), child: child.into(), anchor, limits, motor }
}

/// A torso of many tonnes, which nothing moves, its top at (0, 2), and an idle part without which it would not be a
/// creature.
fn rock() -> Creature {
    let mut creature = Creature::new("rock");
    creature.parts.push(part("torso", "torso", rectangle(4.0, 2.0), 10_000.0, [0.0, 1.0]));
    creature.parts.push(part("idle", "leg", Shape::Circle { radius: 0.05 }, 1.0, [0.0, 1.0]));
    let motor = Motor { top_speed: 1.0, top_torque: 10.0 };
    creature.joints.push(joint("idle", [0.0, 1.0], [-10.0, 10.0], Some(motor)));
    creature
}

const AFLOAT: fn() -> PhysicsSettings = || PhysicsSettings { settle_time: 0.0, ..PhysicsSettings::default() };

/// Plays a creature in both engines with the same outputs in every step, compares the bits, and shows each moment.
fn play(
    blueprint: &Blueprint,
    settings: PhysicsSettings,
    steps: u32,
    output: f32,
    look: impl FnMut(&RapierEnvironment),
) {
    let (mut rapier, mut lanes) = both(blueprint, &all_sensors(blueprint), settings, Variation::default());
    let outputs = vec![output; rapier.outputs()];
    let failure = follow(&mut rapier, &mut lanes, Seed::of_run(1), steps, |_, _| (), outputs, look);
    assert_eq!(failure, None, "{}", blueprint.name());
}

fn raised(name: &str, height: f32) -> Creature {
    let mut creature = creatures::find(name).expect("shipped");
    raise(&mut creature, height);
    creature
}

/// The speed after n substeps of h is g n h, and semi-implicit Euler adds it before it moves: g h² n (n + 1) / 2 fallen.
#[test]
fn free_fall_is_that_of_the_closed_form() {
    for name in SHIPPED {
        let blueprint = Blueprint::new(raised(name, 4.0)).expect("valid");
        let start: Vec<f64> = blueprint.parts().iter().map(|part| f64::from(part.y)).collect();
        let (substep, mut n) = (0.01_f64, 0.0_f64);
        play(&blueprint, AFLOAT(), 40, 0.0, |rapier| {
            let fallen = 9.81 * substep * substep * n * (n + 1.0) / 2.0;
            let time = n * substep;
            assert!((fallen - 9.81 * time * time / 2.0).abs() <= 9.81 * time * substep / 2.0 + 1e-9);
            for (part, start) in rapier.snapshot().parts.iter().zip(&start) {
                let (height, speed) = (f64::from(part.y), f64::from(part.vy));
                assert!((height - (start - fallen)).abs() < 2e-4, "{name}: {height} m after {time} s");
                assert!((speed + 9.81 * time).abs() < 1e-3, "{name}: {speed} m/s after {time} s");
                assert!(!part.touching);
            }
            n += 2.0;
        });
    }
}

/// A disc on a massless rod, let go 60° from the vertical. Its period is 1.07318 times that of small swings
/// (complete elliptic integral, K(sin 30°) · 2 / π).
#[test]
fn a_pendulum_keeps_its_period_and_nearly_its_energy() {
    const LENGTH: f64 = 0.9;
    let (sin, cos) = 60_f64.to_radians().sin_cos();
    let mut creature = rock();
    let bob = [(LENGTH * sin) as f32, (2.0 - LENGTH * cos) as f32];
    creature.parts.push(part("bob", "bob", Shape::Circle { radius: 0.1 }, 100.0, bob));
    creature.joints.push(joint("bob", [0.0, 2.0], [-150.0, 30.0], None));
    let blueprint = Blueprint::new(creature).expect("valid");
    let bob = &blueprint.parts()[2];
    let (mass, own) = (f64::from(bob.mass()), inertia(bob));
    let about_hinge = own + mass * LENGTH * LENGTH;
    let period = 1.073_18 * TAU * (about_hinge / (mass * 9.81 * LENGTH)).sqrt();
    let bottom = mass * 9.81 * (2.0 - LENGTH);
    let mut of_bob = Vec::new();
    let mut crossings = Vec::new();
    let mut before = None;
    play(&blueprint, AFLOAT(), 500, 0.0, |rapier| {
        let snapshot = rapier.snapshot();
        let state = &snapshot.parts[2];
        let square = |value: f32| f64::from(value) * f64::from(value);
        let kinetic = 0.5 * mass * (square(state.vx) + square(state.vy)) + 0.5 * own * square(state.spin);
        of_bob.push(kinetic + mass * 9.81 * f64::from(state.y) - bottom);
        // Through the lowest point, leftwards.
        let (x, time) = (f64::from(state.x), f64::from(snapshot.time));
        if let Some((x_before, time_before)) = before
            && x_before > 0.0
            && x <= 0.0
        {
            crossings.push(time_before + (time - time_before) * x_before / (x_before - x));
        }
        before = Some((x, time));
    });
    let found = crossings[1] - crossings[0];
    assert!((found / period - 1.0).abs() < 0.02, "a period of {found} s, not {period} s");
    let most = of_bob.iter().copied().fold(0.0, f64::max);
    assert!(most < 1.01 * of_bob[0], "{most} J of {} J", of_bob[0]);
    let last = of_bob[of_bob.len() - 1];
    assert!(last > 0.5 * of_bob[0], "{last} J of {} J are left after 10 s", of_bob[0]);
}

#[test]
fn a_box_drops_onto_its_side_and_stays() {
    let mut creature = sledge(0.5);
    raise(&mut creature, 0.5);
    let blueprint = Blueprint::new(creature).expect("valid");
    let mut landed = None;
    let mut last = None;
    play(&blueprint, AFLOAT(), 150, 0.0, |rapier| {
        let snapshot = rapier.snapshot();
        if snapshot.torso().touching {
            landed.get_or_insert(snapshot.time);
        }
        last = Some(*snapshot.torso());
    });
    let (landed, last) = (landed.expect("it lands"), last.expect("it moves"));
    let fall = (2.0_f32 * 0.5 / 9.81).sqrt();
    assert!((landed - fall).abs() <= 0.02, "it lands after {landed} s, not {fall} s");
    assert!((last.y - 0.1).abs() < 0.003, "its centre comes to rest at {} m", last.y);
    assert!(last.vx.abs().max(last.vy.abs()) < 0.005 && last.sin.abs() < 0.01, "{last:?}");
}

/// A flat box with an arm that it can throw forward: a push off the ground, by friction alone.
fn sledge(friction: f32) -> Creature {
    let mut creature = Creature::new("sledge");
    let mut torso = part("torso", "torso", rectangle(1.6, 0.2), 30.0, [0.0, 0.1]);
    torso.friction = friction;
    creature.parts.push(torso);
    creature.parts.push(part("arm", "leg", rectangle(0.4, 0.1), 100.0, [-0.2, 0.25]));
    let motor = Motor { top_speed: 6.0, top_torque: 10.0 };
    creature.joints.push(joint("arm", [0.0, 0.25], [-160.0, 0.0], Some(motor)));
    creature
}

/// While it slides one way, the ground takes momentum at the rate μ N, and N is what carries it: so from any moment to
/// its stop, in t seconds, it loses p = μ (m g t + Δp upward).
#[test]
fn a_sliding_box_stops_when_coulomb_says() {
    for friction in [0.02, 0.05, 0.1] {
        let blueprint = Blueprint::new(sledge(friction)).expect("valid");
        let masses: Vec<f64> = blueprint.parts().iter().map(|part| f64::from(part.mass())).collect();
        let mut moments = Vec::new();
        play(&blueprint, PhysicsSettings::default(), 150, -1.0, |rapier| {
            let snapshot = rapier.snapshot();
            let parts = || snapshot.parts.iter().zip(&masses);
            let forward: f64 = parts().map(|(part, mass)| f64::from(part.vx) * mass).sum();
            let upward: f64 = parts().map(|(part, mass)| f64::from(part.vy) * mass).sum();
            moments.push((snapshot.torso().vx, forward, upward));
        });
        let speed = |moment: &(f32, f64, f64)| moment.0.abs();
        let first = (0..moments.len()).max_by(|&a, &b| speed(&moments[a]).total_cmp(&speed(&moments[b])));
        let first = first.expect("there are moments");
        let way = moments[first].0.signum();
        let slid = moments[first..].iter().position(|moment| moment.0 * way < 0.05).expect("it stops") - 1;
        let ((top, p, up), (_, p_then, up_then)) = (moments[first], moments[first + slid]);
        let weight = masses.iter().sum::<f64>() * 9.81;
        let wanted = f64::from(friction) * (weight * slid as f64 * 0.02 + up_then - up);
        let found = (p - p_then) * f64::from(way);
        assert!(top.abs() > 0.1 && slid >= 5, "{top} m/s for {slid} steps");
        assert!((found / wanted - 1.0).abs() < 0.05, "friction {friction}: {found} N s in {slid} steps, not {wanted}");
    }
}

/// An arm on a rock, in weightlessness, turned by a motor of 2 N·m.
fn crank(limits: [f32; 2], top_speed: f32) -> Blueprint {
    let mut creature = rock();
    creature.parts.push(part("arm", "leg", rectangle(0.8, 0.1), 50.0, [0.4, 2.0]));
    let motor = Motor { top_speed, top_torque: 2.0 };
    creature.joints.push(joint("arm", [0.0, 2.0], limits, Some(motor)));
    Blueprint::new(creature).expect("valid")
}

#[test]
fn a_motor_at_its_cap_gives_its_top_torque_until_it_has_its_speed() {
    let blueprint = crank([-170.0, 170.0], 3.0);
    let arm = &blueprint.parts()[2];
    let about_hinge = inertia(arm) + f64::from(arm.mass()) * 0.4 * 0.4;
    let settings = PhysicsSettings { gravity: 0.0, ..AFLOAT() };
    let mut steps = 0;
    play(&blueprint, settings, 50, 1.0, |rapier| {
        let (spin, torque) = (f64::from(rapier.snapshot().parts[2].spin), rapier.motor_torques().nth(1).expect("two"));
        let wanted = (2.0 / about_hinge * f64::from(steps) * 0.02).min(3.0);
        assert!((spin - wanted).abs() < 0.05, "{spin} rad/s after {steps} steps, not {wanted}");
        assert!(torque.abs() < 2.0 * 1.0001, "{torque} N·m");
        if steps > 0 && wanted < 2.5 {
            assert!((torque - 2.0).abs() < 1e-3, "{torque} N·m after {steps} steps");
        }
        steps += 1;
    });
}

#[test]
fn a_joint_stops_at_its_limit() {
    let blueprint = crank([-40.0, 25.0], 6.0);
    for (output, limit) in [(1.0, 25.0_f32), (-1.0, -40.0)] {
        let mut angles = Vec::new();
        let settings = PhysicsSettings { gravity: 0.0, ..AFLOAT() };
        play(&blueprint, settings, 150, output, |rapier| angles.push(joint_angle(&blueprint, rapier.snapshot(), 1)));
        let limit = limit.to_radians();
        let beyond = angles.iter().map(|angle| (angle - limit) * output).fold(f32::NEG_INFINITY, f32::max);
        assert!((0.0..0.06).contains(&beyond), "{beyond} rad beyond the limit of {limit}");
        let last = angles[angles.len() - 1];
        assert!((last - limit).abs() < 0.01, "it comes to rest at {last} rad, its limit is {limit}");
    }
}

/// Its motors are as good as none, so nothing gives it energy but the start.
#[test]
fn a_passive_drop_gains_no_energy() {
    for name in SHIPPED {
        let mut creature = raised(name, 1.0);
        for motor in creature.joints.iter_mut().filter_map(|joint| joint.motor.as_mut()) {
            motor.top_torque = 0.01;
        }
        let blueprint = Blueprint::new(creature).expect("valid");
        let mut energies = Vec::new();
        play(&blueprint, AFLOAT(), 500, 0.0, |rapier| energies.push(energy(&blueprint, rapier.snapshot(), 9.81)));
        let most = energies.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!(most < 1.01 * energies[0], "{name}: {most} J of {} J", energies[0]);
        let last = energies[energies.len() - 1];
        assert!(last < 0.9 * energies[0], "{name}: still {last} J of {} J", energies[0]);
    }
}

/// A heavy body on two legs of four segments each: motors hold the hips still, limits lock the knees.
#[test]
fn a_tall_stack_on_legs_stands_still() {
    let mut creature = Creature::new("tower");
    creature.parts.push(part("torso", "torso", rectangle(0.8, 0.6), 60.0, [0.0, 1.9]));
    for (leg, x) in [("left", -0.3), ("right", 0.3)] {
        let mut parent = "torso".to_owned();
        for segment in 0..4 {
            let (name, top) = (format!("{leg} {segment}"), 1.6 - 0.4 * segment as f32);
            let shape = if segment == 3 { rectangle(0.3, 0.4) } else { rectangle(0.15, 0.4) };
            creature.parts.push(part(&name, "leg", shape, 40.0, [x, top - 0.2]));
            let hip = Some(Motor { top_speed: 5.0, top_torque: 200.0 }).filter(|_| segment == 0);
            let limits = if segment == 0 { [-45.0, 45.0] } else { [0.0, 0.0] };
            creature.joints.push(Joint { parent, ..joint(&name, [x, top], limits, hip) });
            parent = name;
        }
    }
    let blueprint = Blueprint::new(creature).expect("valid");
    let mut heights = Vec::new();
    let mut fastest = 0.0_f32;
    play(&blueprint, PhysicsSettings::default(), 1000, 0.0, |rapier| {
        let torso = rapier.snapshot().torso();
        heights.push(torso.y);
        fastest = fastest.max(torso.vx.abs()).max(torso.vy.abs()).max(torso.spin.abs());
    });
    let sunk = heights[0] - heights[heights.len() - 1];
    assert!((1.9 - heights[0]).abs() < 0.02, "it settles at {} m", heights[0]);
    assert!(sunk.abs() < 0.01 && fastest < 0.02, "it sinks {sunk} m in 20 s, at up to {fastest} m/s");
}
