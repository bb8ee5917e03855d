//! The control: rapier against rapier, started 0.2 µm higher. Chaos makes centimetres of it, so a comparison with rapier
//! can fail, and what lanes differ by is nothing, not just little.

use crate::{
    any_creature::raise,
    stage::{both, shipped},
};
use creatures::Blueprint;
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::LaneEpisode;
use envs_rapier::RapierEnvironment;
use ne_core::{Phenotype, Purpose, Seed, Task};
use ne_net::{DenseNet, DenseShape};
use rand::RngExt;
use tasks::{Environment, Episode, Running, Trials};

const CREATURES: [&str; 4] = ["biped-1", "tetrapod-2", "apod", "decapod-2"];

/// How far apart two engines are.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Apart {
    /// Median over motor programs of the time until the torsos are 2 cm apart, s; 5 if they never are.
    time: f64,
    /// Mean distance of the torsos after 5 s, m.
    distance: f64,
    /// Of the fitness of random genomes.
    correlation: f64,
}

fn higher(blueprint: &Blueprint) -> Blueprint {
    let mut creature = blueprint.creature().clone();
    raise(&mut creature, 2e-7);
    Blueprint::new(creature).expect("valid")
}

/// Time until the torsos are 2 cm apart, s, and their distance after 5 s, m.
fn drift(one: &mut impl Environment, other: &mut impl Environment, program: u64) -> (f64, f64) {
    let seed = Seed::of_run(program);
    one.reset(seed).expect("settles");
    other.reset(seed).expect("settles");
    let mut stream = seed.stream(Purpose::new("motor program"));
    let mut outputs = vec![0.0; one.outputs()];
    let (mut time, mut distance) = (5.0, 0.0);
    for step in 0..250 {
        if step % 10 == 0 {
            outputs.fill_with(|| stream.random::<f32>() * 2.0 - 1.0);
        }
        one.act(&outputs);
        other.act(&outputs);
        one.step().expect("stable");
        other.step().expect("stable");
        let (a, b) = (one.snapshot().torso(), other.snapshot().torso());
        distance = f64::from(a.x - b.x).hypot(f64::from(a.y - b.y));
        if distance > 0.02 && time == 5.0 {
            time = f64::from(step + 1) * 0.02;
        }
    }
    (time, distance)
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let sum = |product: &dyn Fn(f64, f64) -> f64| -> f64 {
        a.iter().zip(b).map(|(a, b)| product(a - mean_a, b - mean_b)).sum()
    };
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

/// Fitness of random genomes, all in one batch.
fn fitness(task: &impl Task, genomes: usize) -> Vec<f64> {
    let shape = DenseShape::new(task.inputs(), vec![10], task.outputs());
    let mut stream = Seed::of_run(5).stream(Purpose::new("weights"));
    let net = |_| {
        let weights: Vec<f32> = (0..shape.weight_count()).map(|_| stream.random::<f32>() * 4.0 - 2.0).collect();
        DenseNet::new(shape.clone(), &weights).expect("valid")
    };
    let mut nets: Vec<DenseNet> = (0..genomes).map(net).collect();
    let mut batch: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
    let evaluations = task.evaluate_batch(&mut batch, Seed::of_run(1));
    evaluations.into_iter().map(|one| f64::from(one.outcome.expect("stable"))).collect()
}

/// The control and the lanes, each against rapier.
fn measure(name: &str, programs: u64, genomes: usize, steps: u32) -> [Apart; 2] {
    let blueprint = shipped(name);
    let sensors = blueprint.creature().sensors.clone();
    let (settings, variation) = (PhysicsSettings::default(), Variation::default());
    let (rapier, lanes) = both(&blueprint, &sensors, settings, variation);
    let control = RapierEnvironment::new(higher(&blueprint), &sensors, 3.0, settings, variation).expect("builds");
    let episode =
        |environment| Episode::new(environment, Box::new(Running::default()), steps, Trials::default()).expect("valid");
    let wanted = fitness(&episode(rapier.clone()), genomes);
    let of_control = fitness(&episode(control.clone()), genomes);
    let task = LaneEpisode::new(lanes.clone(), Box::new(Running::default()), steps, Trials::default());
    let of_lanes = fitness(&task.expect("valid"), genomes);
    assert_eq!(of_lanes, wanted, "{name}: fitness of random genomes");
    let (mut control, mut lanes) = (control, lanes);
    let summary = |mut drifts: Vec<(f64, f64)>, correlation: f64| {
        drifts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let distance = drifts.iter().map(|drift| drift.1).sum::<f64>() / drifts.len() as f64;
        Apart { time: drifts[drifts.len() / 2].0, distance, correlation }
    };
    let of = |other: &mut dyn FnMut(u64) -> (f64, f64)| (0..programs).map(other).collect::<Vec<_>>();
    let control_drifts = of(&mut |program| drift(&mut rapier.clone(), &mut control, program));
    let lane_drifts = of(&mut |program| drift(&mut rapier.clone(), &mut lanes, program));
    [summary(control_drifts, correlation(&of_control, &wanted)), summary(lane_drifts, correlation(&of_lanes, &wanted))]
}

fn check_lanes(name: &str, lanes: Apart) {
    assert_eq!((lanes.time, lanes.distance), (5.0, 0.0), "{name}");
    assert!((lanes.correlation - 1.0).abs() < 1e-12, "{name}: {lanes:?}");
}

#[test]
fn lanes_differ_by_nothing_where_a_fifth_of_a_micrometre_differs() {
    let [control, lanes] = measure("decapod-2", 8, 16, 250);
    check_lanes("decapod-2", lanes);
    assert!(control.distance > 1e-3, "the comparison cannot fail: {control:?}");
}

#[test]
#[ignore = "a minute long: cargo test --release -p envs-lanes --test parity -- --ignored --nocapture control"]
#[expect(clippy::print_stdout, reason = "the table is what it is run for")]
fn control_table() {
    println!("| creature | against rapier | median time to 2 cm, s | mean distance after 5 s, cm | correlation |");
    println!("|---|---|---|---|---|");
    for name in CREATURES {
        let [control, lanes] = measure(name, 40, 150, 1000);
        for (engine, apart) in [("rapier 0.2 µm higher", control), ("lanes", lanes)] {
            let Apart { time, distance, correlation } = apart;
            println!("| {name} | {engine} | {time:.1} | {:.2} | {correlation:.4} |", distance * 100.0);
        }
        check_lanes(name, lanes);
    }
}
