//! Runs that end with the first solver.

use ne_core::{Evaluation, Genome, Seed, Strategy};
use ne_neat::{Neat, NeatGenome, NeatSettings};
use ne_net::GraphNet;
use tasks::Benchmark;

/// What the first solver of a run was.
pub(crate) struct Solution {
    /// Evaluations up to and including it.
    pub(crate) evaluations: usize,
    pub(crate) genome: NeatGenome,
}

/// Runs until the task is solved, for at most `limit` evaluations.
pub(crate) fn solve(task: &dyn Benchmark, settings: &NeatSettings, seed: u64, limit: usize) -> Option<Solution> {
    let mut neat = Neat::new(settings.clone(), task.inputs(), task.outputs()).expect("valid settings");
    let mut evaluated = 0;
    for generation in 1.. {
        let place = Seed::of_run(seed).generation(generation);
        let mut evaluations = Vec::new();
        for genome in neat.ask(place) {
            let mut net = genome.express();
            let evaluation = task.evaluate(&mut net, place);
            evaluated += 1;
            if task.is_candidate(&evaluation) && task.is_solved(&mut net, &evaluation) {
                return Some(Solution { evaluations: evaluated, genome: genome.clone() });
            }
            if evaluated == limit {
                return None;
            }
            evaluations.push(evaluation);
        }
        neat.tell(&evaluations, place);
    }
    None
}

/// As [`solve`], but only the best of each generation is tested, as in papers, and it must be enough of a solution;
/// the evaluations are those up to the end of its generation.
pub(crate) fn solve_by_generations(
    task: &dyn Benchmark,
    is_enough: impl Fn(&mut GraphNet) -> bool,
    settings: &NeatSettings,
    seed: u64,
    limit: usize,
) -> Option<usize> {
    let mut neat = Neat::new(settings.clone(), task.inputs(), task.outputs()).expect("valid settings");
    let mut evaluated = 0;
    for generation in 1.. {
        let place = Seed::of_run(seed).generation(generation);
        let genomes = neat.ask(place);
        let evaluations: Vec<Evaluation> =
            genomes.iter().map(|genome| task.evaluate(&mut genome.express(), place)).collect();
        evaluated += evaluations.len();
        // Reversed, since of equals `max_by_key` takes the last.
        let best = genomes.iter().zip(&evaluations).rev().max_by_key(|(_, evaluation)| evaluation.fitness());
        let (genome, evaluation) = best.expect("there are individuals");
        let mut net = genome.express();
        if task.is_candidate(evaluation) && task.is_solved(&mut net, evaluation) && is_enough(&mut net) {
            return Some(evaluated);
        }
        if evaluated >= limit {
            return None;
        }
        neat.tell(&evaluations, place);
    }
    None
}

/// The mean, 0 of nothing.
pub(crate) fn mean(numbers: impl Iterator<Item = usize>) -> f64 {
    let (sum, count) = numbers.fold((0, 0), |(sum, count), number| (sum + number, count + 1));
    sum as f64 / f64::from(count.max(1))
}
