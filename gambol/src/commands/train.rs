use super::{
    INTERRUPTED, NOT_USABLE, Outcome,
    gait::{champion_file, no_champion},
    progress::{Ended, Show},
};
use crate::{
    Registry, Setup,
    champion::Champion,
    config::{RunConfig, Transferred},
    gait,
    judge::{USABLE, tier_to_reach},
    report,
    request::Request,
    run_folder::NewFolder,
    shaping::{self, ShapingError, StageProgress},
    suggest,
    training::{self, TrainError, TrainOptions},
};
use clap::{Args, ValueEnum};
use creatures::Blueprint;
use ne_core::{StopConditions, StopReason, StopSignal};
use std::{
    cell::RefCell,
    path::{Path, PathBuf},
    process::ExitCode,
    time::Instant,
};
use tasks::gait::{Judgement, Reason};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol train biped-1 running
  gambol train biped-1 jumping --until usable
  gambol train decapod-1 running --budget 10s --variation strong
  gambol train tetrapod-2 running --terrain gaps:0.3
  gambol train tetrapod-2 jumping --generations 100 --seed 7 --out runs/leap
  gambol train biped-1 running --preset thesis
  gambol train biped-1 running --strategy neat
  gambol train biped-1 running --variation none --engine rapier
  gambol train biped-1 running --strategy ga --topology-from runs/biped-1-running/champion.json
  gambol train tetrapod-2 running --further-body examples/creatures/tetrapod-2-longer-legs.json
  gambol train apod running --set strategy.cma-es.population=200 --set physics.time_step=0.01
  gambol train biped-2 running --set 'movement.terms=[{\"term\":\"energy\",\"weight\":-0.001}]'
  gambol train tetrapod-1 running --strategy nsga2 \\
      --set 'movement.objectives=[{\"term\":\"running\"},{\"term\":\"energy\",\"weight\":-1}]'
  gambol train --config runs/leap/config.json --out runs/leap-again
  gambol train --config shaping/run-then-gaps-then-thrift.json
  gambol train tetrapod-2 jumping --from runs/tetrapod-2-running

A run ends at the first limit it meets. It has 300 generations at most, unless --generations, --evaluations, --steps, \
--minutes or --budget says otherwise. Ctrl-C finishes the generation and saves. \
At the end the champion's gait is judged, as `gambol gait` judges it, if those of its movement are.

Exit code 0: done. 1: something was wrong. 3: --until usable, and the champion is not usable for `gambol gait`, \
or is from a stage before the one that learns what the run is for. 130: interrupted.")]
pub(crate) struct Train {
    /// A shipped creature's name (see: gambol creatures) or a creature file
    creature: Option<String>,
    /// What it is to learn (see: gambol movements)
    movement: Option<String>,
    /// A further body that the same net has to move in training: a name or a creature file; can be given several times. It
    /// must sense and move the same as the creature, for which the champion is chosen
    #[arg(long, value_name = "NAME|FILE")]
    further_body: Vec<String>,
    /// Where to start from: default, thesis (the algorithm of the thesis), stanley-2002 (NEAT as in its paper), plain or shaped
    /// (for comparisons)
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// The strategy, in place of the preset's: ga, neat, cma-es, open-es, cosyne, nsga2, or a baseline: ars, hill-climbing,
    /// random-search (see: gambol strategies)
    #[arg(long, value_name = "NAME")]
    strategy: Option<String>,
    /// Keep the topology of this champion's net (one that NEAT has found, say) and search its weights anew
    #[arg(long, value_name = "CHAMPION")]
    topology_from: Option<PathBuf>,
    /// Go on from what this run has learned (its population), or from this champion (its net): with another movement, other
    /// senses, another body. Without --config, sensors and controller are those it learned with, but for what --set changes
    #[arg(long, value_name = "RUN|CHAMPION", conflicts_with = "topology_from")]
    from: Option<PathBuf>,
    /// What to take along from there: population, champion, held (the champion, to which only what is new is searched for) or
    /// topology [default: as much as can be]
    #[arg(long, value_name = "WHAT", requires = "from")]
    transfer: Option<String>,
    /// Let inputs, outputs and weights go that the new controller does not have
    #[arg(long, requires = "from")]
    allow_loss: bool,
    /// What steps the creatures in training: lanes (many at once) or rapier (one at a time); both give the same bits
    #[arg(long, value_name = "NAME")]
    engine: Option<String>,
    /// How the world varies in training: none, near, pushed, shoved, physics, light (friction, mass, start pose, pushes, and the
    /// stiffness and time step of other engines), bumpy (that, and bumps) or strong (more of it) [default: bumpy for
    /// legs that run, else light; none with --preset plain, thesis and stanley-2002]
    #[arg(long, value_name = "NAME")]
    variation: Option<String>,
    /// What it moves on (see: gambol terrains), and how hard that is, from 0 to 1: gaps, hurdles:0.3 [default: flat]
    #[arg(long, value_name = "NAME[:DIFFICULTY]")]
    terrain: Option<String>,
    /// A configuration file, whole or in part, laid over the preset
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// One setting, such as physics.time_step=0.01; can be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// The seed: the same seed gives the same run to the bit [default: 1]
    #[arg(long)]
    seed: Option<u64>,
    /// Individuals in a generation
    #[arg(long)]
    population: Option<usize>,
    #[command(flatten)]
    limits: Limits,
    /// The folder of the run; it must be new or empty [default: runs/CREATURE-MOVEMENT, numbered]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    flags: RunFlags,
}

/// When a run ends.
#[derive(Args, Clone, Copy)]
pub(super) struct Limits {
    /// End when the run has had so many generations, those before a resume included
    #[arg(long)]
    generations: Option<u64>,
    /// End when the run has had so many evaluations, those before a resume included
    #[arg(long)]
    evaluations: Option<u64>,
    /// End when the run has had so many physics steps, those before a resume included
    #[arg(long)]
    steps: Option<u64>,
    /// End after so many minutes since the start, or since the resume
    #[arg(long, allow_negative_numbers = true)]
    minutes: Option<f64>,
    /// End after so much time since the start, or since the resume, such as 10s, 90s, 5m or 1h
    #[arg(long, value_name = "TIME", value_parser = minutes_of, conflicts_with = "minutes")]
    budget: Option<f64>,
    /// End as soon as the champion's gait is usable (see: gambol gait); exit code 3 if it never is
    #[arg(long, value_name = "WHAT")]
    until: Option<Until>,
    /// End when this fitness is reached
    #[arg(long, allow_hyphen_values = true)]
    target: Option<f64>,
    /// End after so many generations without progress
    #[arg(long, value_name = "GENERATIONS")]
    stagnation: Option<u64>,
}

/// How a run is carried out and shown; none of it changes what is found.
#[derive(Args, Clone, Copy)]
pub(super) struct RunFlags {
    /// Threads [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    threads: usize,
    /// Show nothing but errors
    #[arg(long, short)]
    quiet: bool,
    /// Print each generation, and the result, as a line of JSON
    #[arg(long, conflicts_with = "quiet")]
    json: bool,
    /// Do not make the HTML report at the end
    #[arg(long)]
    no_report: bool,
}

impl Limits {
    /// These limits in place of the planned ones, for a run that may have ended.
    pub(super) fn beyond(self, planned: StopConditions) -> StopConditions {
        planned.resumed_with(self.conditions())
    }

    /// A run until usable goes on to the tier that its movement asks for.
    pub(super) fn until(self, config: &mut RunConfig, registry: &Registry) {
        if self.until.is_some() {
            config.stop.tier = Some(tier_to_reach(config, registry));
        }
    }

    fn conditions(self) -> StopConditions {
        let Self { generations, evaluations, steps, target, stagnation, .. } = self;
        let minutes = self.minutes.or(self.budget);
        let tier = self.until.map(|Until::Usable| USABLE);
        StopConditions { generations, evaluations, steps, minutes, target, tier, stagnation }
    }
}

/// What a run can be ended by besides budgets and fitness.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Until {
    /// The champion's gait is usable.
    Usable,
}

/// A duration as people write it, in minutes.
fn minutes_of(text: &str) -> Result<f64, String> {
    let number_end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(number_end);
    let minutes = match unit.trim() {
        "ms" => 1.0 / 60_000.0,
        "s" => 1.0 / 60.0,
        "m" | "min" => 1.0,
        "h" => 60.0,
        _ => return Err("must be a number and a unit: 500ms, 10s, 5m or 1h".into()),
    };
    let number: f64 = number.parse().map_err(|_| "must begin with a number: 10s, 5m or 1h")?;
    if number > 0.0 { Ok(number * minutes) } else { Err("must be longer than nothing".into()) }
}

impl Train {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let registry = registry.clone();
        let Self {
            creature, movement, preset, strategy, topology_from, engine, variation, terrain, config, set, ..
        } = &self;
        let request = Request {
            creature: creature.clone(),
            movement: movement.clone(),
            further_bodies: self.further_body.clone(),
            preset: preset.clone(),
            strategy: strategy.clone(),
            topology_from: topology_from.as_deref().map(champion_file).transpose()?,
            from: self.from.clone(),
            config: config.clone(),
            seed: self.seed,
            population: self.population,
            limits: self.limits.conditions(),
            set: set.clone(),
            engine: engine.clone(),
            variation: variation.clone(),
            terrain: terrain.clone(),
            unvaried: false,
        };
        let mut config = request.resolve(&registry)?;
        self.limits.until(&mut config, &registry);
        let transferred = self.transferred()?;
        match &self.from {
            // Its name becomes that of a folder.
            Some(_) => drop(Blueprint::new(config.creature.clone())?),
            None => {
                if let Err(error) = Setup::new(&config, &registry) {
                    return Err(located(&error.to_string(), request, &registry).into());
                }
            }
        }
        let made = if self.out.is_none() { Some(NewFolder::make(Path::new("runs"), &config)?) } else { None };
        let folder = self.out.clone().or_else(|| made.as_ref().map(|made| made.path().to_owned())).unwrap_or_default();
        if let Some(source) = &self.from {
            config.origin = None;
            return carry_out(&self.flags, &config, registry, |options, _| {
                Ok(shaping::train_from(&config, source, transferred, self.allow_loss, &folder, options)?)
            });
        }
        carry_out(&self.flags, &config, registry, |options, stage_progress| match config.stages.is_empty() {
            true => Ok(training::train(&config, &folder, options)?),
            false => Ok(shaping::train_stages(&config, &folder, stage_progress, options)?),
        })
    }

    /// What was asked to be transferred.
    fn transferred(&self) -> Result<Option<Transferred>, String> {
        let Some(name) = &self.transfer else { return Ok(None) };
        let all = [Transferred::Population, Transferred::Champion, Transferred::Held, Transferred::Topology];
        let names = all.map(|transferred| transferred.to_string());
        let found = all.into_iter().find(|transferred| transferred.to_string() == *name);
        found
            .map(Some)
            .ok_or_else(|| suggest::unknown("thing to transfer", name, &names.each_ref().map(String::as_str)))
    }
}

/// The error, with the file it is in: the configuration file, if that alone gives the same error.
fn located(error: &str, request: Request, registry: &Registry) -> String {
    let file = request.config.clone();
    let alone = Request {
        further_bodies: Vec::new(),
        seed: None,
        population: None,
        limits: StopConditions::default(),
        set: Vec::new(),
        engine: None,
        variation: None,
        terrain: None,
        ..request
    }
    .resolve(registry);
    let same = alone.is_ok_and(|config| Setup::new(&config, registry).is_err_and(|found| found.to_string() == error));
    file.filter(|_| same).map_or_else(|| error.to_owned(), |file| format!("{}: {error}", file.display()))
}

/// Runs what `start` starts, with progress shown, Ctrl-C caught, and a report at the end.
pub(super) fn carry_out(
    flags: &RunFlags,
    config: &RunConfig,
    registry: Registry,
    start: impl FnOnce(TrainOptions<'_>, StageProgress<'_>) -> Result<training::Outcome, Box<dyn std::error::Error>>,
) -> Outcome {
    let signal = StopSignal::default();
    super::interrupt::stop_on_interrupt(&signal)?;
    let show = RefCell::new(Show::new(flags.quiet, flags.json, config, &registry));
    let began = Instant::now();
    let options = TrainOptions {
        threads: flags.threads,
        registry: registry.clone(),
        signal,
        on_generation: &mut |generation| show.borrow_mut().generation(generation.report),
    };
    let stages = config.stages.len();
    let ended = start(
        options,
        StageProgress { on_stage_run: &mut |stage, origin| show.borrow_mut().leg(stage, stages, origin) },
    );
    let mut show = show.into_inner();
    show.end();
    let outcome = match ended {
        Ok(outcome) => outcome,
        Err(error) => nothing_left_to_do(&*error, flags.no_report).ok_or(error)?,
    };
    let seconds = began.elapsed().as_secs_f64();
    if !flags.no_report {
        report::write_report(&outcome.folder, &registry, Some(outcome.reason))?;
    }
    let until_usable = config.stop.tier.is_some();
    // Judging takes a whole episode, which quiet runs save.
    let judged = outcome.champion.as_ref().filter(|_| !flags.quiet || until_usable);
    let verdict = judged.and_then(|champion| verdict(champion, &registry));
    let usable = verdict.as_ref().is_some_and(|verdict| verdict.usable);
    // What cannot be read again was trained all the same.
    let too_early = usable && !shaping::is_of_goal(&outcome.folder, &registry).unwrap_or(true);
    let verdict = verdict.as_ref();
    show.result(&Ended { outcome: &outcome, verdict, too_early, seconds, report: !flags.no_report })?;
    if outcome.champion.is_none() && outcome.progress.generations > 0 && outcome.reason != StopReason::Interrupted {
        return Err(no_champion(&outcome.folder));
    }
    Ok(match outcome.reason {
        StopReason::Interrupted => ExitCode::from(INTERRUPTED),
        _ if until_usable && (!usable || too_early) => ExitCode::from(NOT_USABLE),
        _ => ExitCode::SUCCESS,
    })
}

/// The outcome of a run that has ended, if it has found what it looked for, or was killed after its last save and before its
/// report.
fn nothing_left_to_do(error: &(dyn std::error::Error + 'static), no_report: bool) -> Option<training::Outcome> {
    let over = error.downcast_ref::<TrainError>().or_else(|| match error.downcast_ref()? {
        ShapingError::Train(error) => Some(error),
        _ => None,
    })?;
    let TrainError::Over { folder, reason, generations } = over else { return None };
    if *reason != StopReason::Tier && (no_report || report::is_up_to_date(folder, *generations)) {
        return None;
    }
    // What cannot be read leaves it at the error.
    shaping::outcome_of(folder, *reason).ok()
}

/// What `gambol gait` says of a champion; `None` if gaits of its movement are not judged.
fn verdict(champion: &Champion, registry: &Registry) -> Option<Judgement> {
    let rules = registry.movements.rules(&champion.movement.name)?;
    let nothing_to_measure = || {
        let reasons = vec![Reason::TooShort { seconds: 0.0, required: rules.seconds() }];
        Judgement { usable: false, reasons, best_flight: None, near_worlds: None }
    };
    let report = gait::judge(champion, registry).ok();
    Some(report.and_then(|report| report.verdict).unwrap_or_else(nothing_to_measure))
}
