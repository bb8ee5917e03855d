use super::{BenchmarkTask, Entrant};
use gambol_runs::strategies::{AnyStrategy, StrategyCatalogue, StrategyError};
use ne_core::{Evaluation, Genome, Seed, Strategy, Task};
use ne_net::Network;
use rayon::prelude::*;
use serde::Serialize;
use std::time::Instant;
use tasks::{Benchmark, DoublePole};

/// What one run came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Attempt {
    /// The run's seed.
    pub seed: u64,
    /// Evaluations up to and including that of the first solution, in the order the strategy asked; those of the whole
    /// attempt if there was none.
    pub evaluations: u64,
    /// Whether there was a solution.
    pub solved: bool,
    /// Hidden neurons of the solution.
    pub hidden: Option<usize>,
    /// Connections of the solution, biases included.
    pub connections: Option<usize>,
    /// Wall clock; the one number that differs between equal attempts.
    pub seconds: f64,
    /// From how many of 625 starts the solution holds two poles for 1,000 decisions.
    pub generalization: Option<u32>,
}

/// The runs of a entrant on a task.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// The strategy's name.
    pub strategy: String,
    /// The task.
    pub task: BenchmarkTask,
    /// Settings and net, in words.
    pub description: String,
    /// One for each seed.
    pub attempts: Vec<Attempt>,
}

/// Lets a entrant try a task with the seeds from 1 to `seeds`, spread over all cores. The result is the same on any
/// number of cores.
///
/// # Errors
/// If a setting of the entrant is out of range.
pub fn measure(entrant: &Entrant, seeds: u64) -> Result<Measured, StrategyError> {
    let strategies = StrategyCatalogue::default();
    let attempts = (1..=seeds).into_par_iter().map(|seed| attempt(entrant, &strategies, seed));
    let attempts = attempts.collect::<Result<_, _>>()?;
    let (strategy, description) = (entrant.settings.name().to_owned(), entrant.description.to_owned());
    Ok(Measured { strategy, task: entrant.task, description, attempts })
}

impl Measured {
    /// The evaluations of all attempts, in order of size.
    pub fn evaluations(&self) -> Vec<u64> {
        let mut evaluations: Vec<u64> = self.attempts.iter().map(|attempt| attempt.evaluations).collect();
        evaluations.sort_unstable();
        evaluations
    }

    /// How many attempts found a solution.
    pub fn solved(&self) -> usize {
        self.attempts.iter().filter(|attempt| attempt.solved).count()
    }
}

/// Tries a task with one seed.
fn attempt(entrant: &Entrant, strategies: &StrategyCatalogue, seed: u64) -> Result<Attempt, StrategyError> {
    let &Entrant { task, ref settings, ref topology, output_range, bias_input, .. } = entrant;
    let benchmark = task.task(output_range, bias_input)?;
    let poles = task.poles(output_range, bias_input)?;
    let strategy = strategies.build(settings, topology)?;
    let began = Instant::now();
    let (evaluations, solution) = match task {
        BenchmarkTask::GeneralTwoPoles => solve_generally(strategy, &poles, Seed::of_run(seed), task.limit()),
        _ => solve(strategy, benchmark.as_ref(), Seed::of_run(seed), task.limit()),
    };
    let seconds = began.elapsed().as_secs_f64();
    let (hidden, connections) = solution.as_ref().map(size).unzip();
    let solved = solution.is_some();
    let has_starts = matches!(task, BenchmarkTask::TwoPolesWithoutVelocities | BenchmarkTask::GeneralTwoPoles);
    let generalization = solution
        .filter(|_| has_starts)
        .and_then(|mut solution| poles.generalization(&mut solution).ok())
        .map(|starts| starts.held);
    Ok(Attempt { seed, evaluations, solved, hidden, connections, seconds, generalization })
}

/// Searches until an individual solves the task or so many evaluations are used up. Individuals are evaluated one after
/// the other; as soon as one solves the task, no other is evaluated.
fn solve(mut strategy: AnyStrategy, task: &dyn Benchmark, seed: Seed, limit: u64) -> (u64, Option<Network>) {
    let mut used = 0;
    for generation in 1.. {
        let seed = seed.generation(generation);
        let mut evaluations = Vec::new();
        for genome in strategy.ask(seed) {
            if used >= limit {
                return (used, None);
            }
            let mut phenotype = genome.express();
            let evaluation = task.evaluate(&mut phenotype, seed);
            used += 1;
            if task.is_candidate(&evaluation) && task.is_solved(&mut phenotype, &evaluation) {
                return (used, Some(phenotype));
            }
            evaluations.push(evaluation);
        }
        strategy.tell(&evaluations, seed);
    }
    (used, None)
}

/// As [`solve`], but generation by generation: only the best of each is tried, and it has to hold from other starts too.
fn solve_generally(mut strategy: AnyStrategy, task: &DoublePole, seed: Seed, limit: u64) -> (u64, Option<Network>) {
    let mut used = 0;
    for generation in 1.. {
        let seed = seed.generation(generation);
        let genomes = strategy.ask(seed);
        let evaluations: Vec<Evaluation> =
            genomes.iter().map(|genome| task.evaluate(&mut genome.express(), seed)).collect();
        used += evaluations.len() as u64;
        let ranked = genomes.iter().zip(&evaluations).rev();
        // Reversed, since of equals `max_by_key` takes the last.
        if let Some((genome, evaluation)) = ranked.max_by_key(|(_, evaluation)| evaluation.fitness()) {
            let mut phenotype = genome.express();
            if task.is_candidate(evaluation)
                && task.is_solved(&mut phenotype, evaluation)
                && task.generalization(&mut phenotype).is_ok_and(|starts| starts.is_general())
            {
                return (used, Some(phenotype));
            }
        }
        strategy.tell(&evaluations, seed);
        if used >= limit {
            break;
        }
    }
    (used, None)
}

/// Hidden neurons and weights.
fn size(network: &Network) -> (usize, usize) {
    (network.view().hidden_count(), network.weights().len())
}

#[cfg(test)]
mod tests {
    use super::{super::entrants, *};

    /// The genetic algorithm with its population of 50, and its task.
    fn genetic_algorithm(task: BenchmarkTask) -> (AnyStrategy, Entrant) {
        let is_it = |one: &Entrant| one.task == task && one.settings.name() == "conventional";
        let entrant = entrants().into_iter().find(is_it).expect("it takes part in every task");
        let built = StrategyCatalogue::default().build(&entrant.settings, &entrant.topology);
        (built.expect("valid settings"), entrant)
    }

    #[test]
    fn an_attempt_without_a_solution_ends_at_its_limit() {
        let (strategy, Entrant { task, output_range, bias_input, .. }) = genetic_algorithm(BenchmarkTask::TwoPoles);
        let task = task.task(output_range, bias_input).expect("valid settings");
        let (used, solution) = solve(strategy, task.as_ref(), Seed::of_run(1), 120);
        assert_eq!((used, solution), (120, None), "in the middle of the third generation");
    }

    #[test]
    fn general_solutions_are_looked_for_generation_by_generation() {
        let (strategy, Entrant { task, output_range, bias_input, .. }) =
            genetic_algorithm(BenchmarkTask::GeneralTwoPoles);
        let poles = task.poles(output_range, bias_input).expect("valid settings");
        let (used, solution) = solve_generally(strategy, &poles, Seed::of_run(1), 120);
        assert_eq!((used, solution), (150, None), "the third generation is finished");
    }

    #[test]
    fn evaluations_are_counted_up_to_the_first_solver() {
        let is_it = |one: &&Entrant| one.task == BenchmarkTask::OnePole && one.settings.name() == "conventional";
        let entrants = entrants();
        let measured = measure(entrants.iter().find(is_it).expect("it takes part"), 4).expect("valid settings");
        assert_eq!(measured.solved(), 4);
        assert!(measured.evaluations().iter().any(|evaluations| evaluations % 50 > 0), "{:?}", measured.evaluations());
    }
}
