use super::{Outcome, bench_gaits::Gaits, bench_training::Training};
use crate::{
    Registry,
    benchmarks::{BenchmarkTask, Counting, Entrant, PUBLISHED, attempts_csv, entrants, measure, render},
    strategies::StrategyCatalogue,
    suggest,
};
use clap::{Args, Subcommand};
use serde_json::json;
use std::process::ExitCode;

#[derive(Args)]
#[command(after_help = "\
Example:
  gambol bench strategies --strategies neat --tasks xor
  gambol bench training --creature biped-1 --generations 50
  gambol bench gaits --creatures biped-1")]
pub(crate) struct Bench {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Lets each strategy solve XOR and pole balancing, beside what papers report
    Strategies(Strategies),
    /// Trains creatures and says how long it takes
    Training(Training),
    /// Trains creatures until their gaits are usable, and says how many are and how long it took
    Gaits(Box<Gaits>),
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol bench strategies            every strategy, every task but the longest: some minutes
  gambol bench strategies --strategies neat --tasks xor --seeds 100
  gambol bench strategies --tasks general-two-poles --strategies neat --settings pole_balancing
  gambol bench strategies --tasks two-poles --json

Evaluations are counted up to and including that of the first solution. Where a candidate has to pass a test that is not \
counted (poles without velocities), a row is measured with every candidate tested, and one with the best of each generation \
tested alone. An attempt without a solution counts with all it has used up. The settings and nets are named below each table.")]
struct Strategies {
    /// Which strategies [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAMES", value_parser = known_strategy)]
    strategies: Vec<String>,
    /// Which tasks: xor, one-pole, two-poles, two-poles-without-velocities, general-two-poles [default: all but the last]
    #[arg(long, value_delimiter = ',', value_name = "NAMES", value_parser = known_task)]
    tasks: Vec<BenchmarkTask>,
    /// Only those whose net or named settings, as they begin the lines below a table, contain this: stanley_2002, 2-4-1
    #[arg(long, value_name = "TEXT")]
    settings: Option<String>,
    /// The first seed; settings were chosen on seeds from 1 on
    #[arg(long, default_value_t = 1001, value_name = "SEED", value_parser = super::first_seed())]
    first_seed: u64,
    /// How many seeds
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seeds: u64,
    /// Print every attempt as JSON
    #[arg(long)]
    json: bool,
    /// Print every attempt as a line of CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Bench {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        match self.what {
            What::Strategies(strategies) => strategies.run(),
            What::Training(training) => training.run(registry),
            What::Gaits(gaits) => gaits.run(registry),
        }
    }
}

impl Strategies {
    fn run(self) -> Outcome {
        let wanted = |one: &Entrant| {
            let strategies = &self.strategies;
            let task = match self.tasks.is_empty() {
                true => one.task != BenchmarkTask::GeneralTwoPoles,
                false => self.tasks.contains(&one.task),
            };
            task && (strategies.is_empty() || strategies.iter().any(|wanted| wanted == one.settings.name()))
                && self.settings.as_ref().is_none_or(|text| one.description.contains(text))
        };
        let entrants: Vec<Entrant> = entrants().into_iter().filter(wanted).collect();
        if entrants.is_empty() {
            let with =
                self.settings.map_or_else(String::new, |text| format!(" with \"{text}\" in its net or named settings"));
            return Err(format!("none of the strategies asked for is measured{with} on a task asked for").into());
        }
        let mut measured = Vec::new();
        for entrant in &entrants {
            if !self.json && !self.csv {
                tell!("{} on {}", entrant.settings.name(), entrant.task.name());
            }
            let seeds = self.first_seed..self.first_seed + self.seeds;
            measured.push(measure(entrant, Counting::EveryCandidate, seeds.clone())?);
            if entrant.task.has_uncounted_test() {
                measured.push(measure(entrant, Counting::BestOfGeneration, seeds)?);
            }
        }
        if self.json {
            say!("{}", json!({ "measured": measured, "published": PUBLISHED }))?;
        } else if self.csv {
            say!("{}", attempts_csv(&measured).trim_end())?;
        } else {
            say!("{} seeds from {}\n\n{}", self.seeds, self.first_seed, render(&measured).trim_end())?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// The benchmarks are those of Gambol's own strategies.
fn known_strategy(name: &str) -> Result<String, String> {
    let known = StrategyCatalogue::default();
    known.find(name).map(|entry| entry.name().to_owned()).ok_or_else(|| known.unknown(name))
}

fn known_task(name: &str) -> Result<BenchmarkTask, String> {
    let found = BenchmarkTask::ALL.into_iter().find(|task| task.name() == name);
    found.ok_or_else(|| suggest::unknown("task", name, &BenchmarkTask::ALL.map(BenchmarkTask::name)))
}
