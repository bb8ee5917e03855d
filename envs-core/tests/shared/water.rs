use crate::puppet::Puppet;
use creatures::{Blueprint, BodyPart, Joint, Shape, TERRAINS};
use envs_core::{CreatureEnvironment, EnvironmentError, Hull, PhysicsSettings, Variation, Water, body_of};
use proptest::prelude::*;
use std::f32::consts::{FRAC_PI_2, TAU};

/// Two parts of this shape, one on the other: a creature needs a motor.
fn twins(shape: Shape) -> Blueprint {
    let mut creature = creatures::find("apod").expect("shipped");
    creature.parts.truncate(2);
    creature.joints.truncate(1);
    for part in &mut creature.parts {
        (part.shape, part.position) = (shape, [0.0, 5.0]);
    }
    let [parent, child] = [0, 1].map(|part| creature.parts[part].name.clone());
    creature.joints[0] = Joint { parent, child, anchor: [0.0, 5.0], ..creature.joints[0].clone() };
    Blueprint::new(creature).expect("valid")
}

fn hull(part: &BodyPart, water: &Water) -> Hull {
    Hull::new(part, water, part.density, 1.0)
}

fn shape() -> impl Strategy<Value = Shape> {
    let size = || 0.005_f32..2.0;
    prop_oneof![
        (size(), size()).prop_map(|(width, height)| Shape::Box { width, height }),
        size().prop_map(|radius| Shape::Circle { radius }),
        (size(), size()).prop_map(|(length, radius)| Shape::Capsule { length, radius }),
    ]
}

proptest! {
    /// As fast as engines let parts be, and steps as long as settings allow.
    #[test]
    fn drag_never_adds_energy_nor_turns_a_part_back(
        shape in shape(),
        velocity in [-400.0_f32..400.0, -400.0_f32..400.0],
        spin in -200.0_f32..200.0,
        angle in 0.0..TAU,
        seconds in 0.001_f32..0.05,
        drag in 0.0_f32..10.0,
        slip in 0.0_f32..1.0,
    ) {
        let blueprint = twins(shape);
        let body = body_of(&blueprint);
        let water = Water { density: None, drag, slip: slip * drag };
        let hull = hull(&blueprint.parts()[0], &water);
        let direction = [libm::cosf(angle), libm::sinf(angle)];
        let energy = |([vx, vy], spin): ([f32; 2], f32)| {
            let [mass, inertia] = [body.parts[0].mass, body.parts[0].inertia].map(f64::from);
            let [vx, vy, spin] = [vx, vy, spin].map(f64::from);
            0.5 * mass * (vx * vx + vy * vy) + 0.5 * inertia * spin * spin
        };
        let left = hull.slowed((velocity, spin), direction, seconds);
        prop_assert!(energy(left) <= energy((velocity, spin)) * (1.0 + 1e-6));
        let ([x, y], _) = hull.slowed((velocity, 0.0), direction, seconds);
        prop_assert!(x * velocity[0] + y * velocity[1] >= 0.0);
        let (_, left) = hull.slowed(([0.0; 2], spin), direction, seconds);
        prop_assert!((0.0..=1.0 + 1e-6).contains(&(left / spin)) || spin == 0.0);
    }
}

#[test]
fn drag_is_square_in_the_speed_and_larger_across_than_along() {
    let (water, seconds) = (Water { density: None, drag: 1.2, slip: 0.1 }, 1e-4);
    let lost = |shape, velocity: [f32; 2]| {
        let ([x, y], _) = hull(&twins(shape).parts()[0], &water).slowed((velocity, 0.0), [1.0, 0.0], seconds);
        [(velocity[0] - x) / seconds, (velocity[1] - y) / seconds]
    };
    let near = |found: f32, wanted: f32| assert!((found - wanted).abs() < 0.01 * wanted, "{found}, not {wanted}");
    // Half the drag coefficient over the breadth times the square of the speed; a tenth as broad as long.
    let rod = Shape::Box { width: 1.0, height: 0.1 };
    near(lost(rod, [0.0, 2.0])[1], 0.5 * 1.2 / 0.1 * 4.0);
    near(lost(rod, [2.0, 0.0])[0], 0.5 * (0.1 + 1.1 * 0.01) / 0.1 * 4.0);
    let upright = Shape::Box { width: 0.1, height: 1.0 };
    near(lost(upright, [2.0, 0.0])[0], 0.5 * 1.2 / 0.1 * 4.0);
    // A disc is resisted alike whichever way it goes.
    let disc = Shape::Circle { radius: 0.2 };
    let [x, y] = lost(disc, [1.2, 1.6]);
    near(libm::hypotf(x, y), lost(disc, [2.0, 0.0])[0]);
    near(lost(disc, [2.0, 0.0])[0], 0.5 * 1.2 * 0.4 / (0.04 * std::f32::consts::PI) * 4.0);
}

#[test]
fn drag_opposes_spin_and_a_turned_part_feels_what_it_would_feel_unturned() {
    let blueprint = twins(Shape::Capsule { length: 0.4, radius: 0.05 });
    let hull = hull(&blueprint.parts()[0], &Water::default());
    let (_, spin) = hull.slowed(([0.0; 2], 10.0), [1.0, 0.0], 0.02);
    assert!(spin > 0.0 && spin < 9.0, "{spin}");
    let ([x, y], spin) = hull.slowed(([1.0, 2.0], 3.0), [1.0, 0.0], 0.02);
    let (sin, cos) = libm::sincosf(FRAC_PI_2);
    let ([turned_x, turned_y], turned_spin) = hull.slowed(([-2.0, 1.0], 3.0), [cos, sin], 0.02);
    for (one, other) in [(x, turned_y), (y, -turned_x), (spin, turned_spin)] {
        assert!((one - other).abs() < 1e-5, "{one}, {other}");
    }
}

#[test]
fn water_out_of_range_is_named() {
    let said = |water: Water| water.validate().expect_err("must be refused").to_string();
    let ours = Water::default();
    assert_eq!(ours.validate(), Ok(()));
    assert_eq!(said(Water { density: Some(0.0), ..ours }), "density = 0: must be from 0.01 to 100000");
    assert_eq!(said(Water { drag: 11.0, ..ours }), "drag = 11: must be from 0 to 10");
    assert_eq!(said(Water { slip: 1.5, ..ours }), "slip = 1.5: must be from 0 to drag, which is 1");
    assert_eq!(said(Water { slip: f32::NAN, ..ours }), "slip = NaN: must be from 0 to drag, which is 1");
    let settings = PhysicsSettings { water: Some(Water { drag: -1.0, ..ours }), ..PhysicsSettings::default() };
    assert_eq!(settings.validate().expect_err("must be refused").to_string(), "water.drag = -1: must be from 0 to 10");
}

#[test]
fn settings_without_water_are_written_as_before_there_was_any() {
    let text = serde_json::to_string(&PhysicsSettings::default()).expect("plain data");
    assert!(!text.contains("water"), "{text}");
    let wet = PhysicsSettings { water: Some(Water::default()), ..PhysicsSettings::default() };
    let text = serde_json::to_string(&wet).expect("plain data");
    assert!(text.contains(r#""water":{"drag":1.0,"slip":0.05}"#), "{text}");
    assert_eq!(serde_json::from_str::<PhysicsSettings>(&text).expect("as written"), wet);
}

#[test]
fn water_has_no_terrain() {
    let blueprint = Blueprint::new(creatures::find("tetrapod-2").expect("shipped")).expect("valid");
    let sensors = blueprint.creature().sensors.clone();
    let settings = PhysicsSettings { water: Some(Water::default()), ..PhysicsSettings::default() };
    let terrain = TERRAINS.iter().find(|entry| entry.name == "gaps").expect("a terrain").terrain();
    let built: Result<CreatureEnvironment<Puppet>, EnvironmentError> =
        CreatureEnvironment::on_terrain(blueprint, &sensors, 3.0, settings, Variation::default(), terrain);
    let said = built.err().expect("must be refused").to_string();
    assert_eq!(said, "physics.water = water: must be null on ground that is not flat: water has no ground");
}
