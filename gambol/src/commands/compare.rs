use super::{INTERRUPTED, NOT_YET, Outcome};
use crate::{
    Registry,
    compare::{ComparisonFolder, Method, Part, PlanRequest, Progress, WorkOptions, merge, table, work, write_outcome},
    program_name,
    texts::shell_word,
};
use clap::Args;
use ne_core::{StopConditions, StopSignal};
use std::{path::PathBuf, process::ExitCode, time::Instant};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol compare --strategies ga,neat,cma-es --creatures biped-1,apod --movements running,jumping \\
      --seeds 10 --evaluations 15000 --out runs/ga-neat-cma
  gambol compare --strategies ga,neat,cma-es,random-search --preset shaped --creatures biped-1 \\
      --first-seed 1001 --seeds 12 --evaluations 15000 --out runs/shaped
  gambol compare --strategies thesis,default,large=large.json --creatures biped-1 \\
      --movements running --seeds 5 --steps 10000000 --out runs/presets

Interrupted, the same command goes on. On a cluster each job does a part into a folder of its own, and one puts them \
together:
  gambol compare ... --part 3/20 --out part-3
  gambol merge part-* --out whole

Each strategy has a run with each seed on each creature and movement. The outcome is in OUT/comparison.html, \
medians.csv, scores.csv, curves.csv and settings.csv.")]
pub(crate) struct Compare {
    /// What is compared: strategies (see: gambol strategies), presets, or NAME=CONFIG-FILE
    #[arg(long, value_delimiter = ',', required = true, value_name = "NAMES")]
    strategies: Vec<String>,
    /// Shipped creatures or creature files
    #[arg(long, value_delimiter = ',', required = true, value_name = "NAMES")]
    creatures: Vec<String>,
    /// Movements (see: gambol movements)
    #[arg(long, value_delimiter = ',', default_value = "running", value_name = "NAMES")]
    movements: Vec<String>,
    /// One preset for all, so that strategies differ in their own settings alone: plain (a dense net, the movement alone,
    /// nothing varies), shaped (terms, senses and variation of the default preset), or another
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// How many seeds
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seeds: u64,
    /// The first of them
    #[arg(long, default_value_t = 1, value_name = "SEED", value_parser = super::first_seed())]
    first_seed: u64,
    /// What each run may use up: so many evaluations; this or --steps is needed, and both together where the fitness has no terms
    #[arg(long, required_unless_present = "steps")]
    evaluations: Option<u64>,
    /// What each run may use up: so many physics steps
    #[arg(long)]
    steps: Option<u64>,
    /// What steps the creatures of all runs in training: lanes, rapier [default: what each strategy's settings say]
    #[arg(long, value_name = "NAME")]
    engine: Option<String>,
    /// How the worlds of all runs vary in training: a name (see: gambol variations) [default: what
    /// each strategy's settings file says, or none]. In worlds that vary a score is that of the last re-evaluation
    #[arg(long, value_name = "NAME")]
    variation: Option<String>,
    /// One setting for all runs, such as movement.steps=600; can be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Do only a share of the runs, such as 3/20
    #[arg(long, default_value = "1/1", hide_default_value = true)]
    part: Part,
    /// The folder of the comparison; new, empty, or one where the same comparison was begun
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Runs at the same time [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    at_once: usize,
    /// Threads of each run
    #[arg(long, default_value_t = 1)]
    #[arg(value_parser = super::thread_count(1))]
    threads: usize,
    /// Show nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

impl Compare {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let request = PlanRequest {
            methods: self.strategies.iter().map(|text| Method::parse(text, registry)).collect::<Result<_, _>>()?,
            creatures: self.creatures.clone(),
            movements: self.movements.clone(),
            seeds: (self.first_seed..self.first_seed + self.seeds).collect(),
            preset: self.preset.clone(),
            budget: StopConditions { evaluations: self.evaluations, steps: self.steps, ..StopConditions::default() },
            set: self.set.clone(),
            engine: self.engine.clone(),
            variation: self.variation.clone(),
        };
        let plan = request.plan(registry)?;
        let folder = ComparisonFolder::create(&self.out, &plan)?;
        let signal = StopSignal::default();
        super::interrupt::stop_on_interrupt(&signal)?;
        let began = Instant::now();
        let show = |progress: &Progress<f64>| {
            if !self.quiet {
                let Progress { run, best, done, all, .. } = progress;
                let best = best.map_or_else(|| progress.nothing(), |best| format!("{best:.2}"));
                tell!("{done}/{all} after {:.0} s: {run}: {best}", began.elapsed().as_secs_f64());
            }
        };
        let options = WorkOptions {
            part: self.part,
            at_once: self.at_once,
            threads: self.threads,
            registry: registry.clone(),
            signal: signal.clone(),
            on_run: &show,
        };
        let left = work(&folder, &plan, &options)?;
        if signal.is_set() {
            say!("{left} runs are left; the same command goes on")?;
            return Ok(ExitCode::from(INTERRUPTED));
        }
        if self.part != Part::ALL {
            if self.quiet {
                return Ok(ExitCode::SUCCESS);
            }
            say!(
                "part {} is done; when all are: {} merge {} ... --out DIR",
                self.part,
                program_name(),
                shell_word(&self.out)
            )?;
            return Ok(ExitCode::SUCCESS);
        }
        if left > 0 {
            say!("{left} runs are being done by other processes; when they have ended, repeat the command")?;
            return Ok(ExitCode::from(NOT_YET));
        }
        finish(&folder, self.quiet)
    }
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol merge part-1 part-2 part-3 --out whole
  gambol merge runs/ga-neat-cma --out again        make the page of a comparison anew, from its results")]
pub(crate) struct Merge {
    /// The folders of the parts
    #[arg(required = true)]
    parts: Vec<PathBuf>,
    /// The folder of the whole; new, empty, or one where the same comparison was begun
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Show nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

impl Merge {
    pub(crate) fn run(self) -> Outcome {
        finish(&merge(&self.parts, &self.out)?, self.quiet)
    }
}

/// Writes what came out, and shows it.
fn finish(folder: &ComparisonFolder, quiet: bool) -> Outcome {
    let analysis = write_outcome(folder)?;
    if !quiet {
        say!("{}", table::render(&analysis))?;
        say!("page      {}", folder.page().display())?;
        say!("raw data  {0}/medians.csv, {0}/scores.csv, {0}/curves.csv, {0}/settings.csv", folder.path().display())?;
    }
    Ok(ExitCode::SUCCESS)
}
