//! What a user sees of a run: a bar on a terminal, now and then a line elsewhere, JSON for programs.

use super::terminal::printable;
use crate::{Registry, program_name};
use crate::{
    champion::Champion,
    config::{Origin, RunConfig},
    shaping::{ENDED_EARLY, PlannedStage},
    texts::shell_word,
    training::Outcome,
};
use indicatif::{ProgressBar, ProgressStyle};
use ne_core::{GenerationReport, StopReason};
use serde_json::json;
use std::{
    io::{self, IsTerminal},
    time::{Duration, Instant},
};
use tasks::gait::Judgement;

/// Between two lines where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(5);

pub(super) struct Show {
    output: Output,
    /// Units of fitness, by the names of movements.
    registry: Registry,
    /// The unit of what is trained now.
    unit: String,
    /// Whether the run has stages: its generations are then counted in each of them, its limit over all.
    staged: bool,
    start: Instant,
    first: Option<u64>,
    last_line: Option<Instant>,
    limit: Option<u64>,
    /// Whether a champion selection chooses the champion, so that the best of a generation is not yet it.
    judged: bool,
    /// Why a line for programs could not be written.
    unwritten: Option<io::Error>,
}

enum Output {
    Quiet,
    Json,
    Bar(ProgressBar),
    Lines,
}

/// What came of a run.
pub(super) struct Ended<'a> {
    pub(super) outcome: &'a Outcome,
    /// On the champion's gait, if those of its movement are judged.
    pub(super) verdict: Option<&'a Judgement>,
    /// Whether a usable champion is from a stage before the one that learns what the run is for.
    pub(super) too_early: bool,
    pub(super) seconds: f64,
    /// Whether a report was written.
    pub(super) report: bool,
}

impl Show {
    pub(super) fn new(quiet: bool, json: bool, config: &RunConfig, registry: &Registry) -> Self {
        let staged = !config.stages.is_empty();
        let limit = config.stop.generations.filter(|_| !staged);
        let output = if quiet {
            Output::Quiet
        } else if json {
            Output::Json
        } else if io::stderr().is_terminal() {
            Output::Bar(bar(limit))
        } else {
            Output::Lines
        };
        if matches!(output, Output::Bar(_) | Output::Lines) {
            let population = config
                .strategy
                .population()
                .map_or_else(String::new, |population| format!("population {population}, "));
            let (creature, movement) = (&config.creature.name, &config.movement.name);
            let bodies = super::in_bodies(config.bodies());
            tell!("{creature} learns {movement}{bodies}: {population}seed {}", config.seed);
        }
        Self {
            output,
            registry: registry.clone(),
            unit: unit_of(registry, &config.movement.name),
            staged,
            start: Instant::now(),
            first: None,
            last_line: None,
            limit,
            judged: config.has_champion_selection(),
            unwritten: None,
        }
    }

    /// A stage begins, or is taken up again: of a run of `stages`, if they are listed.
    pub(super) fn leg(&mut self, planned: &PlannedStage, stages: usize, origin: Option<&Origin>) {
        (self.start, self.first, self.last_line) = (Instant::now(), None, None);
        self.unit = unit_of(&self.registry, &planned.config.movement.name);
        self.judged = planned.config.has_champion_selection();
        let (number, name) = (planned.stage + 1, &planned.name);
        let origin = origin.map_or_else(String::new, |origin| format!(": {origin}"));
        match &self.output {
            Output::Quiet => {}
            Output::Json => {
                let line = json!({ "stage": { "number": number, "name": name } });
                self.print_json(&line);
            }
            Output::Bar(bar) => bar.println(printable(&format!("stage {number} of {stages}, {name}{origin}"))),
            Output::Lines => tell!("stage {number} of {stages}, {name}{origin}"),
        }
    }

    pub(super) fn generation(&mut self, report: &GenerationReport) {
        let first = *self.first.get_or_insert(report.evaluations.saturating_sub(report.population));
        let rate = (report.evaluations - first) as f64 / self.start.elapsed().as_secs_f64().max(1e-9);
        let measure = |fitness: Option<f64>| fitness.map_or_else(|| "–".into(), |it| format!("{it:.2} {}", self.unit));
        let champion = measure(report.best_so_far.map(f64::from));
        let mean = report.fitness.map_or_else(|| "–".into(), |of| format!("{:.2}", of.mean));
        let message = match self.judged {
            true => {
                let best = measure(report.fitness.map(|of| of.best));
                format!("best {best} in training, mean {mean}, champion {champion} in rapier, {rate:.0} evaluations/s")
            }
            false => format!("best {champion}, mean {mean}, {rate:.0} evaluations/s"),
        };
        match &self.output {
            Output::Quiet => {}
            Output::Json => self.print_json(&json!({ "generation": report })),
            Output::Bar(bar) => {
                bar.set_position(report.generation);
                bar.set_message(message);
            }
            Output::Lines => {
                let last = self.limit == Some(report.generation);
                if last || self.last_line.is_none_or(|last| last.elapsed() >= LINE_EVERY) {
                    let of = self.limit.map_or_else(String::new, |limit| format!("/{limit}"));
                    tell!("generation {}{of}: {message}", report.generation);
                    self.last_line = Some(Instant::now());
                }
            }
        }
    }

    /// No generation will come any more.
    pub(super) fn end(&self) {
        if let Output::Bar(bar) = &self.output {
            bar.finish_and_clear();
        }
    }

    /// A line for programs. A run goes on without the lines that cannot be written, and the first reason is told when it has ended.
    fn print_json(&mut self, value: &serde_json::Value) {
        if let Err(error) = heard(say!("{value}")) {
            self.unwritten.get_or_insert(error);
        }
    }

    /// Tells what came of the run.
    ///
    /// # Errors
    /// If this, or a line for programs before it, could not be written.
    pub(super) fn result(&mut self, ended: &Ended<'_>) -> io::Result<()> {
        let Ended { outcome, verdict, too_early, seconds, .. } = ended;
        let Outcome { folder, reason, progress, champion } = outcome;
        let fitness = champion.as_ref().map(|champion| champion.fitness);
        if matches!(self.output, Output::Json) {
            let trained = champion.as_ref().and_then(|champion| champion.trained);
            self.print_json(&json!({ "result": {
                "folder": folder.path().display().to_string(), "reason": reason, "progress": progress, "fitness": fitness,
                "trained": trained, "verdict": verdict, "ended_early": too_early, "seconds": seconds,
            }}));
        }
        if let Some(error) = self.unwritten.take() {
            return Err(error);
        }
        match self.output {
            Output::Quiet | Output::Json => Ok(()),
            Output::Bar(_) | Output::Lines => heard(self.summary(ended)),
        }
    }

    fn summary(&self, ended: &Ended<'_>) -> io::Result<()> {
        let Ended { outcome, verdict, too_early, seconds, report } = *ended;
        let Outcome { folder, reason, progress, champion } = outcome;
        let generations = progress.generations;
        match champion {
            Some(champion) => {
                // Of a run with stages that had ended before, no stage was begun.
                let best = worth(champion, &unit_of(&self.registry, &champion.movement.name));
                let found = match champion.generation {
                    0 if self.staged => "found before its stage".into(),
                    0 => "found before this run".into(),
                    found if self.staged => format!("found in generation {found} of its stage"),
                    found => format!("found in generation {found} of {generations}"),
                };
                say!("best {best}, {found}; {reason} after {seconds:.1} s")?;
                if champion.diverged() {
                    say!("warning   {DIVERGED_NOTE}")?;
                }
            }
            None if generations == 0 => say!("no generation was done: {reason}")?,
            None => say!("no champion was found; {reason} after {generations} generations")?,
        }
        if let Some(verdict) = verdict {
            let early = if too_early { format!("; but {ENDED_EARLY}") } else { String::new() };
            say!("gait      {}{early}", in_words(verdict))?;
        }
        if champion.is_some() {
            say!("champion  {}", folder.champion().display())?;
        }
        if report {
            say!("report    {}", folder.report().display())?;
        }
        if *reason == StopReason::Interrupted {
            say!("go on     {} resume {}", program_name(), shell_word(folder.path()))?;
        }
        Ok(())
    }
}

/// `usable`, or `not usable: ` and what speaks against it.
fn in_words(verdict: &Judgement) -> String {
    let reasons: Vec<String> = verdict.reasons.iter().map(ToString::to_string).collect();
    match verdict.near_worlds {
        _ if !verdict.usable => format!("not usable: {}", reasons.join("; ")),
        Some(near) => format!("usable, in {} of {} near worlds too", near.usable, near.worlds),
        None => "usable".into(),
    }
}

/// The unit of a movement's fitness.
fn unit_of(registry: &Registry, movement: &str) -> String {
    registry.movements.find(movement).map_or_else(String::new, |entry| entry.unit.clone())
}

/// What is said where lanes and rapier should agree and do not.
const DIVERGED_NOTE: &str = "lanes and rapier part: they give this champion another fitness; rapier's counts";

/// `12.300 m in rapier (14.000 m in training)`, or only the fitness if it was the same in training, or if no generation had it.
fn worth(champion: &Champion, unit: &str) -> String {
    let fitness = champion.fitness;
    match champion.fitness_in_training() {
        Some(trained) => format!("{fitness:.3} {unit} in rapier ({trained:.3} {unit} in training)"),
        None => format!("{fitness:.3} {unit}"),
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

/// A reader that went away (`| head`) does not make a run that went well a failure.
fn heard(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}
