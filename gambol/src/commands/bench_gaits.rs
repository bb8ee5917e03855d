use super::{INTERRUPTED, Outcome};
use crate::{
    Registry, Setup,
    compare::is_seed_or_budget,
    config::RunConfig,
    gaits::{ABLATION, GaitRun, GaitRuns, GaitsError, SCENARIOS, VARIANTS, Variant, ablation_row, csv, scenario_row},
    judge::tier_to_reach,
    request::Request,
};
use clap::Args;
use ne_core::{StopConditions, StopSignal};
use serde_json::json;
use std::{error::Error, path::PathBuf, process::ExitCode};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol bench gaits                                         14 scenarios, 10 seeds each, until usable or 10 s
  gambol bench gaits --whole --seconds 60 --seeds 3          how good gaits are after a minute
  gambol bench gaits --creatures tetrapod-1 --movements running --set controller.modular=null
  gambol bench gaits --creatures examples/creatures/hopper.json --seconds 30 --robust
  gambol bench gaits --ablate \"the term\" --steps 3000000 --whole --seeds 2 \\
      --at-once 2 --threads 1 --keep runs/ablation

bl/s: body lengths a second in the second half of the judged episode; sh: the torso's rise over its start height. \
A run ends as soon as its champion's gait is usable, as `gambol gait` judges it in rapier (of one with stages, in a stage that \
learns what the whole run is for; of `playing`, in 30 of 32 schedules of commands other than that of `gambol gait`), or when the \
time is up; with --whole when the time is up. \
Seconds count from the start of the run, building the creature and the champion selection included. \
With --steps, times are millions (M) of physics steps.")]
pub(super) struct Gaits {
    /// Shipped creatures' names or creature files [default: all seven]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    creatures: Vec<String>,
    /// Which movements
    #[arg(long, value_delimiter = ',', value_name = "NAMES", default_value = "running,jumping")]
    movements: Vec<String>,
    /// The first seed
    #[arg(long, default_value_t = 1, value_name = "SEED", value_parser = super::first_seed())]
    first_seed: u64,
    /// How many seeds
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    seeds: u64,
    /// The seconds a run has
    #[arg(long, default_value_t = 10.0, value_parser = above_zero)]
    seconds: f64,
    /// Do not end a run when its gait is usable
    #[arg(long)]
    whole: bool,
    /// Replay every champion in 100 perturbed worlds (see: gambol robust)
    #[arg(long)]
    robust: bool,
    /// Where runs start from
    #[arg(long, value_name = "NAME", default_value = "default")]
    preset: String,
    /// The strategy [default: the preset's]
    #[arg(long, value_name = "NAME")]
    strategy: Option<String>,
    /// How the world varies in training: a name (see: gambol variations) [default: the preset's]
    #[arg(long, value_name = "NAME")]
    variation: Option<String>,
    /// Leave out the pieces of the default preset one by one, or put others in their place, and say what each is worth;
    /// with a text, only those whose names contain it, such as "the term"
    #[arg(long, value_name = "TEXT", num_args = 0..=1, default_missing_value = "")]
    ablate: Option<String>,
    /// One setting, such as controller.modular=null; can be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Count physics steps in place of seconds: the same on every machine
    #[arg(long, conflicts_with = "seconds")]
    steps: Option<u64>,
    /// Runs at the same time, where steps are counted; 0: one for each core [default: 1]
    #[arg(long, value_parser = super::thread_count(0))]
    at_once: Option<usize>,
    /// Keep every run in this folder, where steps are counted; runs that it has are not done again. Empty it when code has changed
    #[arg(long, value_name = "DIR", requires = "steps", conflicts_with = "seconds")]
    keep: Option<PathBuf>,
    /// Threads of each training [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    threads: usize,
    /// Write the table as CSV as well, a row for each scenario or variant
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    csv: Option<PathBuf>,
    /// Overwrite the file of --csv
    #[arg(long, requires = "csv")]
    force: bool,
    /// Print every run as a line of JSON
    #[arg(long)]
    json: bool,
}

impl Gaits {
    pub(super) fn run(self, registry: &Registry) -> Outcome {
        if let Some(path) = &self.csv {
            super::check_output(path, self.force)?;
        }
        if let Some(own) = self.set.iter().find(|set| is_seed_or_budget(set)) {
            let own_options = "--first-seed, --seeds, --seconds, --steps, --whole";
            return Err(format!("--set {own}: these runs have seeds and a budget of their own ({own_options})").into());
        }
        // What shares the cores with others tells no seconds.
        if self.steps.is_none() && self.at_once.is_some_and(|at_once| at_once != 1) {
            return Err(
                "runs that count seconds are done one by one; to have --at-once, count steps: --steps 3000000".into()
            );
        }
        let known = || registry.creatures.names().into_iter().map(str::to_owned).collect();
        let creatures = if self.creatures.is_empty() { known() } else { self.creatures.clone() };
        let signal = StopSignal::default();
        super::interrupt::stop_on_interrupt(&signal)?;
        let mut runs =
            GaitRuns::new(registry, self.at_once.unwrap_or(1), self.threads).robust(self.robust).until(&signal);
        if let Some(path) = &self.keep {
            runs = runs.kept_in(path)?;
        }
        let done = match &self.ablate {
            Some(text) => self.ablation(&creatures, text, &mut runs, registry),
            None => self.scenarios(&creatures, &mut runs, registry),
        };
        match done {
            Err(error) if matches!(error.downcast_ref(), Some(GaitsError::Interrupted)) => {
                Ok(ExitCode::from(INTERRUPTED))
            }
            done => done,
        }
    }

    /// Every creature with every movement.
    fn scenarios(&self, creatures: &[String], runs: &mut GaitRuns, registry: &Registry) -> Outcome {
        let mut scenarios = Vec::new();
        for creature in creatures {
            for movement in &self.movements {
                let configs = self.configs(creature, movement, registry)?;
                // What cannot be run is told before hours are spent on the others.
                let alone = configs.first().filter(|config| config.stages.is_empty());
                alone.map(|config| Setup::new(config, registry)).transpose()?;
                scenarios.push(configs);
            }
        }
        if !self.json {
            let until = if self.whole { "" } else { ", or until usable" };
            let budget = match self.steps {
                Some(steps) => format!("{steps} physics steps"),
                None => format!("{} s", self.seconds),
            };
            say!("{budget} a run{until}, {} seeds\n", self.seeds)?;
            say!("{}", line(&SCENARIOS.map(String::from)))?;
        }
        let mut table = Vec::new();
        for configs in scenarios {
            let runs = runs.of(&configs)?;
            let row = scenario_row(&runs, self.steps.is_some(), registry);
            for run in &runs {
                if self.json {
                    say!("{}", json!(run))?;
                }
            }
            if !self.json {
                say!("{}", line(&row))?;
                for run in runs.iter().filter(|run| !run.usable) {
                    say!("    seed {}: {}", run.seed, run.reasons.join("; "))?;
                }
            }
            table.push(row);
        }
        self.write_csv(&SCENARIOS, &table)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Every variant whose name contains the text, and the preset itself, on every scenario.
    fn ablation(&self, creatures: &[String], text: &str, runs: &mut GaitRuns, registry: &Registry) -> Outcome {
        let chosen = |(index, variant): &(usize, &Variant)| *index == 0 || variant.name.contains(text);
        let variants: Vec<&Variant> = VARIANTS.iter().enumerate().filter(chosen).map(|(_, variant)| variant).collect();
        if let [_] = variants[..] {
            return Err(format!("no variant has \"{text}\" in its name").into());
        }
        if !self.json {
            say!("{}", ablation_line(&ABLATION.map(String::from)))?;
        }
        let mut usual: Vec<GaitRun> = Vec::new();
        let mut table = Vec::new();
        for variant in variants {
            let mut configs = Vec::new();
            for creature in creatures {
                for movement in &self.movements {
                    configs.extend(self.configs(creature, movement, registry)?);
                }
            }
            configs.iter_mut().for_each(variant.change);
            let mine = runs.of(&configs)?;
            if usual.is_empty() {
                usual.clone_from(&mine);
            }
            let row = ablation_row(variant, &mine.iter().zip(&usual).collect::<Vec<_>>());
            if self.json {
                for run in &mine {
                    say!("{}", json!({ "variant": variant.name, "run": run }))?;
                }
            } else {
                say!("{}", ablation_line(&row))?;
            }
            table.push(row);
        }
        self.write_csv(&ABLATION, &table)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Writes the table where it is asked for.
    fn write_csv<const COLUMNS: usize>(
        &self,
        columns: &[&str; COLUMNS],
        rows: &[[String; COLUMNS]],
    ) -> Result<(), Box<dyn Error>> {
        let Some(path) = &self.csv else { return Ok(()) };
        Ok(super::write_output(path, csv(columns, rows).as_bytes(), self.force)?)
    }

    /// A scenario with every seed.
    fn configs(&self, creature: &str, movement: &str, registry: &Registry) -> Result<Vec<RunConfig>, Box<dyn Error>> {
        let request = Request {
            creature: Some(creature.into()),
            movement: Some(movement.into()),
            preset: Some(self.preset.clone()),
            strategy: self.strategy.clone(),
            variation: self.variation.clone(),
            set: self.set.clone(),
            ..Request::default()
        };
        let mut config = request.resolve(registry)?;
        let minutes = self.steps.is_none().then_some(self.seconds / 60.0);
        let tier = (!self.whole).then(|| tier_to_reach(&config, registry));
        config.stop = StopConditions { minutes, steps: self.steps, tier, ..StopConditions::default() };
        let seeds = self.first_seed..self.first_seed + self.seeds;
        Ok(seeds.map(|seed| RunConfig { seed, ..config.clone() }).collect())
    }
}

/// A row of the table of scenarios as a line for people.
fn line([creature, movement, usable, to_usable, slowest, quality, robust, least]: &[String; 8]) -> String {
    format!(
        "{creature:<18} {movement:<9} {usable:>8} {to_usable:>14} {slowest:>10} {quality:>13} {robust:>9} {least:>12}"
    )
}

/// A row of the table of variants as a line for people.
fn ablation_line([variant, usable, to_usable, quality, robust]: &[String; 5]) -> String {
    format!("{variant:<34} {usable:>8} {to_usable:>12} {quality:>9} {robust:>7}")
}

fn above_zero(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("must be a number above 0".into()),
    }
}
