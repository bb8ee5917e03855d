//! What a user sees of a run: a bar on a terminal, now and then a line elsewhere, JSON for programs.

use gambol::{config::RunConfig, training::Outcome};
use indicatif::{ProgressBar, ProgressStyle};
use ne_core::{GenerationReport, StopReason};
use serde_json::json;
use std::{
    io::{self, IsTerminal, Write},
    time::{Duration, Instant},
};

/// Between two lines where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(5);

pub(super) struct Show {
    manner: Manner,
    unit: String,
    start: Instant,
    first: Option<u64>,
    last_line: Option<Instant>,
    limit: Option<u64>,
}

enum Manner {
    Quiet,
    Json,
    Bar(ProgressBar),
    Lines,
}

impl Show {
    pub(super) fn new(quiet: bool, json: bool, config: &RunConfig, unit: &str) -> Self {
        let limit = config.stop.generations;
        let manner = if quiet {
            Manner::Quiet
        } else if json {
            Manner::Json
        } else if io::stderr().is_terminal() {
            Manner::Bar(bar(limit))
        } else {
            Manner::Lines
        };
        if matches!(manner, Manner::Bar(_) | Manner::Lines) {
            let population = config
                .strategy
                .population()
                .map_or_else(String::new, |population| format!("population {population}, "));
            let (creature, movement) = (&config.creature.name, &config.movement.name);
            eprintln!("{creature} learns {movement}: {population}seed {}", config.seed);
        }
        Self { manner, unit: unit.into(), start: Instant::now(), first: None, last_line: None, limit }
    }

    pub(super) fn generation(&mut self, report: &GenerationReport) {
        let first = *self.first.get_or_insert(report.evaluations.saturating_sub(report.population));
        let rate = (report.evaluations - first) as f64 / self.start.elapsed().as_secs_f64().max(1e-9);
        let best = report.best_so_far.map_or_else(|| "–".into(), |best| format!("{:.2} {}", best.get(), self.unit));
        let mean = report.fitness.map_or_else(|| "–".into(), |of| format!("{:.2}", of.mean));
        let message = format!("best {best}, mean {mean}, {rate:.0} evaluations/s");
        match &self.manner {
            Manner::Quiet => {}
            Manner::Json => print_json(&json!({ "generation": report })),
            Manner::Bar(bar) => {
                bar.set_position(report.generation);
                bar.set_message(message);
            }
            Manner::Lines => {
                let last = self.limit == Some(report.generation);
                if last || self.last_line.is_none_or(|last| last.elapsed() >= LINE_EVERY) {
                    let of = self.limit.map_or_else(String::new, |limit| format!("/{limit}"));
                    eprintln!("generation {}{of}: {message}", report.generation);
                    self.last_line = Some(Instant::now());
                }
            }
        }
    }

    /// No generation will come any more.
    pub(super) fn end(&self) {
        if let Manner::Bar(bar) = &self.manner {
            bar.finish_and_clear();
        }
    }

    pub(super) fn result(&self, outcome: &Outcome, seconds: f64, report: bool) {
        let Outcome { folder, reason, progress, champion } = outcome;
        let fitness = champion.as_ref().map(|champion| champion.fitness);
        if matches!(self.manner, Manner::Json) {
            print_json(&json!({ "result": {
                "folder": folder.path(), "reason": reason, "progress": progress, "fitness": fitness, "seconds": seconds,
            }}));
        }
        if matches!(self.manner, Manner::Quiet | Manner::Json) {
            return;
        }
        // A reader that went away (`| head`) does not make a run that went well a failure.
        let _ = self.summary(outcome, seconds, report);
    }

    fn summary(&self, outcome: &Outcome, seconds: f64, report: bool) -> io::Result<()> {
        let Outcome { folder, reason, progress, champion } = outcome;
        let generations = progress.generations;
        match champion {
            Some(champion) => say!(
                "best {:.3} {}, found in generation {} of {generations}; {reason} after {seconds:.1} s",
                champion.fitness,
                self.unit,
                champion.generation
            )?,
            None if generations == 0 => say!("no generation was done: {reason}")?,
            None => say!("every evaluation failed; {reason} after {generations} generations")?,
        }
        if champion.is_some() {
            say!("champion  {}", folder.champion().display())?;
        }
        if report {
            say!("report    {}", folder.report().display())?;
        }
        if *reason == StopReason::Interrupted {
            say!("go on     gambol resume {}", folder.path().display())?;
        }
        Ok(())
    }
}

fn bar(limit: Option<u64>) -> ProgressBar {
    let (bar, template) = match limit {
        Some(limit) => (ProgressBar::new(limit), "{bar:24} {pos}/{len} generations, {msg}, {eta} left"),
        None => (ProgressBar::no_length(), "{spinner} generation {pos}, {msg}, {elapsed}"),
    };
    // The templates are fixed; were one wrong, the plain style would do.
    bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}

/// A reader that went away (`| head`) is no reason to end a run.
fn print_json(value: &serde_json::Value) {
    let _ = writeln!(io::stdout().lock(), "{value}");
}
