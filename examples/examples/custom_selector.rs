//! A selector of one's own in conventional neuroevolution: Boltzmann selection, checked by the conformance kit.

use ne_core::{
    Evaluation, Evolution, Fitness, Phenotype, RandomStream, Seed, Selector, Serial, StopConditions, Task,
    conformance::check_selector,
};
use ne_fixed::{ConventionalNe, ConventionalNeSettings, GaussianMutation, Initialization, Setting, UniformCrossover};
use ne_net::DenseShape;
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// A parent's chance grows with exp(fitness / temperature), the best fitness counted 0 and the worst -1.
///
/// Source: Goldberg, *A Note on Boltzmann Tournament Selection*, Complex Systems 4, 1990.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Boltzmann {
    temperature: f64,
}

/// By being a setting it can stand in a configuration and is saved with the strategy.
impl Setting for Boltzmann {}

impl Selector for Boltzmann {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        // Halved, so that no difference of huge fitnesses overflows.
        let half = |fitness: &Fitness| fitness.get() / 2.0;
        let best = scores.iter().flatten().map(half).fold(f64::NEG_INFINITY, f64::max);
        let spread = scores.iter().flatten().map(|score| best - half(score)).fold(f64::MIN_POSITIVE, f64::max);
        let all_failed = scores.iter().all(Option::is_none);
        let log_chance = |score: &Option<Fitness>| match score {
            Some(fitness) => (half(fitness) - best) / spread / self.temperature,
            None => {
                if all_failed {
                    0.0
                } else {
                    f64::NEG_INFINITY
                }
            }
        };
        for _ in 0..count {
            // The largest of (log chance + Gumbel noise) is drawn with just that chance, and no sum can round.
            let mut noisy = |score| log_chance(score) - libm::log(-libm::log(stream.random::<f64>()));
            let keys: Vec<f64> = scores.iter().map(&mut noisy).collect();
            chosen.extend((0..keys.len()).max_by(|&a, &b| keys[a].total_cmp(&keys[b])));
        }
    }
}

/// Answer with the square of the input.
struct Square;

impl Task for Square {
    fn inputs(&self) -> usize {
        1
    }
    fn outputs(&self) -> usize {
        1
    }
    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        let mut answer = [0.0];
        let mut error = |input: f32| {
            phenotype.activate(&[input], &mut answer);
            f64::from(answer[0] - input * input).powi(2)
        };
        Evaluation::new(-(-10..=10).map(|step| error(step as f32 * 0.1)).sum::<f64>())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    check_selector(&Boltzmann { temperature: 0.2 }, Seed::of_run(1))?;
    let settings = ConventionalNeSettings {
        selection: Boltzmann { temperature: 0.2 },
        population: 50,
        elites: 1,
        immigrants: 0,
        crossover_rate: 0.5,
        crossover: UniformCrossover {},
        mutation: GaussianMutation { rate: 0.2, deviation: 0.3 },
        initialization: Initialization::Uniform { limit: 1.0 },
        stagnation_boost: None,
    };
    let strategy = ConventionalNe::new(settings, DenseShape::new(1, vec![4], 1))?;
    let stop = StopConditions { generations: Some(200), ..Default::default() };
    let mut evolution = Evolution::new(strategy, Seed::of_run(1), stop);
    evolution.run(&Square, &Serial, &mut [])?;
    let best = evolution.champion().ok_or("every evaluation failed")?.fitness.get();
    println!("squared error {:.4}, summed over 21 points", -best);
    if best > -0.1 { Ok(()) } else { Err("the square was not learned".into()) }
}
