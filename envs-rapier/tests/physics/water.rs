//! Creatures in water: what floats, sinks, slows down and swims.

use crate::gauge::{blueprint, restless};
use creatures::{Blueprint, Joint, Shape};
use envs_core::{Conditions, Engine, Ground, Water};
use envs_rapier::{PhysicsSettings, RapierEnvironment, RapierWorld, Variation};
use ne_core::Seed;
use std::f32::consts::{FRAC_PI_2, TAU};
use tasks::{BodyPart, Environment, Movement, NoExploits, PartState, Swimming, Verdict, conformance};

const GRAVITY: f32 = 9.81;
const LENGTH: f32 = 0.4;
const BREADTH: f32 = 0.1;
const DENSITY: f32 = 30.0;

fn settings(water: Water) -> PhysicsSettings {
    PhysicsSettings { water: Some(water), ..PhysicsSettings::default() }
}

/// Two rods, one on the other, which fall as one does: a creature needs a motor. Level, or turned by an angle, degrees.
fn rod(angle: f32) -> Blueprint {
    let mut creature = creatures::find("apod").expect("shipped");
    creature.parts.truncate(2);
    creature.joints.truncate(1);
    for rod in &mut creature.parts {
        (rod.shape, rod.density) = (Shape::Box { width: LENGTH, height: BREADTH }, DENSITY);
        (rod.position, rod.angle) = ([0.0, 1.0], angle);
    }
    let [parent, child] = [0, 1].map(|part| creature.parts[part].name.clone());
    creature.joints[0] = Joint { parent, child, anchor: [0.0, 1.0], ..creature.joints[0].clone() };
    Blueprint::new(creature).expect("valid")
}

/// How fast a rod rises, or below 0 sinks, in the sixth second in water, m/s.
fn terminal_speed(angle: f32, water: Water, time_step: f32) -> f32 {
    let settings = PhysicsSettings { time_step, ..settings(water) };
    let (rod, reference) = (rod(angle.to_degrees()), Conditions::reference(1));
    let mut world = RapierWorld::new(&rod, &settings, &Ground::none(), &reference).expect("builds");
    let mut height_after = |seconds: f32| {
        let mut parts = [PartState::default(); 2];
        for _ in 0..(seconds / time_step).round() as usize {
            assert!(world.step());
        }
        world.look(&mut parts);
        parts[0].y
    };
    let before = height_after(5.0);
    height_after(1.0) - before
}

#[test]
fn a_rod_sinks_rises_or_hangs_at_the_speed_of_its_balance() {
    for (density, time_step) in [(15.0, 1.0 / 40.0), (15.0, 1.0 / 120.0), (45.0, 0.02), (60.0, 1.0 / 120.0)] {
        let water = Water { density: Some(density), drag: 1.2, slip: 0.1 };
        let along = water.slip + (water.drag - water.slip) * (BREADTH / LENGTH) * (BREADTH / LENGTH);
        for (angle, coefficient) in [(0.0, water.drag), (FRAC_PI_2, along)] {
            // Weight less buoyancy is what drag holds.
            let pull = GRAVITY * (density - DENSITY) * LENGTH * BREADTH;
            let wanted = pull.signum() * (pull.abs() / (0.5 * density * coefficient * LENGTH)).sqrt();
            let found = terminal_speed(angle, water, time_step);
            assert!((found / wanted - 1.0).abs() < 0.05, "{density} kg/m², {angle} rad: {found} m/s, not {wanted}");
        }
    }
    let balanced = Water { density: Some(DENSITY), ..Water::default() };
    assert_eq!(terminal_speed(0.3, balanced, 0.02), 0.0);
    assert!(terminal_speed(0.3, Water::default(), 0.02).abs() < 1e-4, "in balance of itself");
}

#[test]
fn a_rod_falls_faster_lengthwise_than_crosswise() {
    let water = Water { density: Some(0.5 * DENSITY), ..Water::default() };
    let [crosswise, lengthwise] = [0.0, FRAC_PI_2].map(|angle| -terminal_speed(angle, water, 0.02));
    assert!(lengthwise > 1.5 * crosswise && crosswise > 0.0, "{lengthwise}, {crosswise} m/s");
}

fn swimmer(name: &str, settings: PhysicsSettings, variation: Variation) -> RapierEnvironment {
    let blueprint = blueprint(name);
    let sensors = blueprint.creature().sensors.clone();
    RapierEnvironment::new(blueprint, &sensors, 3.0, settings, variation).expect("builds")
}

fn fastest(environment: &RapierEnvironment) -> f32 {
    let speed = |part: &PartState| part.vx.abs().max(part.vy.abs()).max(part.spin.abs());
    environment.snapshot().parts.iter().map(speed).fold(0.0, f32::max)
}

#[test]
fn creatures_in_water_keep_the_promises_of_environments() {
    for (name, variation) in [("apod", Variation::light()), ("tetrapod-2", Variation::strong())] {
        let environment = swimmer(name, settings(Water::default()), variation);
        conformance::check_environment(&environment, Seed::of_run(3))
            .unwrap_or_else(|broken| panic!("{name}: {broken}"));
        assert_eq!(*environment.landscape_of(Seed::of_run(1)), Ground::none().into(), "no bumps in water");
    }
}

#[test]
fn a_creature_that_does_not_move_stays_where_it_is() {
    let mut apod = swimmer("apod", settings(Water::default()), Variation::default());
    apod.reset(Seed::of_run(1)).expect("builds");
    let start = apod.snapshot().clone();
    for _ in 0..500 {
        apod.act(&[0.0; 6]);
        apod.step().expect("stable");
    }
    for (before, after) in start.parts.iter().zip(&apod.snapshot().parts) {
        assert!((before.x - after.x).abs().max((before.y - after.y).abs()) < 1e-3, "{before:?}, {after:?}");
    }
}

#[test]
fn a_creature_that_stops_moving_comes_to_rest() {
    let mut apod = swimmer("apod", settings(Water::default()), Variation::default());
    apod.reset(Seed::of_run(1)).expect("builds");
    for outputs in restless(1, 6, 150) {
        apod.act(&outputs);
        apod.step().expect("stable");
    }
    let mut speeds = vec![fastest(&apod)];
    apod.act(&[0.0; 6]);
    for _ in 0..3 {
        (0..500).for_each(|_| apod.step().expect("stable"));
        speeds.push(fastest(&apod));
    }
    assert!(speeds[0] > 1.0 && speeds[3] < 0.05 && speeds.is_sorted_by(|a, b| a > b), "{speeds:?} m/s");
}

/// How far an apod gets in 5 s along which a wave runs from one end to the other, m.
fn wave(direction: f32, time_step: f32) -> f64 {
    let settings = PhysicsSettings { time_step, ..settings(Water::default()) };
    let mut apod = swimmer("apod", settings, Variation::default());
    let mut movement = Swimming::default();
    movement.bind(apod.body().expect("it has one"));
    apod.reset(Seed::of_run(1)).expect("builds");
    movement.begin(apod.snapshot());
    // Head, back to tail; joints in the file go from the middle forwards, then from the middle backwards.
    let places: [f32; 6] = [2.0, 1.0, 0.0, 3.0, 4.0, 5.0];
    for step in 0..(5.0 / time_step) as usize {
        let phase = TAU * 2.0 * step as f32 * time_step;
        // A joint in the rear half is turned the other way by the same bend.
        let speed = |joint: usize| {
            let sign = if joint < 3 { 1.0 } else { -1.0 };
            sign * 0.5 * libm::cosf(phase - direction * places[joint])
        };
        apod.act(&std::array::from_fn::<f32, 6, _>(speed));
        apod.step().expect("stable");
        movement.observe(apod.snapshot());
    }
    movement.value()
}

#[test]
fn a_wave_down_the_body_drives_it_the_other_way_at_any_time_step() {
    let steps = [1.0 / 40.0, 1.0 / 60.0, 1.0 / 120.0];
    let [coarse, middle, fine] = steps.map(|time_step| wave(1.0, time_step));
    assert!(fine > 0.8, "{fine} m");
    for other in [coarse, middle] {
        assert!((other / fine - 1.0).abs() < 0.22, "{coarse}, {middle}, {fine} m");
    }
    assert!(wave(-1.0, 0.02) < -0.8, "backwards");
}

/// One half sinks, the other rises: the body turns, and gains speed that no motor gave it.
#[test]
fn energy_in_water_is_counted_by_each_part_s_own_buoyancy() {
    let mut creature = creatures::find("apod").expect("shipped");
    let middle = creature.parts[0].position[0];
    for part in &mut creature.parts {
        part.density = if part.position[0] > middle { 900.0 } else { 90.0 };
    }
    let blueprint = Blueprint::new(creature).expect("valid");
    let settings = settings(Water { drag: 0.01, slip: 0.0, ..Water::default() });
    let (sensors, still) = (blueprint.creature().sensors.clone(), Variation::default());
    let mut apod = RapierEnvironment::new(blueprint, &sensors, 3.0, settings, still).expect("builds");
    let body = apod.body().expect("it has one").clone();
    assert!(body.pull().abs() < 1e-4, "in balance as a whole");
    let mut movement = NoExploits::default();
    movement.bind(&body);
    apod.reset(Seed::of_run(1)).expect("builds");
    movement.begin(apod.snapshot());
    let mut most: f32 = 0.0;
    for _ in 0..150 {
        apod.step().expect("stable");
        assert_eq!(movement.observe(apod.snapshot()), Verdict::GoOn);
        let moving = body.parts.iter().zip(&apod.snapshot().parts);
        let energy = |(part, state): (&BodyPart, &PartState)| {
            0.5 * part.mass * (state.vx * state.vx + state.vy * state.vy) + 0.5 * part.inertia * state.spin * state.spin
        };
        most = most.max(moving.map(energy).sum());
    }
    assert!(most > 7.0, "{most} J would be no exploit either way");
}

#[test]
fn a_creature_in_water_weighs_what_buoyancy_leaves() {
    let gravity = |density| {
        let water = Water { density, ..Water::default() };
        let apod = swimmer("apod", settings(water), Variation::default());
        apod.body().expect("it has one").pull()
    };
    assert!(gravity(None).abs() < 1e-5);
    assert!((gravity(Some(15.0)) - 0.5 * GRAVITY).abs() < 1e-4);
    assert!((gravity(Some(60.0)) + GRAVITY).abs() < 1e-4);
}
