use super::{Contestant, Yardstick};
use crate::search::{Search, SearchVisitor};
use ne_core::{Evaluation, Genome, Seed, SettingError, Strategy, Task};
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

/// The runs of a contestant on a task.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// The strategy's name.
    pub strategy: String,
    /// The task.
    pub task: Yardstick,
    /// Settings and net, in words.
    pub description: String,
    /// One for each seed.
    pub attempts: Vec<Attempt>,
}

/// Lets a contestant try a task with the seeds from 1 to `seeds`, spread over all cores. The result is the same on any
/// number of cores.
///
/// # Errors
/// If a setting of the contestant is out of range.
pub fn measure(contestant: &Contestant, seeds: u64) -> Result<Measured, SettingError> {
    let attempt = |seed| contestant.settings.visit(Try { contestant, seed });
    let attempts = (1..=seeds).into_par_iter().map(attempt).collect::<Result<_, _>>()?;
    let (strategy, description) = (contestant.settings.name().to_owned(), contestant.description.to_owned());
    Ok(Measured { strategy, task: contestant.task, description, attempts })
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
struct Try<'a> {
    contestant: &'a Contestant,
    seed: u64,
}

impl SearchVisitor for Try<'_> {
    type Output = Result<Attempt, SettingError>;

    fn visit<S: Search>(self, settings: &S::Settings) -> Self::Output {
        let Self { contestant: &Contestant { task, ref topology, output_range, bias_input, .. }, seed } = self;
        let benchmark = task.task(output_range, bias_input)?;
        let poles = task.poles(output_range, bias_input)?;
        let strategy = S::build(settings, topology)?;
        let began = Instant::now();
        let (evaluations, solution) = match task {
            Yardstick::GeneralTwoPoles => solve_generally(strategy, &poles, Seed::of_run(seed), task.limit()),
            _ => solve(strategy, benchmark.as_ref(), Seed::of_run(seed), task.limit()),
        };
        let seconds = began.elapsed().as_secs_f64();
        let (hidden, connections) = solution.as_ref().map(size).unzip();
        let solved = solution.is_some();
        let has_starts = matches!(task, Yardstick::TwoPolesWithoutVelocities | Yardstick::GeneralTwoPoles);
        let generalization = solution
            .filter(|_| has_starts)
            .and_then(|mut solution| poles.generalization(&mut solution).ok())
            .map(|starts| starts.held);
        Ok(Attempt { seed, evaluations, solved, hidden, connections, seconds, generalization })
    }

    fn foreign(self, name: &str) -> Self::Output {
        Err(SettingError::new("strategy", name, "one of Gambol's"))
    }
}

/// Searches until somebody solves the task or so many evaluations are used up. Individuals are evaluated one after the
/// other; as soon as one solves the task nobody else is.
fn solve<S>(mut strategy: S, task: &dyn Benchmark, seed: Seed, limit: u64) -> (u64, Option<Network>)
where
    S: Strategy<Genome: Genome<Phenotype: Into<Network>>>,
{
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
                return (used, Some(phenotype.into()));
            }
            evaluations.push(evaluation);
        }
        strategy.tell(&evaluations, seed);
    }
    (used, None)
}

/// As [`solve`], but generation by generation: only the best of each is tried, and it has to hold from other starts too.
fn solve_generally<S>(mut strategy: S, task: &DoublePole, seed: Seed, limit: u64) -> (u64, Option<Network>)
where
    S: Strategy<Genome: Genome<Phenotype: Into<Network>>>,
{
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
                return (used, Some(phenotype.into()));
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
    let hidden = match network {
        Network::Dense(net) => net.shape().hidden.iter().sum(),
        Network::Graph(net) => net.shape().hidden_count(),
        _ => 0,
    };
    (hidden, network.weights().len())
}
