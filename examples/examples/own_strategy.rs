//! A search of one's own, simulated annealing, gets what the built-in strategies get: run folders, checkpoints, champions
//! that can be verified, and a place in a comparison with the others.
//!
//! Source: Kirkpatrick, Gelatt & Vecchi, *Optimization by Simulated Annealing*, Science 220, 1983.
//!
//! Run it: `cargo run --release -p gambol-examples --example own_strategy`

use gambol::{
    Registry,
    compare::{ComparisonFolder, Method, Part, PlanRequest, WorkOptions, table, work, write_outcome},
    strategies::{NetStrategy, weights_of},
};
use ne_core::{
    Evaluation, Fitness, Purpose, Seed, SettingError, StopConditions, Strategy, conformance::check_strategy,
};
use ne_fixed::WeightVector;
use ne_net::{DenseShape, Topology};
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::error::Error;

/// What a configuration says of it: `{"annealing": {"population": 30, "cooling": 0.9}}`.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Settings {
    /// Neighbours a generation, from 1 to 10000.
    population: usize,
    /// What the temperature is multiplied by each generation, from 0.5 to 1.
    cooling: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { population: 20, cooling: 0.95 }
    }
}

/// Some neighbours a generation; a worse one is accepted too, the more rarely the worse it is and the colder it gets.
#[derive(Clone, Serialize, Deserialize)]
struct Annealing {
    settings: Settings,
    current: WeightVector,
    fitness: Option<Fitness>,
    temperature: f64,
    neighbours: Vec<WeightVector>,
}

impl NetStrategy for Annealing {
    const NAME: &'static str = "annealing";
    type Settings = Settings;

    fn build(settings: &Settings, topology: &Topology) -> Result<Self, SettingError> {
        SettingError::check_range("population", settings.population as f64, 1.0, 10_000.0)?;
        SettingError::check_range("cooling", settings.cooling, 0.5, 1.0)?;
        let current = WeightVector::new(topology.clone(), vec![0.0; topology.weight_count()], 0.0)
            .map_err(|error| SettingError::new("topology", error, "valid"))?;
        Ok(Self { settings: settings.clone(), current, fitness: None, temperature: 1.0, neighbours: Vec::new() })
    }

    fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The champion of another search is a candidate of this one.
    fn genome(topology: &Topology, weights: &[f32]) -> Option<WeightVector> {
        WeightVector::new(topology.clone(), weights.to_vec(), 0.0).ok()
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl Strategy for Annealing {
    type Genome = WeightVector;
    fn name(&self) -> &str {
        Self::NAME
    }
    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let neighbour = |index| {
            let mut stream = seed.individual(index).stream(Purpose::new("annealing neighbour"));
            let weights = self.current.weights().iter().map(|weight| weight + stream.random_range(-0.5..0.5_f32));
            WeightVector::new(self.current.topology().clone(), weights.collect(), 0.0).expect("as many weights")
        };
        self.neighbours = (0..self.settings.population as u64).map(neighbour).collect();
        &self.neighbours
    }
    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        let mut stream = seed.stream(Purpose::new("annealing acceptance"));
        for (neighbour, evaluation) in self.neighbours.iter().zip(evaluations) {
            let chance: f64 = stream.random();
            let Some(fitness) = evaluation.fitness() else { continue };
            let loss = self.fitness.map_or(0.0, |current| current.get() - fitness.get());
            if loss <= 0.0 || chance < libm::exp(-loss / self.temperature) {
                (self.current, self.fitness) = (neighbour.clone(), Some(fitness));
            }
        }
        self.temperature *= self.settings.cooling;
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let strategy = Annealing::build(&Settings::default(), &DenseShape::new(3, vec![4], 2).into())?;
    check_strategy(|| strategy.clone(), &Default::default())?;

    let mut registry = Registry::default();
    registry.strategies.add::<Annealing>("simulated annealing: a walk that gets ever more careful");
    let request = PlanRequest {
        methods: vec![Method::parse("ga", &registry)?, Method::parse("annealing", &registry)?],
        creatures: vec!["biped-1".into()],
        movements: vec!["running".into()],
        seeds: vec![1, 2, 3],
        budget: StopConditions { evaluations: Some(2000), ..Default::default() },
        set: vec!["movement.steps=200".into()],
        ..PlanRequest::default()
    };
    let plan = request.plan(&registry)?;
    let folder = tempfile::tempdir()?;
    let folder = ComparisonFolder::create(&folder.path().join("comparison"), &plan)?;
    let options = WorkOptions {
        part: Part::ALL,
        at_once: 0,
        threads: 1,
        registry,
        signal: Default::default(),
        on_run: &|progress| println!("{}: {:.2} m", progress.run, progress.best.unwrap_or_default()),
    };
    assert_eq!(work(&folder, &plan, &options)?, 0, "all runs have ended");
    let outcome = write_outcome(&folder)?;
    println!("\n{}", table::render(&outcome));
    let results = folder.results(&plan)?;
    let annealed = results.iter().filter(|result| result.method == "annealing");
    let best = annealed.filter_map(|result| result.points.last()?.best).fold(0.0, f64::max);
    assert!(best > 1.0, "annealing has not taught the biped to run");
    Ok(())
}
