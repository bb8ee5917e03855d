//! Files that are whole, small and different, to begin with.

use gambol::{
    Registry, Setup,
    champion::Champion,
    config::{EngineChoice, RunConfig},
    judge::Judge,
    training::{TrainOptions, train},
    trajectory::Recording,
};
use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};
use tasks::{Body, Environment, TermSpec};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus")
}

/// The files of a reader by their names, in the order of these.
pub(crate) fn files(reader: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
    let folder = folder().join(reader);
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(&folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        files.push((entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path()).map_err(failed)?));
    }
    files.sort();
    Ok(files)
}

/// Writes the corpus anew from tiny runs. Creatures stay: they are written by hand.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let place = tempfile::tempdir()?;
    for strategy in ["conventional", "neat", "cma-es", "open-es", "cosyne", "nsga2"] {
        let (config, run) = (tiny(strategy)?, place.path().join(strategy));
        let options = TrainOptions {
            threads: 1,
            registry: Registry::default(),
            signal: Default::default(),
            on_generation: &mut |_| {},
        };
        train(&config, &run, options)?;
        keep(&run.join("checkpoint"), "checkpoints", &format!("{strategy}.checkpoint"))?;
        if ["neat", "cma-es"].contains(&strategy) {
            keep(&run.join("champion.json"), "champions", &format!("{strategy}.json"))?;
            keep(&run.join("config.json"), "configurations", &format!("{strategy}.json"))?;
        }
        if strategy == "cma-es" {
            let trajectories = folder().join("trajectories");
            fs::create_dir_all(&trajectories)?;
            fs::write(trajectories.join("gait.csv"), csv(&Champion::read(&run.join("champion.json"))?)?)?;
        }
        if strategy == "neat" {
            for name in ["log.jsonl", "gallery.jsonl", "timing.jsonl"] {
                keep(&run.join(name), "lines", name)?;
            }
        }
        if strategy == "nsga2" {
            keep(&run.join("front.json"), "fronts", "front.json")?;
        }
    }
    Ok(())
}

/// The first steps of a champion.
fn csv(champion: &Champion) -> Result<Vec<u8>, Box<dyn Error>> {
    let judge = Judge::new(champion.episode_parts(), &Registry::default())?;
    let (recording, _) = Recording::play(judge.environment(), &champion.network, 12);
    let mut csv = Vec::new();
    recording.write_csv(&body()?, &mut csv)?;
    Ok(csv)
}

/// The body of the runs.
pub(crate) fn body() -> Result<Body, Box<dyn Error>> {
    let setup = Setup::new(&tiny("cma-es")?, &Registry::default())?;
    Ok(setup.episode.environment().body().ok_or("no body")?.clone())
}

fn keep(file: &Path, reader: &str, name: &str) -> Result<(), Box<dyn Error>> {
    let folder = folder().join(reader);
    fs::create_dir_all(&folder)?;
    fs::copy(file, folder.join(name))?;
    Ok(())
}

/// A run whose files are small: a body of three parts, few neurons, few individuals, two generations.
fn tiny(strategy: &str) -> Result<RunConfig, Box<dyn Error>> {
    let registry = Registry::default();
    let creature = gambol::source::creature_file(&folder().join("creatures/hopper.json"))?;
    let mut config = registry.config("default", creature, "jumping")?;
    config.strategy = registry.strategies.find(strategy).ok_or("no such strategy")?.settings();
    config.strategy.set_population(if strategy == "neat" { 10 } else { 4 });
    config.engine = EngineChoice::Rapier;
    config.controller.hidden = vec![2];
    config.controller.modular = None;
    config.movement.steps = Some(20);
    config.stop.generations = Some(2);
    config.record.checkpoint_every = 3;
    config.record.populations_at = vec![1];
    if strategy == "nsga2" {
        config.movement.objectives = vec![TermSpec::new("jumping", 1.0), TermSpec::new("energy", -0.5)];
    }
    Ok(config)
}
