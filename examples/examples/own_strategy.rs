//! A search of one's own, simulated annealing, gets what the built-in strategies get: run folders, checkpoints, champions
//! that can be verified, and a place in a comparison with the others.
//!
//! Source: Kirkpatrick, Gelatt & Vecchi, *Optimization by Simulated Annealing*, Science 220, 1983.
//!
//! Run it: `cargo run --release -p gambol-examples --example own_strategy`

use gambol::compare::{
    ComparisonFolder, ForeignRunner, Method, Part, PlanRequest, Runners, WorkOptions, table, work, write_outcome,
};
use ne_core::{
    Evaluation, Fitness, Purpose, Seed, SettingError, StopConditions, Strategy, conformance::check_strategy,
};
use ne_fixed::WeightVector;
use ne_net::{DenseShape, Topology};
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::error::Error;
use tasks::MovementCatalogue;

/// Twenty neighbours a generation; a worse one is accepted too, the more rarely the worse it is and the colder it gets.
#[derive(Clone, Serialize, Deserialize)]
struct Annealing {
    current: WeightVector,
    fitness: Option<Fitness>,
    temperature: f64,
    neighbours: Vec<WeightVector>,
}

impl Annealing {
    fn new(topology: &Topology) -> Result<Self, SettingError> {
        let current = WeightVector::new(topology.clone(), vec![0.0; topology.weight_count()], 0.0)
            .map_err(|error| SettingError::new("topology", error, "valid"))?;
        Ok(Self { current, fitness: None, temperature: 1.0, neighbours: Vec::new() })
    }
}

impl Strategy for Annealing {
    type Genome = WeightVector;
    fn name(&self) -> &str {
        "annealing"
    }
    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let neighbour = |index| {
            let mut stream = seed.individual(index).stream(Purpose::new("annealing neighbour"));
            let weights = self.current.weights().iter().map(|weight| weight + stream.random_range(-0.5..0.5_f32));
            WeightVector::new(self.current.topology().clone(), weights.collect(), 0.0).expect("as many weights")
        };
        self.neighbours = (0..20).map(neighbour).collect();
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
        self.temperature *= 0.95;
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let strategy = Annealing::new(&DenseShape::new(3, vec![4], 2).into())?;
    check_strategy(|| strategy.clone(), &Default::default())?;

    let catalogue = MovementCatalogue::default();
    let request = PlanRequest {
        methods: vec!["ga".parse::<Method>()?],
        creatures: vec!["biped-1".into()],
        movements: vec!["running".into()],
        seeds: vec![1, 2, 3],
        budget: StopConditions { evaluations: Some(2000), ..Default::default() },
        set: vec!["movement.steps=200".into()],
        ..PlanRequest::default()
    };
    let mut plan = request.plan(&catalogue)?;
    plan.add_foreign("annealing")?;
    let runners = Runners::default().with("annealing", ForeignRunner::new(|setup| Annealing::new(&setup.topology)));
    let folder = tempfile::tempdir()?;
    let folder = ComparisonFolder::create(&folder.path().join("comparison"), &plan)?;
    let options = WorkOptions {
        part: Part::ALL,
        at_once: 0,
        threads: 1,
        catalogue,
        runners: &runners,
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
