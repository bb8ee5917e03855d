//! What is read.

use crate::corpus;
use creatures::{Blueprint, DEFAULT_INPUT_RANGE, Motors, Senses};
use gambol::{
    Registry, Setup, champion::Champion, front::Front, request::Request, run_folder::RunFolder, shaping::Stages,
    source, trajectory::read_csv,
};
use ne_core::{Seed, Strategy};
use std::{error::Error, fs, path::Path, sync::OnceLock};
use tasks::Body;

type Outcome = Result<(), Box<dyn Error>>;

/// A reader, with the folder of the corpus that has its files.
pub(crate) struct Reader {
    pub(crate) name: &'static str,
    /// Reads the file at a path; `name` is that of the file in the corpus it began as. What is wrong is an error.
    pub(crate) read: fn(path: &Path, name: &str, registry: &Registry) -> Outcome,
    /// Whether each line has a digest of its own.
    pub(crate) has_lines: bool,
}

pub(crate) const ALL: &[Reader] = &[
    Reader { name: "creatures", read: creature, has_lines: false },
    Reader { name: "configurations", read: configuration, has_lines: false },
    Reader { name: "champions", read: champion, has_lines: false },
    Reader { name: "checkpoints", read: checkpoint, has_lines: false },
    Reader { name: "fronts", read: front, has_lines: false },
    Reader { name: "trajectories", read: trajectory, has_lines: false },
    Reader { name: "lines", read: lines, has_lines: true },
];

fn creature(path: &Path, _: &str, _: &Registry) -> Outcome {
    let blueprint = Blueprint::new(source::creature_file(path)?)?;
    Senses::new(&blueprint, &blueprint.creature().sensors, DEFAULT_INPUT_RANGE)?;
    let _ = Motors::new(&blueprint);
    Ok(())
}

/// As `--config` reads it, with its stages; no world is built.
fn configuration(path: &Path, _: &str, registry: &Registry) -> Outcome {
    let config = Request { config: Some(path.into()), ..Request::default() }.resolve(registry)?;
    registry.strategies.check(&config.strategy)?;
    if is_one_of_many(path)? {
        match config.stages.is_empty() {
            true => drop(Setup::new(&config, registry)?),
            false => drop(Stages::new(&config, registry)?),
        }
    }
    Ok(())
}

fn champion(path: &Path, _: &str, registry: &Registry) -> Outcome {
    let champion = Champion::read(path)?;
    if is_one_of_many(path)? {
        champion.episode(registry)?;
    }
    Ok(())
}

/// Worlds take their time, and are built for a few.
fn is_one_of_many(path: &Path) -> std::io::Result<bool> {
    Ok(fs::metadata(path)?.len().is_multiple_of(32))
}

/// And asks the strategy for a generation, as resuming would.
fn checkpoint(path: &Path, name: &str, registry: &Registry) -> Outcome {
    let strategy = name.split('.').next().unwrap_or_default();
    let entry = registry.strategies.find(strategy).ok_or("no such strategy")?;
    let mut checkpoint = entry.read_checkpoint(path)?;
    checkpoint.strategy.ask(Seed::of_run(1).generation(7));
    Ok(())
}

fn front(path: &Path, _: &str, _: &Registry) -> Outcome {
    Front::read(path)?;
    Ok(())
}

fn trajectory(path: &Path, _: &str, _: &Registry) -> Outcome {
    static BODY: OnceLock<Option<Body>> = OnceLock::new();
    let body = BODY.get_or_init(|| corpus::body().ok()).as_ref().ok_or("no body")?;
    let text = fs::read(path)?;
    read_csv(&String::from_utf8_lossy(&text), body)?.trajectory(body)?;
    Ok(())
}

fn lines(path: &Path, name: &str, _: &Registry) -> Outcome {
    let folder = RunFolder::at(path.parent().ok_or("no folder")?);
    fs::rename(path, folder.path().join(name))?;
    let read = match name {
        "log.jsonl" => folder.read_log().map(drop),
        "gallery.jsonl" => folder.read_gallery().map(drop),
        _ => folder.read_timing().map(drop),
    };
    Ok(read?)
}
