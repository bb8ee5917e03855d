use super::{INTERRUPTED, NOT_YET, Outcome};
use crate::{
    Registry,
    reproduce::{
        Judged, Part, Progress, ReproductionFolder, Request,
        thesis::{CLOCK_MINUTES, GENERATIONS, RUNS},
        work, write_outcome,
    },
};
use clap::{Args, Subcommand};
use ne_core::StopSignal;
use std::{path::PathBuf, process::ExitCode, time::Instant};

#[derive(Args)]
#[command(after_help = "\
Example:
  gambol reproduce thesis --runs 3 --creatures biped-1 --movements jumping")]
pub(crate) struct Reproduce {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Does the experiments of Gegendorfer 2017 again, and puts its figures and tables beside ours
    Thesis(Thesis),
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol reproduce thesis                                       everything: 280 runs of 300 generations
  gambol reproduce thesis --runs 3 --creatures biped-1,apod     a part of it; what is there already is kept
  gambol reproduce thesis --clock                               and 28 timed runs of 5 minutes, one by one
  gambol reproduce thesis --part 2/4                            every fourth run

Interrupted, the same command goes on. The page OUT/index.html is made of whatever is in the folder, and says what is \
missing. Parts done on several machines are put together by copying their results folders into one; the same command \
without --part then makes the page. The numbers are also in results.csv, times.csv and timed.csv.")]
struct Thesis {
    /// Creatures of the thesis [default: all seven]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    creatures: Vec<String>,
    /// Movements of the thesis: running, jumping [default: both]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    movements: Vec<String>,
    /// Presets [default: thesis,default]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    presets: Vec<String>,
    /// Runs of each preset on each scenario, with seeds from 1 on
    #[arg(long, default_value_t = RUNS, value_parser = clap::value_parser!(u64).range(1..=1000))]
    runs: u64,
    /// Generations of each run
    #[arg(long, default_value_t = GENERATIONS, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    generations: u64,
    /// Add a timed run of each preset on each scenario, which is looked at after some minutes
    #[arg(long)]
    clock: bool,
    /// The minutes after which timed runs are looked at, rising, separated by commas
    #[arg(long, value_delimiter = ',', value_name = "MINUTES", default_values_t = CLOCK_MINUTES, requires = "clock")]
    clock_minutes: Vec<f64>,
    /// Do only a share of the runs, such as 2/4
    #[arg(long, default_value = "1/1", hide_default_value = true)]
    part: Part,
    /// The folder of the reproduction; new, empty, or one that was begun with as many generations
    #[arg(long, value_name = "DIR", default_value = "runs/reproduce-thesis")]
    out: PathBuf,
    /// Runs at the same time [default: one for each core]; timed runs are always alone
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    at_once: usize,
    /// Threads of each run; the thesis had one
    #[arg(long, default_value_t = 1)]
    #[arg(value_parser = super::thread_count(1))]
    threads: usize,
    /// Show nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

impl Reproduce {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        match self.what {
            What::Thesis(thesis) => thesis.run(registry),
        }
    }
}

impl Thesis {
    fn run(self, registry: &Registry) -> Outcome {
        let request = Request {
            creatures: self.creatures,
            movements: self.movements,
            presets: self.presets,
            runs: self.runs,
            generations: self.generations,
            clock_minutes: self.clock.then_some(self.clock_minutes),
        };
        let plan = request.plan(registry)?;
        let folder = ReproductionFolder::create(&self.out, &plan)?;
        let signal = StopSignal::default();
        super::interrupt::stop_on_interrupt(&signal)?;
        let began = Instant::now();
        let show = |progress: &Progress<Judged>| {
            if !self.quiet {
                let Progress { run, best: champion, done, all, .. } = progress;
                let verdict = match champion {
                    None => progress.nothing(),
                    Some(champion) => {
                        let usable = if champion.usable { "usable" } else { "not usable" };
                        format!("fitness {:.2}, {usable}", champion.fitness)
                    }
                };
                tell!("{done}/{all} after {:.0} s: {run}: {verdict}", began.elapsed().as_secs_f64());
            }
        };
        let options = crate::reproduce::WorkOptions {
            part: self.part,
            at_once: self.at_once,
            threads: self.threads,
            registry: registry.clone(),
            signal: signal.clone(),
            on_run: &show,
        };
        let left = work(&folder, &plan, &options)?;
        let outcome = write_outcome(&folder, &plan)?;
        if !self.quiet {
            let there = outcome.asked - outcome.missing.len();
            say!("{there} of {} runs are there", outcome.asked)?;
            say!("page      {}", folder.page().display())?;
            say!("raw data  {0}/results.csv, {0}/times.csv, {0}/timed.csv", folder.path().display())?;
        }
        if signal.is_set() && left > 0 {
            say!("{left} runs are left; the same command goes on")?;
            return Ok(ExitCode::from(INTERRUPTED));
        }
        if left > 0 {
            say!("{left} runs are being done by other processes; when they have ended, repeat the command")?;
            return Ok(ExitCode::from(NOT_YET));
        }
        Ok(ExitCode::SUCCESS)
    }
}
