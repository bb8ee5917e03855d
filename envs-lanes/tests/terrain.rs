//! Ground made of several shapes: the lanes against rapier, to the bit.

use creatures::{Blueprint, Sensor};
use envs_core::{Ground, GroundShape, PhysicsSettings, Variation};
use envs_lanes::LaneEnvironment;
use envs_rapier::RapierEnvironment;
use ne_core::{Purpose, Seed};
use rand::RngExt;
use tasks::Environment;

const SHIPPED: [&str; 7] = ["apod", "biped-1", "biped-2", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];

/// A half-space with a step on either side of the creature.
fn steps() -> Ground {
    let step = |x| GroundShape::Box { x, y: 0.05, width: 2.0, height: 0.1 };
    Ground { shapes: vec![GroundShape::HalfSpace, step(2.4), step(-2.4)] }
}

/// Level ground with a gap in it.
fn gap() -> Ground {
    let side = |x| GroundShape::Box { x, y: -0.5, width: 10.0, height: 1.0 };
    Ground { shapes: vec![side(-4.0), side(6.6)] }
}

/// Level ground with mounds 2 cm high and 0.4 m wide on either side of the creature.
fn mounds() -> Ground {
    let mound = |index: i32| GroundShape::Circle { x: 0.7 * index as f32, y: 0.02 - 1.01, radius: 1.01 };
    Ground {
        shapes: [GroundShape::HalfSpace].into_iter().chain((-8_i32..=8).filter(|x| x.abs() > 1).map(mound)).collect(),
    }
}

fn drive(name: &str, ground: &Ground, seed: u64, steps: u32) -> bool {
    let blueprint = Blueprint::new(creatures::find(name).expect("shipped")).expect("valid");
    let sensors = [Sensor::FootContacts, Sensor::Rangefinder { angles: vec![-60.0, -20.0, 0.0], length: 3.0 }];
    let (settings, variation) = (PhysicsSettings::default(), Variation::light());
    let new = |blueprint: &Blueprint| (blueprint.clone(), ground.clone());
    let ((a, on_a), (b, on_b)) = (new(&blueprint), new(&blueprint));
    let mut rapier =
        RapierEnvironment::on_ground(a, &sensors, 3.0, settings, variation, on_a).expect("rapier takes it");
    let mut lanes = LaneEnvironment::on_ground(b, &sensors, 3.0, settings, variation, on_b).expect("lanes take it");
    let seed = Seed::of_run(seed);
    assert_eq!(rapier.reset(seed), lanes.reset(seed));
    let mut stream = seed.stream(Purpose::new("motor program"));
    let mut outputs = vec![0.0; rapier.outputs()];
    let mut inputs = [vec![0.0; rapier.inputs()], vec![0.0; rapier.inputs()]];
    let mut reached = false;
    for step in 0..steps {
        assert_eq!(rapier.snapshot(), lanes.snapshot(), "{name}, {seed:?}: step {step}");
        rapier.sense(&mut inputs[0]);
        lanes.sense(&mut inputs[1]);
        assert_eq!(inputs[0], inputs[1], "{name}, {seed:?}: inputs after step {step}");
        if step % 12 == 0 {
            outputs.fill_with(|| stream.random::<f32>() * 2.4 - 1.2);
        }
        rapier.act(&outputs);
        lanes.act(&outputs);
        assert_eq!(rapier.step(), lanes.step(), "{name}, {seed:?}: step {step}");
        reached |= rapier.snapshot().parts.iter().any(|part| part.touching && part.x.abs() > 1.4);
    }
    reached
}

#[test]
fn every_shipped_creature_moves_on_steps_as_in_rapier() {
    let reached = SHIPPED.map(|name| (1..=6).filter(|&seed| drive(name, &steps(), seed, 500)).count());
    assert!(reached.into_iter().filter(|&count| count > 0).count() >= 5, "hardly anyone was on a step: {reached:?}");
}

#[test]
fn every_shipped_creature_moves_at_a_gap_as_in_rapier() {
    for name in SHIPPED {
        for seed in 1..=4 {
            drive(name, &gap(), seed, 400);
        }
    }
}

#[test]
fn every_shipped_creature_moves_on_mounds_as_in_rapier() {
    let reached = SHIPPED.map(|name| (1..=4).filter(|&seed| drive(name, &mounds(), seed, 400)).count());
    assert!(reached.into_iter().filter(|&count| count > 0).count() >= 5, "hardly anyone was on a mound: {reached:?}");
}
