use super::{INTERRUPTED, Outcome};
use crate::{
    Registry,
    request::Request,
    training::{TrainOptions, train},
};
use clap::Args;
use ne_core::{Fitness, Parallel, StopReason, StopSignal};
use serde::Serialize;
use serde_json::json;
use std::{error::Error, process::ExitCode, time::Instant};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol bench training                                             four creatures, 300 generations each
  gambol bench training --creature biped-1 --generations 50 --engine rapier

Each creature learns to run with the default preset, from the start to the saved champion, in a temporary folder. Steps \
of the champion selection, which chooses the champion, are in the seconds and not in the steps.")]
pub(super) struct Training {
    /// A shipped creature's name or a creature file; can be given several times [default: biped-1, apod, tetrapod-2,
    /// decapod-2]
    #[arg(long, value_name = "NAME")]
    creature: Vec<String>,
    /// Generations of each run
    #[arg(long, default_value_t = 300)]
    generations: u64,
    /// Steps of an episode
    #[arg(long, default_value_t = 2000)]
    steps: u32,
    /// What steps the creatures in training: lanes, rapier
    #[arg(long, value_name = "NAME", default_value = "lanes")]
    engine: String,
    /// Threads [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    threads: usize,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
}

/// What one run took.
#[derive(Serialize)]
struct Run {
    creature: String,
    seconds: f64,
    generations: u64,
    generations_per_second: f64,
    /// Physics steps of training.
    steps: u64,
    microseconds_per_step_and_core: f64,
    /// Of the champion, in rapier, without variation.
    fitness: Option<f64>,
    /// Of the champion, in its generation.
    fitness_in_training: Option<f64>,
}

impl Training {
    pub(super) fn run(self, registry: &Registry) -> Outcome {
        let usual = ["biped-1", "apod", "tetrapod-2", "decapod-2"].map(String::from);
        let creatures = if self.creature.is_empty() { usual.into() } else { self.creature.clone() };
        let threads = Parallel::new(self.threads)?.threads();
        let (generations, steps, engine) = (self.generations, self.steps, &self.engine);
        let signal = StopSignal::default();
        super::interrupt::stop_on_interrupt(&signal)?;
        let mut runs = Vec::new();
        for creature in creatures {
            if !self.json {
                tell!("{creature} learns running");
            }
            match self.measure(creature, threads, registry, &signal)? {
                Some(run) => runs.push(run),
                None => return Ok(ExitCode::from(INTERRUPTED)),
            }
        }
        if self.json {
            say!("{}", json!({ "engine": engine, "threads": threads, "episode_steps": steps, "runs": runs }))?;
            return Ok(ExitCode::SUCCESS);
        }
        say!("{generations} generations, episodes of {steps} steps, in {engine}, {threads} threads\n")?;
        say!(
            "{:<12} {:>9} {:>14} {:>20} {:>13} {:>15}",
            "",
            "seconds",
            "generations/s",
            "µs per step and core",
            "m, in rapier",
            "m, in training"
        )?;
        for run in runs {
            let metres = |fitness: Option<f64>| fitness.map_or_else(|| "–".into(), |fitness| format!("{fitness:.2}"));
            let Run { creature, seconds, generations_per_second, microseconds_per_step_and_core, .. } = run;
            let (rapier, training) = (metres(run.fitness), metres(run.fitness_in_training));
            say!(
                "{creature:<12} {seconds:>9.2} {generations_per_second:>14.1} {microseconds_per_step_and_core:>20.3} \
                 {rapier:>13} {training:>15}"
            )?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// `None`: it was interrupted.
    fn measure(
        &self,
        creature: String,
        threads: usize,
        registry: &Registry,
        signal: &StopSignal,
    ) -> Result<Option<Run>, Box<dyn Error>> {
        let registry = registry.clone();
        let request = Request {
            creature: Some(creature.clone()),
            movement: Some("running".into()),
            engine: Some(self.engine.clone()),
            ..Request::default()
        };
        let mut config = request.resolve(&registry)?;
        config.stop.generations = Some(self.generations);
        config.movement.steps = Some(self.steps);
        config.training_steps = None;
        let folder = tempfile::tempdir()?;
        let options =
            TrainOptions { threads: self.threads, registry, signal: signal.clone(), on_generation: &mut |_| {} };
        let began = Instant::now();
        let outcome = train(&config, &folder.path().join("run"), options)?;
        if outcome.reason == StopReason::Interrupted {
            return Ok(None);
        }
        let seconds = began.elapsed().as_secs_f64();
        let (progress, champion) = (outcome.progress, outcome.champion);
        let trained = champion.as_ref().and_then(|champion| champion.trained);
        Ok(Some(Run {
            creature,
            seconds,
            generations: progress.generations,
            generations_per_second: progress.generations as f64 / seconds,
            steps: progress.steps,
            microseconds_per_step_and_core: seconds * 1e6 * threads as f64 / progress.steps as f64,
            fitness: champion.map(|champion| champion.fitness.get()),
            fitness_in_training: trained.and_then(|trained| trained.fitness).map(Fitness::get),
        }))
    }
}
