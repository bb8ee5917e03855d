//! A search of one's own: a (1 + 30) evolution strategy over the weights of a net, in ten lines of `ask` and `tell`.
//! It gets what the built-in strategies get: a run folder, checkpoints, a champion that can be verified.
//!
//! Run it: `cargo run --release -p gambol-examples --example own_strategy`

use gambol::{
    Setup,
    config::preset,
    training::{TrainOptions, train_with},
};
use ne_core::{Evaluation, Fitness, Purpose, Seed, Strategy, conformance::check_strategy};
use ne_fixed::WeightVector;
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::{error::Error, sync::Arc};
use tasks::MovementCatalogue;

/// Thirty mutants of the best so far, each weight moved by at most 0.5.
#[derive(Clone, Serialize, Deserialize)]
struct OnePlusThirty {
    parent: WeightVector,
    fitness: Option<Fitness>,
    mutants: Vec<WeightVector>,
}

impl Strategy for OnePlusThirty {
    type Genome = WeightVector;
    fn name(&self) -> &str {
        "one-plus-thirty"
    }
    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let mutant = |index| {
            let mut stream = seed.individual(index).stream(Purpose::new("one-plus-thirty mutation"));
            let weights = self.parent.weights().iter().map(|weight| weight + stream.random_range(-0.5..0.5_f32));
            WeightVector::new(self.parent.topology().clone(), weights.collect(), 0.0).expect("as many weights")
        };
        self.mutants = (0..30).map(mutant).collect();
        &self.mutants
    }
    fn tell(&mut self, evaluations: &[Evaluation], _: Seed) {
        for (mutant, evaluation) in self.mutants.iter().zip(evaluations) {
            if evaluation.fitness() > self.fitness {
                (self.parent, self.fitness) = (mutant.clone(), evaluation.fitness());
            }
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let catalogue = MovementCatalogue::default();
    let mut config =
        preset("default").ok_or("there is a default preset")?.config(creatures::find("biped-1")?, "running");
    config.movement.steps = Some(300);
    config.stop.generations = Some(20);
    let setup = Setup::new(&config, &catalogue)?;
    let weights = vec![0.0; setup.topology.weight_count()];
    let parent = WeightVector::new(setup.topology.clone(), weights, 0.0)?;
    let strategy = OnePlusThirty { parent, fitness: None, mutants: Vec::new() };
    check_strategy(|| strategy.clone(), &Default::default())?;

    let folder = tempfile::tempdir()?;
    let options = TrainOptions {
        threads: 0,
        catalogue: catalogue.clone(),
        signal: Default::default(),
        on_generation: &mut |report| {
            if let Some(best) = report.best_so_far {
                println!("generation {:2}: {best:.2} m", report.generation);
            }
        },
    };
    let outcome = train_with(strategy, &config, &setup, &folder.path().join("run"), options)?;
    let champion = outcome.champion.ok_or("every evaluation failed")?;
    println!("the biped runs {:.2} m in 6 s", champion.fitness);
    assert!(champion.verify(&catalogue)?.is_identical(), "the champion does not repeat itself");
    assert!(champion.fitness.get() > 1.0, "running was not learned");
    Ok(())
}
