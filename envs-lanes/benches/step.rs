//! µs a creature takes for a step, with senses, controller and measurements: lanes with each instruction set of this
//! processor against rapier, in one run.
//!
//! `cargo bench -p envs-lanes` prints a table and, for each creature, where the time goes.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

use creatures::Blueprint;
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::{Instructions, LaneEnvironment, LaneEpisode};
use envs_rapier::RapierEnvironment;
use ne_core::{Phenotype, Purpose, Seed, Task};
use ne_net::{DenseNet, DenseShape, Network};
use rand::RngExt;
use std::time::Instant;
use tasks::{Environment, Episode, Running, Trials};

const CREATURES: [&str; 7] = ["biped-1", "biped-2", "apod", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];
const STEPS: u32 = 500;

fn main() {
    println!("µs for a creature's step: senses, a net of 10 hidden neurons, physics, measurements");
    print!("{:<12} {:>9}", "creature", "rapier");
    let instructions = Instructions::available();
    for instructions in &instructions {
        print!(" {:>9}", instructions.name());
    }
    println!(" {:>9}", "faster");
    // Cargo passes options of its own; whatever is no option chooses creatures.
    let chosen: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    for name in CREATURES.into_iter().filter(|name| chosen.is_empty() || chosen.iter().any(|chosen| chosen == name)) {
        let blueprint = Blueprint::new(creatures::find(name).expect("shipped")).expect("valid");
        let sensors = blueprint.creature().sensors.clone();
        let (settings, variation) = (PhysicsSettings::default(), Variation::default());
        let rapier =
            RapierEnvironment::new(blueprint.clone(), &sensors, 3.0, settings, variation).expect("rapier takes it");
        let lanes = LaneEnvironment::new(blueprint, &sensors, 3.0, settings, variation).expect("lanes take it");
        let rapier = Episode::new(rapier, Box::new(Running::default()), STEPS, Trials::default()).expect("valid");
        let lanes = LaneEpisode::new(lanes, Box::new(Running::default()), STEPS, Trials::default()).expect("valid");
        let mut nets = nets(rapier.environment().inputs(), rapier.environment().outputs(), 64);
        let reference = time(&rapier, &mut nets[..4]);
        print!("{name:<12} {reference:>9.3}");
        let mut best = f64::INFINITY;
        for &instructions in &instructions {
            let time = time(&lanes.clone().with_instructions(instructions), &mut nets);
            best = best.min(time);
            print!(" {time:>9.3}");
        }
        println!(" {:>8.1}×", reference / best);
        let network = Network::Dense(nets.swap_remove(0));
        let profile = lanes.profile(&network, 2000, Instructions::best()).expect("it stands");
        let alone = alone(rapier.environment().clone());
        let faster = alone / profile.physics();
        println!("  physics alone: rapier {alone:.3} µs, lanes {:.3} µs, {faster:.1}×", profile.physics());
        let whole: f64 = profile.parts().map(|(_, microseconds)| microseconds).sum();
        let shares: Vec<String> = profile
            .parts()
            .map(|(part, microseconds)| format!("{part} {:.0} %", 100.0 * microseconds / whole))
            .collect();
        println!("  {}", shares.join(", "));
    }
}

/// µs a step of rapier takes without sensing and deciding.
fn alone(mut environment: RapierEnvironment) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        environment.reset(Seed::of_run(1)).expect("it stands");
        environment.act(&vec![0.5; environment.outputs()]);
        let start = Instant::now();
        for _ in 0..STEPS {
            environment.step().expect("it lasts");
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e6 / f64::from(STEPS));
    }
    best
}

/// The best of several rounds, µs a step.
fn time(task: &impl Task, nets: &mut [DenseNet]) -> f64 {
    let count = nets.len();
    let mut phenotypes: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        let evaluations = task.evaluate_batch(&mut phenotypes, Seed::of_run(1));
        let steps: u64 = evaluations.iter().map(|evaluation| evaluation.steps).sum();
        assert_eq!(steps, u64::from(STEPS) * count as u64, "every creature lasts");
        best = best.min(start.elapsed().as_secs_f64() * 1e6 / steps as f64);
    }
    best
}

fn nets(inputs: usize, outputs: usize, count: usize) -> Vec<DenseNet> {
    let shape = DenseShape::new(inputs, vec![10], outputs);
    let mut stream = Seed::of_run(1).stream(Purpose::new("weights"));
    let mut net = || {
        let weights: Vec<f32> = (0..shape.weight_count()).map(|_| stream.random::<f32>() * 2.0 - 1.0).collect();
        DenseNet::new(shape.clone(), &weights).expect("valid")
    };
    (0..count).map(|_| net()).collect()
}
