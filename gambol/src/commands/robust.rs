use super::{Outcome, gait::champion_file};
use crate::{
    Registry,
    champion::Champion,
    robust::{Cause, Perturbations, Robustness, robustness},
};
use clap::Args;
use std::{io, path::PathBuf, process::ExitCode};
use tasks::gait::Goal;

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol robust runs/biped-1-running
  gambol robust champion.json --perturbations 1000 --seed 7 --json
  gambol robust runs/over-gaps --variation light
  gambol robust runs/tetrapod-2-playing --variation shoved

Worlds take turns in what is changed:
  bumps      mounds on the ground, up to 2 cm high; a terrain has none, and is laid out anew in
             every world; in water there are no such worlds
  pushes     against the torso, up to 0.3 m/s of the whole body, every 2 to 4 s
  friction   friction ± 30 %, mass and motor torque ± 10 %, the start pose by up to 3 degrees
  physics    what engines differ in: 1 to 8 solver iterations, joints of 30 Hz to 1 kHz, contacts
             of half to 4 times the frequency and half to twice the damping, motor gain times 0.5
             to 50, gravity ± 5 %, steps of 1/240 to 1/40 s
  together   all of it
or, with --variation, all are as that draws them for training. \
In each the champion is replayed and judged as gambol gait does, \
but for near worlds. Same seed, same worlds, on any number of threads.")]
pub(crate) struct Robust {
    /// A champion file, or the folder of a run
    #[arg(value_name = "CHAMPION|FOLDER")]
    champion: PathBuf,
    /// How many perturbed worlds, up to 100000
    #[arg(long, default_value_t = 100, allow_hyphen_values = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    perturbations: u32,
    /// The seed of the worlds, and of commands in them
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Worlds as this variation draws them for training, in place of the causes: a name (see: gambol variations)
    #[arg(long, value_name = "NAME")]
    variation: Option<String>,
    /// Threads [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    threads: usize,
    /// Print everything as JSON, every world included
    #[arg(long)]
    json: bool,
}

impl Robust {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let path = champion_file(&self.champion)?;
        let champion = Champion::read(&path)?;
        let variation = self.variation.as_deref().map(|name| registry.variations.find(name).cloned()).transpose()?;
        let perturbations = Perturbations { count: self.perturbations, seed: self.seed, variation };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .map_err(|error| format!("cannot start {} threads: {error}", self.threads))?;
        let robustness = pool
            .install(|| robustness(&champion, registry, &perturbations))
            .map_err(|error| format!("{}: {error}", path.display()))?;
        if self.json {
            say!("{}", serde_json::to_string(&robustness)?)?;
        } else {
            explain(&format!("{} {}", champion.creature.name, champion.movement.name), &robustness)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn explain(name: &str, robustness: &Robustness) -> io::Result<()> {
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let worlds = robustness.trials.len();
    say!("{name}: usable in {} of {worlds} perturbed worlds", percent(robustness.usable_share))?;
    let what = match robustness.view.goal {
        Goal::Distance => "distance",
        Goal::Height => "rise of the torso",
    };
    let progress = robustness.progress_unperturbed;
    let usable = if robustness.usable_unperturbed { "usable" } else { "not usable" };
    say!("\n  unperturbed      {usable}, {what} {progress:.2} m")?;
    match robustness.fitness_kept {
        Some(kept) => say!("  keeps            {} of the {what} (median)", percent(kept))?,
        None if robustness.commanded => say!("  keeps            – (each world has commands of its own)")?,
        None => say!("  keeps            – (it gets nowhere unperturbed)")?,
    }
    say!("\n  worlds           usable")?;
    for share in &robustness.causes {
        let cause = match share.cause {
            Cause::Bumps if !robustness.bumpy => "another terrain",
            Cause::Variation => "as varied",
            cause => cause.name(),
        };
        say!("  {cause:<15}  {} of {}", percent(share.usable_share), share.worlds)?;
    }
    if !robustness.reasons.is_empty() {
        say!("\n  what fails, and in how many of the worlds")?;
    }
    for reason in &robustness.reasons {
        say!("  {:>6}  {}", percent(reason.share), reason.reason.replace('-', " "))?;
    }
    Ok(())
}
