use super::{INTERRUPTED, NOT_YET, Outcome};
use crate::{
    Registry,
    compare::{ComparisonFolder, Part, PlanRequest, Progress, WorkOptions, table, work},
    tune::{TuneRequest, Tuned, Tuning, text},
};
use clap::Args;
use ne_core::{StopConditions, StopSignal};
use std::{path::PathBuf, process::ExitCode};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol tune neat --preset plain --creatures biped-1,tetrapod-2 --movements running,jumping \\
      --evaluations 3000 --trials 20 --seeds 3 --out runs/tune-neat
  gambol compare --strategies tuned-neat=runs/tune-neat/tuned.json,ga --preset plain ...

Each trial multiplies every number of the strategy's settings with a factor drawn from 1/SPREAD to SPREAD; the first trial \
has the defaults. All trials run on the same seeds, which should not be those compared on. The best is in OUT/tuned.json, \
the comparison of the trials in OUT/comparison. Interrupted, the same command goes on. Give every strategy the same trials, \
seeds and evaluations.")]
pub(crate) struct Tune {
    /// The strategy (see: gambol strategies)
    strategy: String,
    /// Shipped creatures or creature files
    #[arg(long, value_delimiter = ',', required = true, value_name = "NAMES")]
    creatures: Vec<String>,
    /// Movements (see: gambol movements)
    #[arg(long, value_delimiter = ',', default_value = "running", value_name = "NAMES")]
    movements: Vec<String>,
    /// What all trials have but for the strategy's settings: plain, shaped, or another preset
    #[arg(long, default_value = "plain", value_name = "NAME")]
    preset: String,
    /// How many sets of settings are tried, the defaults among them
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    trials: u32,
    /// Numbers are multiplied with a factor from 1/SPREAD to SPREAD
    #[arg(long, default_value_t = 4.0, value_parser = spread)]
    spread: f64,
    /// How many seeds each trial runs with
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seeds: u64,
    /// The first of them; settings are drawn from it too
    #[arg(long, default_value_t = 900_001, value_name = "SEED", value_parser = super::first_seed())]
    first_seed: u64,
    /// What each run may use up: so many evaluations
    #[arg(long)]
    evaluations: u64,
    /// One setting for all runs, such as movement.steps=600; can be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// The folder of the tuning; new, or one where the same tuning was begun
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Runs at the same time [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    at_once: usize,
    /// Show nothing but the best settings
    #[arg(long, short)]
    quiet: bool,
}

impl Tune {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let plan = PlanRequest {
            creatures: self.creatures.clone(),
            movements: self.movements.clone(),
            seeds: (self.first_seed..self.first_seed + self.seeds).collect(),
            budget: StopConditions { evaluations: Some(self.evaluations), ..StopConditions::default() },
            preset: Some(self.preset.clone()),
            set: self.set.clone(),
            ..PlanRequest::default()
        };
        let strategy = self.strategy.clone();
        let request =
            TuneRequest { strategy, trials: self.trials, draw_seed: self.first_seed, spread: self.spread, plan };
        let tuning = request.tuning(registry)?;
        tuning.begin(&self.out)?;
        let folder = ComparisonFolder::create(&Tuning::comparison(&self.out), &tuning.plan)?;
        let signal = StopSignal::default();
        super::interrupt::stop_on_interrupt(&signal)?;
        let show = |progress: &Progress<f64>| {
            if !self.quiet {
                let Progress { run, best, done, all, .. } = progress;
                let best = best.map_or_else(|| progress.nothing(), |best| format!("{best:.2}"));
                tell!("{done}/{all}: {run}: {best}");
            }
        };
        let options = WorkOptions {
            part: Part::ALL,
            at_once: self.at_once,
            threads: 1,
            registry: registry.clone(),
            signal: signal.clone(),
            on_run: &show,
        };
        let left = work(&folder, &tuning.plan, &options)?;
        if signal.is_set() || left > 0 {
            say!("{left} runs are left; the same command goes on")?;
            return Ok(ExitCode::from(if signal.is_set() { INTERRUPTED } else { NOT_YET }));
        }
        let Tuned { analysis, best, file } = tuning.conclude(&self.out)?;
        if !self.quiet {
            tell!("{}", table::overall(&analysis));
            tell!("the best is trial-{best:03}; it is in {}", file.display());
        }
        say!("{}", text(&tuning.trials[best]).trim_end())?;
        Ok(ExitCode::SUCCESS)
    }
}

fn spread(text: &str) -> Result<f64, String> {
    let spread = text.parse().ok().filter(|spread: &f64| *spread > 1.0 && *spread <= 1000.0);
    spread.ok_or_else(|| "must be above 1 and at most 1000".into())
}
