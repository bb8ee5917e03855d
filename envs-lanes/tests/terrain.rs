//! Ground made of several shapes: the lanes against rapier, to the bit.

use creatures::{Blueprint, Creature, DrawnObstacle, Sensor, Shape, TERRAINS, Terrain};
use envs_core::{Conditions, Engine, Ground, GroundShape, PhysicsSettings, Variation};
use envs_lanes::{LaneEngine, LaneEnvironment, LaneEpisode};
use envs_rapier::{RapierEnvironment, RapierWorld};
use ne_core::{Phenotype, Purpose, Seed, Task};
use ne_net::{DenseNet, DenseShape};
use rand::RngExt;
use tasks::{Combine, Environment, Episode, PartState, Running, Trials};

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
    let rapier = RapierEnvironment::on_ground(a, &sensors, 3.0, settings, variation, on_a).expect("rapier takes it");
    let lanes = LaneEnvironment::on_ground(b, &sensors, 3.0, settings, variation, on_b).expect("lanes take it");
    follow(rapier, lanes, seed, steps, |x| x.abs() > 1.4)
}

/// Plays both with the same motor program and compares the bits. Whether a part touched the ground where it is uneven.
fn follow(
    mut rapier: RapierEnvironment,
    mut lanes: LaneEnvironment,
    seed: u64,
    steps: u32,
    uneven: impl Fn(f32) -> bool,
) -> bool {
    let kinds: Vec<_> = rapier.terrain().obstacles.iter().map(|obstacles| obstacles.kind().name()).collect();
    let name = format!("{} {kinds:?}", rapier.blueprint().name());
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
        reached |= rapier.snapshot().parts.iter().any(|part| part.touching && uneven(part.x));
    }
    reached
}

/// A point that leaves the ground so fast that it is out of reach after a step is not solved, and keeps in rapier the impulse of
/// the step before: it must not be taken for one that presses. (Seed 651 has such a point at step 93.)
#[test]
fn a_limb_that_is_torn_off_the_ground_presses_no_more_in_either_engine() {
    let blueprint = Blueprint::new(creatures::find("tetrapod-2").expect("shipped")).expect("valid");
    let (settings, conditions) = (PhysicsSettings::default(), Conditions::reference(blueprint.hinges().len()));
    for seed in 600..700 {
        let mut rapier = RapierWorld::new(&blueprint, &settings, &gap(), &conditions).expect("rapier takes it");
        let mut lanes = LaneEngine::new(&blueprint, &settings, &gap(), &conditions).expect("lanes take it");
        let mut stream = Seed::of_run(seed).stream(Purpose::new("nudges"));
        let mut draw = |least: f32, greatest: f32| least + (greatest - least) * stream.random::<f32>();
        let mut places = [vec![PartState::default(); blueprint.parts().len()], Vec::new()];
        places[1] = places[0].clone();
        for step in 0..300 {
            rapier.look(&mut places[0]);
            lanes.look(&mut places[1]);
            assert_eq!(places[0], places[1], "seed {seed}, step {step}");
            if step % 3 == 0 {
                let (part, up, spin) = (draw(0.0, 8.99) as usize, draw(-8.0, 8.0), draw(-20.0, 20.0));
                rapier.nudge(part, [0.0, up], spin);
                lanes.nudge(part, [0.0, up], spin);
            }
            assert_eq!(rapier.step(), lanes.step(), "seed {seed}, step {step}");
        }
    }
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

/// A terrain whose obstacles begin right before the creature and are close together.
fn crowded(name: &str) -> Terrain {
    let terrain = TERRAINS.iter().find(|entry| entry.name == name).expect("a terrain").terrain();
    Terrain { run_up: Some(0.1), length: 12.0, seed: 3, ..terrain.with_difficulty(0.35) }
}

/// All that can be drawn, some side by side.
fn drawn() -> Terrain {
    let drawn = vec![
        DrawnObstacle::Box { from: 0.1, width: 0.5, height: 0.06 },
        DrawnObstacle::Slope { from: 0.6, width: 1.0, rise: 0.2 },
        DrawnObstacle::Slope { from: 1.6, width: 0.5, rise: -0.3 },
        DrawnObstacle::Gap { from: 2.1, width: 0.3 },
        DrawnObstacle::Box { from: 2.4, width: 0.3, height: 0.05 },
        DrawnObstacle::Box { from: 2.7, width: 0.3, height: 0.1 },
    ];
    Terrain { drawn, ..Terrain::default() }
}

fn sensors(blueprint: &Blueprint) -> Vec<Sensor> {
    let mut sensors = vec![
        Sensor::TorsoHeight,
        Sensor::HeightAboveGround,
        Sensor::NextGap { length: 3.0 },
        Sensor::Rangefinder { angles: vec![-90.0, -60.0, -20.0, 0.0, 30.0, -150.0], length: 3.0 },
    ];
    if !blueprint.feet().is_empty() {
        sensors.extend([Sensor::FootContacts, Sensor::FootSlip]);
    }
    sensors
}

/// Tetrapod-2 with other shapes in place of some of its boxes.
fn rounded(shape: impl Fn([f32; 2]) -> Shape) -> Creature {
    let mut creature = creatures::find("tetrapod-2").expect("shipped");
    creature.name = "rounded".into();
    for part in creature.parts.iter_mut().skip(1).step_by(2) {
        let Shape::Box { width, height } = part.shape else { continue };
        part.shape = shape([width, height]);
    }
    creature
}

fn both_on(blueprint: &Blueprint, terrain: &Terrain, variation: Variation) -> (RapierEnvironment, LaneEnvironment) {
    let (sensors, settings) = (sensors(blueprint), PhysicsSettings::default());
    let [one, other] = [(); 2].map(|()| (blueprint.clone(), terrain.clone()));
    let rapier = RapierEnvironment::on_terrain(one.0, &sensors, 3.0, settings, variation, one.1);
    let lanes = LaneEnvironment::on_terrain(other.0, &sensors, 3.0, settings, variation, other.1);
    (rapier.expect("rapier takes it"), lanes.expect("lanes take it"))
}

#[test]
fn creatures_move_on_every_terrain_as_in_rapier() {
    let named = |name: &str| creatures::find(name).expect("shipped");
    let discs = rounded(|[width, height]| Shape::Circle { radius: 0.25 * (width + height) });
    let everyone = [named("tetrapod-2"), named("apod"), discs].map(|one| Blueprint::new(one).expect("valid"));
    let named = TERRAINS.iter().map(|entry| (entry.name, crowded(entry.name)));
    for (name, terrain) in named.chain([("drawn", drawn())]) {
        let reached = everyone.iter().filter(|blueprint| {
            let front = blueprint.bounding_box()[2];
            (1..=4)
                .filter(|&seed| {
                    // The terrain's own seed, and one for each trial.
                    let variation = Variation { terrain: seed % 2 == 0, ..Variation::light() };
                    let (rapier, lanes) = both_on(blueprint, &terrain, variation);
                    follow(rapier, lanes, seed, 400, |x| x > front + 0.1)
                })
                .count()
                > 0
        });
        let reached = reached.count();
        assert!(reached >= 2, "{name}: {reached} of 3 touched the first obstacle");
    }
}

/// Many at once, each trial on a terrain of its own.
#[test]
fn a_population_on_a_terrain_scores_as_in_rapier() {
    let blueprint = Blueprint::new(creatures::find("tetrapod-2").expect("shipped")).expect("valid");
    let variation = Variation { terrain: true, ..Variation::light() };
    let (rapier, lanes) = both_on(&blueprint, &crowded("mixture"), variation);
    let trials = Trials { count: 2, combine: Combine::Mean, lessons: false };
    let one_by_one = Episode::new(rapier, Box::new(Running::default()), 150, trials).expect("valid");
    let at_once = LaneEpisode::new(lanes, Box::new(Running::default()), 150, trials).expect("valid");
    let shape = DenseShape::new(one_by_one.inputs(), vec![6], one_by_one.outputs());
    let mut stream = Seed::of_run(5).stream(Purpose::new("weights"));
    let mut net = || {
        let weights: Vec<f32> = (0..shape.weight_count()).map(|_| stream.random::<f32>() * 4.0 - 2.0).collect();
        DenseNet::new(shape.clone(), &weights).expect("valid")
    };
    let mut nets: Vec<DenseNet> = (0..20).map(|_| net()).collect();
    let mut again = nets.clone();
    let mut batch: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
    let found = at_once.evaluate_batch(&mut batch, Seed::of_run(1));
    let wanted: Vec<_> = again.iter_mut().map(|net| one_by_one.evaluate(net, Seed::of_run(1))).collect();
    assert_eq!(found, wanted);
}

#[test]
fn each_trial_has_a_terrain_of_its_own_if_it_may_vary() {
    let blueprint = Blueprint::new(creatures::find("tetrapod-2").expect("shipped")).expect("valid");
    for (terrain, others) in [(false, false), (true, true)] {
        let variation = Variation { terrain, ..Variation::light() };
        let (rapier, lanes) = both_on(&blueprint, &crowded("gaps"), variation);
        let [first, second] = [0, 1].map(|trial| Seed::of_run(1).trial(trial));
        assert_eq!(rapier.landscape_of(first), lanes.landscape_of(first));
        assert_eq!(rapier.landscape_of(first) != rapier.landscape_of(second), others);
        assert_eq!(*rapier.landscape_of(first) != *rapier.landscape(), others);
    }
}

/// Where a capsule meets a box depends on how long the two have been close: lanes cannot know that.
#[test]
fn capsules_on_boxes_are_left_to_rapier() {
    let capsules = rounded(|[width, height]| Shape::Capsule { length: height, radius: 0.5 * width });
    let blueprint = Blueprint::new(capsules).expect("valid");
    let (sensors, settings) = (sensors(&blueprint), PhysicsSettings::default());
    let build = |terrain: Terrain| {
        LaneEnvironment::on_terrain(blueprint.clone(), &sensors, 3.0, settings, Variation::default(), terrain)
    };
    let said = build(crowded("gaps")).err().expect("lanes refuse it").to_string();
    let name = &blueprint.parts()[1].name;
    let wanted =
        format!("lanes cannot simulate this creature: \"{name}\" is a capsule, and the ground is made of boxes");
    assert_eq!(said, wanted);
    assert!(build(Terrain::default()).is_ok(), "flat ground is no box");
    let rapier =
        RapierEnvironment::on_terrain(blueprint, &sensors, 3.0, settings, Variation::default(), crowded("gaps"));
    assert!(rapier.is_ok());
}
