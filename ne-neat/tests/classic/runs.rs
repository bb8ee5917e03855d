//! Runs that end with the first solver.

use ne_core::{Genome, Seed, Strategy};
use ne_neat::{Neat, NeatGenome, NeatSettings};
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

/// The mean, 0 of nothing.
pub(crate) fn mean(numbers: impl Iterator<Item = usize>) -> f64 {
    let (sum, count) = numbers.fold((0, 0), |(sum, count), number| (sum + number, count + 1));
    sum as f64 / f64::from(count.max(1))
}
