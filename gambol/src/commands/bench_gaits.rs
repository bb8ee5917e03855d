use super::{
    Outcome,
    ablation::{VARIANTS, Variant},
};
use crate::{
    Registry,
    champion::Champion,
    config::RunConfig,
    gait,
    judge::USABLE,
    request::Request,
    robust::{Perturbations, robustness},
    texts::csv_cell,
    training::{TrainOptions, train},
};
use clap::Args;
use creatures::Blueprint;
use ne_core::{StopConditions, archive};
use ne_statistics::quantile;
use serde::Serialize;
use serde_json::json;
use std::{error::Error, path::PathBuf, process::ExitCode, time::Instant};
use tasks::gait::Goal;

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol bench gaits                                         14 scenarios, 10 seeds each, until usable or 10 s
  gambol bench gaits --whole --seconds 60 --seeds 3          how good gaits are after a minute
  gambol bench gaits --creatures biped-1 --movements running --set controller.modular=null
  gambol bench gaits --creatures examples/creatures/hopper.json --seconds 30 --robust

bl/s: body lengths a second in the second half of the judged episode; sh: the torso's rise over its start height.
A run ends as soon as its champion's gait is usable, as `gambol gait` judges it in rapier, or when the time is up; with
--whole when the time is up. Seconds count from the start of the run, building the creature and the champion selection included.")]
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
    #[arg(long)]
    steps: Option<u64>,
    /// Threads [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(..=1024))]
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

/// What the columns of the table are called: of scenarios, and of an ablation.
const SCENARIOS: [&str; 8] =
    ["creature", "movement", "usable", "after (median)", "slowest", "speed or rise", "robust", "least robust"];
const ABLATION: [&str; 5] = ["variant", "usable", "median to it", "quality", "robust"];

/// What stands in the table for what was not measured, or never happened.
const UNKNOWN: &str = "–";

/// What came of one run.
#[derive(Clone, Serialize)]
struct Run {
    creature: String,
    movement: String,
    seed: u64,
    /// Whether the saved champion is usable.
    usable: bool,
    /// What speaks against it.
    reasons: Vec<String>,
    /// Seconds until the champion was first usable.
    seconds_to_usable: Option<f64>,
    /// Physics steps until then.
    steps_to_usable: Option<u64>,
    seconds: f64,
    generations: u64,
    steps: u64,
    /// Body lengths a second in the second half of the judged episode (running), or the torso's rise in its best flight
    /// over its start height (jumping).
    quality: Option<f64>,
    /// Share of perturbed worlds in which it is usable.
    robust: Option<f64>,
}

impl Gaits {
    pub(super) fn run(self, registry: &Registry) -> Outcome {
        if let Some(path) = &self.csv {
            super::check_output(path, self.force)?;
        }
        let known = || registry.creatures.names().into_iter().map(str::to_owned).collect();
        let creatures = if self.creatures.is_empty() { known() } else { self.creatures.clone() };
        if let Some(text) = &self.ablate {
            return self.ablation(&creatures, text, registry);
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
        for creature in &creatures {
            for movement in &self.movements {
                let mut runs = Vec::new();
                for seed in self.first_seed..self.first_seed + self.seeds {
                    let run = self.measure(self.config(creature, movement, seed, registry)?, registry)?;
                    if self.json {
                        say!("{}", json!(run))?;
                    }
                    runs.push(run);
                }
                let row = row(&runs, registry);
                if !self.json {
                    say!("{}", line(&row))?;
                    for run in runs.iter().filter(|run| !run.usable) {
                        say!("    seed {}: {}", run.seed, run.reasons.join("; "))?;
                    }
                }
                table.push(row);
            }
        }
        self.write_csv(&SCENARIOS, &table)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Writes the table where it is asked for, without columns of which nothing is known.
    fn write_csv<const COLUMNS: usize>(
        &self,
        columns: &[&str; COLUMNS],
        rows: &[[String; COLUMNS]],
    ) -> Result<(), Box<dyn Error>> {
        let Some(path) = &self.csv else { return Ok(()) };
        let known: Vec<usize> = (0..COLUMNS).filter(|&column| rows.iter().any(|row| row[column] != UNKNOWN)).collect();
        let line =
            |cell: &dyn Fn(usize) -> String| known.iter().map(|&column| cell(column)).collect::<Vec<_>>().join(",");
        let mut lines = vec![line(&|column| csv_cell(columns[column]))];
        lines.extend(rows.iter().map(|row| line(&|column| csv_cell(&row[column]))));
        let text = lines.join("\n") + "\n";
        Ok(archive::write_whole(path, text.as_bytes())
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?)
    }

    /// Every variant whose name contains the text, and the preset itself, on every scenario.
    fn ablation(&self, creatures: &[String], text: &str, registry: &Registry) -> Outcome {
        let chosen = |(index, variant): &(usize, &Variant)| *index == 0 || variant.name.contains(text);
        let variants: Vec<&Variant> = VARIANTS.iter().enumerate().filter(chosen).map(|(_, variant)| variant).collect();
        if let [_] = variants[..] {
            return Err(format!("no variant has \"{text}\" in its name").into());
        }
        say!("{}", ablation_line(&ABLATION.map(String::from)))?;
        let mut usual: Vec<(RunConfig, Run)> = Vec::new();
        let mut table = Vec::new();
        for variant in variants {
            let mut runs = Vec::new();
            for creature in creatures {
                for movement in &self.movements {
                    for seed in self.first_seed..self.first_seed + self.seeds {
                        let mut config = self.config(creature, movement, seed, registry)?;
                        (variant.change)(&mut config);
                        // What does not concern a scenario would give the same run.
                        let run = match usual.iter().find(|(known, _)| *known == config) {
                            Some((_, run)) => run.clone(),
                            None => self.measure(config.clone(), registry)?,
                        };
                        if self.json {
                            say!("{}", json!({ "variant": variant.name, "run": run }))?;
                        }
                        runs.push((config, run));
                    }
                }
            }
            if usual.is_empty() {
                usual.clone_from(&runs);
            }
            let pairs: Vec<(&Run, &Run)> =
                runs.iter().zip(&usual).map(|((_, mine), (_, usual))| (mine, usual)).collect();
            let row = summary(variant, &pairs);
            if !self.json {
                say!("{}", ablation_line(&row))?;
            }
            table.push(row);
        }
        self.write_csv(&ABLATION, &table)?;
        Ok(ExitCode::SUCCESS)
    }

    fn config(
        &self,
        creature: &str,
        movement: &str,
        seed: u64,
        registry: &Registry,
    ) -> Result<RunConfig, Box<dyn Error>> {
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
        config.seed = seed;
        let minutes = self.steps.is_none().then_some(self.seconds / 60.0);
        let tier = (!self.whole).then_some(USABLE);
        config.stop = StopConditions { minutes, steps: self.steps, tier, ..StopConditions::default() };
        Ok(config)
    }

    fn measure(&self, config: RunConfig, registry: &Registry) -> Result<Run, Box<dyn Error>> {
        let registry = registry.clone();
        let folder = tempfile::tempdir()?;
        let began = Instant::now();
        let mut first = None;
        let options = TrainOptions {
            threads: self.threads,
            registry: registry.clone(),
            signal: Default::default(),
            on_generation: &mut |generation| {
                if first.is_none() && generation.tier >= USABLE {
                    first = Some((began.elapsed().as_secs_f64(), generation.steps));
                }
            },
        };
        let outcome = train(&config, &folder.path().join("run"), options)?;
        let seconds = began.elapsed().as_secs_f64();
        let mut run = Run {
            creature: config.creature.name.clone(),
            movement: config.movement.name.clone(),
            seed: config.seed,
            usable: false,
            reasons: vec!["every evaluation failed".into()],
            seconds_to_usable: first.map(|(seconds, _)| seconds),
            steps_to_usable: first.map(|(_, steps)| steps),
            seconds,
            generations: outcome.progress.generations,
            steps: outcome.progress.steps,
            quality: None,
            robust: None,
        };
        if let Some(champion) = &outcome.champion {
            self.judge(champion, &registry, &mut run)?;
        }
        Ok(run)
    }

    fn judge(&self, champion: &Champion, registry: &Registry, run: &mut Run) -> Result<(), Box<dyn Error>> {
        let report = gait::judge(champion, registry)?;
        if let Some(verdict) = &report.verdict {
            run.usable = verdict.usable;
            run.reasons = verdict.reasons.iter().map(ToString::to_string).collect();
        }
        let start_height = f64::from(Blueprint::new(champion.creature.clone())?.start_height());
        run.quality = report.verdict.is_some().then(|| match report.view.goal {
            Goal::Distance => report.travel.second_half_relative_speed,
            Goal::Height => report.best_flight().map_or(0.0, |flight| flight.rise / start_height),
        });
        // A run whose champion is usable at the last re-evaluation only, after the last generation.
        if run.usable && run.seconds_to_usable.is_none() {
            (run.seconds_to_usable, run.steps_to_usable) = (Some(run.seconds), Some(run.steps));
        }
        if self.robust && report.verdict.is_some() {
            run.robust = Some(robustness(champion, registry, &Perturbations::default())?.usable_share);
        }
        Ok(())
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

/// The runs of a scenario as a row of the table.
fn row(runs: &[Run], registry: &Registry) -> [String; 8] {
    let Some(Run { creature, movement, .. }) = runs.first() else { return Default::default() };
    let usable = runs.iter().filter(|run| run.usable).count();
    let middle = |numbers: Vec<f64>| quantile(&numbers, 0.5);
    let seconds: Vec<f64> = runs.iter().filter_map(|run| run.seconds_to_usable).collect();
    let slowest = seconds.iter().copied().reduce(f64::max).filter(|_| usable == runs.len());
    let shown = |number: Option<f64>, unit: &str| number.map_or_else(|| UNKNOWN.into(), |n| format!("{n:.2}{unit}"));
    let quality = middle(runs.iter().filter_map(|run| run.quality).collect());
    let goal = registry.movements.rules(movement).map(|rules| rules.view().goal);
    let unit = if goal == Some(Goal::Height) { " sh" } else { " bl/s" };
    let shares: Vec<f64> = runs.iter().filter_map(|run| run.robust).collect();
    let least = shares.iter().copied().reduce(f64::min);
    let percent = |share: Option<f64>| share.map_or_else(|| UNKNOWN.into(), |share| format!("{:.0} %", 100.0 * share));
    [
        creature.clone(),
        movement.clone(),
        format!("{usable}/{}", runs.len()),
        shown(middle(seconds), " s"),
        shown(slowest, " s"),
        shown(quality, unit),
        percent(middle(shares)),
        percent(least),
    ]
}

/// A variant as a row of the table: how many runs are usable, the time to it, the median of the quality over that of the
/// same run of the first variant, and the mean share of perturbed worlds. `runs`: each with that of the first variant.
fn summary(variant: &Variant, runs: &[(&Run, &Run)]) -> [String; 5] {
    let usable = runs.iter().filter(|(run, _)| run.usable).count();
    let steps_of = |run: &Run| run.steps_to_usable.filter(|_| run.usable).map_or(f64::INFINITY, |steps| steps as f64);
    let steps = match quantile(&runs.iter().map(|(run, _)| steps_of(run)).collect::<Vec<_>>(), 0.5) {
        Some(steps) if steps.is_finite() => format!("{:.2} M", steps / 1e6),
        _ => UNKNOWN.into(),
    };
    let quality = |run: &Run| run.quality.unwrap_or(0.0).max(0.0);
    let ratios =
        runs.iter().filter(|(_, usual)| quality(usual) > 0.0).map(|(run, usual)| quality(run) / quality(usual));
    let ratio =
        quantile(&ratios.collect::<Vec<_>>(), 0.5).map_or_else(|| UNKNOWN.into(), |ratio| format!("× {ratio:.2}"));
    let shares: Vec<f64> = runs.iter().filter_map(|(run, _)| run.robust).collect();
    let robust = match shares.len() {
        0 => UNKNOWN.into(),
        count => format!("{:.0} %", 100.0 * shares.iter().sum::<f64>() / count as f64),
    };
    [variant.name.into(), format!("{usable}/{}", runs.len()), steps, ratio, robust]
}

fn above_zero(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("must be a number above 0".into()),
    }
}
