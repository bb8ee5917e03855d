use super::{BenchmarkTask, Entrant};
use gambol_runs::config::StrategySettings;
use gambol_runs::strategies::{AnyStrategy, StrategyCatalogue, StrategyError};
use ne_core::{Evaluation, Genome, Seed, Strategy};
use ne_net::Network;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Map, Value};
use std::{ops::Range, time::Instant};
use tasks::Benchmark;

/// Which candidates are put to the test that is not counted, where a task [has one](BenchmarkTask::has_uncounted_test).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Counting {
    /// Every candidate, as soon as it was evaluated; evaluations count up to and including its own. Millions of decisions
    /// that are not counted.
    EveryCandidate,
    /// The best of each generation alone, as papers have it; evaluations count up to the end of its generation.
    BestOfGeneration,
}

/// What one run came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Attempt {
    /// The run's seed.
    pub seed: u64,
    /// Evaluations up to the first solution, as the [`Counting`] has it; those of the whole attempt if there was none.
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
    /// Which candidates are tested.
    pub counting: Counting,
    /// Settings and net, in words.
    pub description: String,
    /// The settings that are not the strategy's defaults.
    pub settings: Map<String, Value>,
    /// One for each seed.
    pub attempts: Vec<Attempt>,
}

/// Lets a entrant try a task with these seeds, spread over all cores. The result is the same on any number of cores.
///
/// # Errors
/// If a setting of the entrant is out of range.
pub fn measure(entrant: &Entrant, counting: Counting, seeds: Range<u64>) -> Result<Measured, StrategyError> {
    let strategies = StrategyCatalogue::default();
    let attempts = seeds.into_par_iter().map(|seed| attempt(entrant, counting, &strategies, seed));
    let attempts = attempts.collect::<Result<_, _>>()?;
    let (strategy, description) = (entrant.settings.name().to_owned(), entrant.description.to_owned());
    let settings = changed(&entrant.settings, &strategies);
    Ok(Measured { strategy, task: entrant.task, counting, description, settings, attempts })
}

/// The settings that are not the defaults.
fn changed(settings: &StrategySettings, strategies: &StrategyCatalogue) -> Map<String, Value> {
    let defaults = strategies.find(settings.name()).map(|entry| entry.settings());
    let is_default = |key: &str, value: &Value| defaults.as_ref().and_then(|it| it.settings().get(key)) == Some(value);
    let settings = settings.settings().iter();
    settings.filter(|(key, value)| !is_default(key, value)).map(|(key, value)| (key.clone(), value.clone())).collect()
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
fn attempt(
    entrant: &Entrant,
    counting: Counting,
    strategies: &StrategyCatalogue,
    seed: u64,
) -> Result<Attempt, StrategyError> {
    let &Entrant { task, ref settings, ref topology, output_range, bias_input, .. } = entrant;
    let benchmark = task.task(output_range, bias_input)?;
    let poles = task.poles(output_range, bias_input)?;
    let strategy = strategies.build(settings, topology)?;
    let began = Instant::now();
    let solve = match counting {
        Counting::EveryCandidate => solve,
        Counting::BestOfGeneration => solve_by_generations,
    };
    let is_general = |net: &mut Network| poles.generalization(net).is_ok_and(|starts| starts.is_general());
    let (evaluations, solution) = match task {
        BenchmarkTask::GeneralTwoPoles => solve(strategy, benchmark.as_ref(), &is_general, seed, task.limit()),
        _ => solve(strategy, benchmark.as_ref(), &|_| true, seed, task.limit()),
    };
    let seconds = began.elapsed().as_secs_f64();
    let (hidden, connections) = solution.as_ref().map(size).unzip();
    let solved = solution.is_some();
    let generalization = solution
        .filter(|_| task.has_uncounted_test())
        .and_then(|mut solution| poles.generalization(&mut solution).ok())
        .map(|starts| starts.held);
    Ok(Attempt { seed, evaluations, solved, hidden, connections, seconds, generalization })
}

/// Searches until an individual solves the task or so many evaluations are used up. Individuals are evaluated one after
/// the other; as soon as one solves the task, and `is_enough` of a solution, no other is evaluated.
fn solve(
    mut strategy: AnyStrategy,
    task: &dyn Benchmark,
    is_enough: &dyn Fn(&mut Network) -> bool,
    seed: u64,
    limit: u64,
) -> (u64, Option<Network>) {
    let mut used = 0;
    for generation in 1.. {
        let seed = Seed::of_run(seed).generation(generation);
        let mut evaluations = Vec::new();
        for genome in strategy.ask(seed) {
            if used >= limit {
                return (used, None);
            }
            let mut phenotype = genome.express();
            let evaluation = task.evaluate(&mut phenotype, seed);
            used += 1;
            if task.is_candidate(&evaluation)
                && task.is_solved(&mut phenotype, &evaluation)
                && is_enough(&mut phenotype)
            {
                return (used, Some(phenotype));
            }
            evaluations.push(evaluation);
        }
        strategy.tell(&evaluations, seed);
    }
    (used, None)
}

/// As [`solve`], but generation by generation: only the best of each is tried.
fn solve_by_generations(
    mut strategy: AnyStrategy,
    task: &dyn Benchmark,
    is_enough: &dyn Fn(&mut Network) -> bool,
    seed: u64,
    limit: u64,
) -> (u64, Option<Network>) {
    let mut used = 0;
    for generation in 1.. {
        let seed = Seed::of_run(seed).generation(generation);
        let genomes = strategy.ask(seed);
        let evaluations: Vec<Evaluation> =
            genomes.iter().map(|genome| task.evaluate(&mut genome.express(), seed)).collect();
        used += evaluations.len() as u64;
        let ranked = genomes.iter().zip(&evaluations).rev();
        // Reversed, since of equals `max_by_key` takes the last.
        if let Some((genome, evaluation)) = ranked.max_by_key(|(_, evaluation)| evaluation.fitness()) {
            let mut phenotype = genome.express();
            if task.is_candidate(evaluation) && task.is_solved(&mut phenotype, evaluation) && is_enough(&mut phenotype)
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
        let (used, solution) = solve(strategy, task.as_ref(), &|_| true, 1, 120);
        assert_eq!((used, solution), (120, None), "in the middle of the third generation");
    }

    #[test]
    fn the_best_are_looked_for_generation_by_generation() {
        let (strategy, Entrant { task, output_range, bias_input, .. }) =
            genetic_algorithm(BenchmarkTask::GeneralTwoPoles);
        let task = task.task(output_range, bias_input).expect("valid settings");
        let (used, solution) = solve_by_generations(strategy, task.as_ref(), &|_| true, 1, 120);
        assert_eq!((used, solution), (150, None), "the third generation is finished");
    }

    #[test]
    fn evaluations_are_counted_up_to_the_first_solver() {
        let is_it = |one: &&Entrant| one.task == BenchmarkTask::OnePole && one.settings.name() == "conventional";
        let entrants = entrants();
        let measured = measure(entrants.iter().find(is_it).expect("it takes part"), Counting::EveryCandidate, 1..5)
            .expect("valid settings");
        assert_eq!(measured.solved(), 4);
        assert!(measured.evaluations().iter().any(|evaluations| evaluations % 50 > 0), "{:?}", measured.evaluations());
        assert_eq!(measured.settings.keys().collect::<Vec<_>>(), ["mutation"], "what is not its default");
    }

    #[test]
    fn with_the_best_alone_tested_whole_generations_are_counted() {
        let is_it = |one: &&Entrant| one.task == BenchmarkTask::OnePole && one.settings.name() == "conventional";
        let entrants = entrants();
        let entrant = entrants.iter().find(is_it).expect("it takes part");
        let measured = |counting| measure(entrant, counting, 1001..1005).expect("valid settings").evaluations();
        let (every, best) = (measured(Counting::EveryCandidate), measured(Counting::BestOfGeneration));
        assert!(best.iter().all(|evaluations| evaluations % 50 == 0), "{best:?}");
        assert!(every.iter().zip(&best).all(|(every, best)| every <= best), "{every:?} {best:?}");
    }
}
