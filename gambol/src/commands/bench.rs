use super::{Outcome, bench_gaits::Gaits, bench_training::Training};
use crate::{
    Registry,
    strategies::StrategyCatalogue,
    suggest,
    yardsticks::{PUBLISHED, Yardstick, contestants, measure, render},
};
use clap::{Args, Subcommand};
use serde_json::json;
use std::process::ExitCode;

#[derive(Args)]
#[command(after_help = "\
Example:
  gambol bench yardsticks --strategies neat --tasks xor
  gambol bench training --creature biped-1 --generations 50
  gambol bench gaits --creatures biped-1")]
pub(crate) struct Bench {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Lets each strategy solve XOR and pole balancing, beside what papers report
    Yardsticks(Yardsticks),
    /// Trains creatures and says how long it takes
    Training(Training),
    /// Trains creatures until their gaits are usable, and says how many are and how long it took
    Gaits(Box<Gaits>),
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol bench yardsticks                                           every strategy, every task but the longest: some minutes
  gambol bench yardsticks --strategies neat --tasks xor --seeds 100
  gambol bench yardsticks --tasks two-poles --json

Evaluations are counted up to and including that of the first solution. An attempt without a solution counts with all it
has used up. The settings and nets are named below each table.")]
struct Yardsticks {
    /// Which strategies [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAMES", value_parser = known_strategy)]
    strategies: Vec<String>,
    /// Which tasks: xor, one-pole, two-poles, two-poles-without-velocities, general-two-poles [default: all but the last]
    #[arg(long, value_delimiter = ',', value_name = "NAMES", value_parser = known_task)]
    tasks: Vec<Yardstick>,
    /// How many seeds, from 1 on
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seeds: u64,
    /// Print every attempt as JSON
    #[arg(long)]
    json: bool,
}

impl Bench {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        match self.what {
            What::Yardsticks(yardsticks) => yardsticks.run(),
            What::Training(training) => training.run(registry),
            What::Gaits(gaits) => gaits.run(registry),
        }
    }
}

impl Yardsticks {
    fn run(self) -> Outcome {
        let wanted = |strategy: &str, task: Yardstick| {
            (self.strategies.is_empty() || self.strategies.iter().any(|wanted| wanted == strategy))
                && if self.tasks.is_empty() { task != Yardstick::GeneralTwoPoles } else { self.tasks.contains(&task) }
        };
        let mut measured = Vec::new();
        for contestant in contestants().iter().filter(|one| wanted(one.settings.name(), one.task)) {
            if !self.json {
                eprintln!("{} on {}", contestant.settings.name(), contestant.task.name());
            }
            measured.push(measure(contestant, self.seeds)?);
        }
        if self.json {
            say!("{}", json!({ "measured": measured, "published": PUBLISHED }))?;
        } else {
            say!("{} seeds\n\n{}", self.seeds, render(&measured).trim_end())?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// The benchmarks are those of Gambol's own strategies.
fn known_strategy(name: &str) -> Result<String, String> {
    let known = StrategyCatalogue::default();
    known.find(name).map(|entry| entry.name().to_owned()).ok_or_else(|| known.unknown(name))
}

fn known_task(name: &str) -> Result<Yardstick, String> {
    let found = Yardstick::ALL.into_iter().find(|task| task.name() == name);
    found.ok_or_else(|| suggest::unknown("task", name, &Yardstick::ALL.map(Yardstick::name)))
}
