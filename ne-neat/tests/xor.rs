//! The paper's XOR.

use ne_core::{Evaluation, Genome, Phenotype, Seed, Strategy};
use ne_neat::{Neat, NeatGenome, NeatSettings};
use std::time::Instant;

/// The fitness of the paper, and whether every answer is on the right side of one half.
fn exclusive_or(net: &mut impl Phenotype) -> (f64, bool) {
    let (mut error, mut solved) = (0.0, true);
    for (a, b, expected) in [(0.0, 0.0, 0.0), (0.0, 1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 0.0_f32)] {
        let mut output = [0.0];
        net.reset();
        net.activate(&[a, b], &mut output);
        error += f64::from((output[0] - expected).abs());
        solved &= (output[0] > 0.5) == (expected > 0.5);
    }
    ((4.0 - error) * (4.0 - error), solved)
}

struct Solution {
    evaluations: usize,
    genome: NeatGenome,
}

fn solve(settings: &NeatSettings, seed: u64, limit: usize) -> Option<Solution> {
    let mut neat = Neat::new(settings.clone(), 2, 1).expect("valid settings");
    let mut evaluated = 0;
    for generation in 1.. {
        let place = Seed::of_run(seed).generation(generation);
        let population = neat.ask(place);
        let mut evaluations = Vec::with_capacity(population.len());
        for genome in population {
            let (fitness, solved) = exclusive_or(&mut genome.express());
            evaluated += 1;
            if solved {
                return Some(Solution { evaluations: evaluated, genome: genome.clone() });
            }
            if evaluated >= limit {
                return None;
            }
            evaluations.push(Evaluation::new(fitness));
        }
        neat.tell(&evaluations, place);
    }
    None
}

#[test]
fn tune() {
    let seeds: u64 = std::env::var("SEEDS").map_or(100, |t| t.parse().unwrap());
    let first: u64 = std::env::var("FIRST").map_or(1, |t| t.parse().unwrap());
    let text = serde_json::to_value(NeatSettings::stanley_2002()).unwrap();
    let mut text = text;
    if let Ok(sets) = std::env::var("SETS") {
        for set in sets.split(';').filter(|s| !s.is_empty()) {
            let (path, value) = set.split_once('=').unwrap();
            let value: serde_json::Value = serde_json::from_str(value).unwrap();
            *text.pointer_mut(path).unwrap_or_else(|| panic!("{path}")) = value;
        }
    }
    let settings: NeatSettings = serde_json::from_value(text).unwrap();
    settings.validate().unwrap();
    let (mut evals, mut hidden, mut conns, mut times, mut fails) = (vec![], 0, 0, vec![], 0);
    for seed in first..first + seeds {
        let start = Instant::now();
        match solve(&settings, seed, 60_000) {
            Some(s) => {
                evals.push(s.evaluations as f64);
                hidden += s.genome.hidden_count();
                conns += s.genome.enabled_count();
            }
            None => fails += 1,
        }
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    let n = evals.len() as f64;
    let mean = evals.iter().sum::<f64>() / n;
    let sd = (evals.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / n).sqrt();
    println!(
        "fails {fails} mean {mean:.0} sd {sd:.0} max {:.0} hidden {:.2} conns {:.2} median ms {:.2}",
        evals.iter().copied().fold(0.0, f64::max),
        hidden as f64 / n,
        conns as f64 / n,
        times[times.len() / 2]
    );
}
