//! The report: one HTML file that works offline, with the champion's replay, its gait measured and
//! judged, the fitness curves, the front of compromises, the species, the gait as it emerged and the net at work.

mod data;
mod divergence;
mod front;
mod gait;
mod history;
mod page;
mod replays;
mod stages;

use crate::page::ground::GroundData;
use crate::{drawing::DrawingError, sheet};
use data::{ChampionData, Command, Fact, MovementData, Report, Summary};
use front::FrontData;
use gait::GaitData;
use gambol_runs::{Registry, program_name, texts::shell_word};
use gambol_runs::{
    champion::Champion,
    episode_parts::SetupError,
    front::Front,
    judge::Judge,
    recorder::{check_lines, read_champion},
    run_folder::{FolderError, GalleryEntry, GalleryKind, GalleryMember, RunFolder},
    trajectory::Recording,
};
use ne_core::{StopReason, archive};
use replays::{Stills, play};
use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};
use tasks::gait::View;

/// Why a report cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The run cannot be read.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The champion's task cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The contact sheet of the champion's gait cannot be drawn.
    #[error(transparent)]
    Sheet(#[from] DrawingError),
    /// The page cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The page.
        path: std::path::PathBuf,
        /// The reason.
        source: io::Error,
    },
}

/// From where to where ground is drawn, m.
const DRAWN: [f32; 2] = [-60.0, 250.0];
/// How many champions the strip shows.
const STRIP: usize = 8;
/// How many generations show their whole population.
const POPULATIONS: usize = 6;

/// Makes the report of a run and writes it into its folder. `ended`: why the run ended, if it has.
///
/// # Errors
/// If a file of the run cannot be read, or the page cannot be written.
pub fn write_report(folder: &RunFolder, registry: &Registry, ended: Option<StopReason>) -> Result<(), ReportError> {
    let _span = tracing::debug_span!("report").entered();
    let config = folder.read_config()?;
    // A curriculum that is listed nowhere has stages all the same.
    let report = match config.stages.is_empty() && !folder.stages().is_dir() {
        true => compose(folder, registry, ended)?,
        false => stages::compose(folder, &config, registry, ended)?,
    };
    write_page(&folder.report(), &report)
}

/// Whether the report in a run's folder was made of the run as it ended; a process that was killed may have left none, or one of
/// an earlier state.
pub fn is_up_to_date(folder: &RunFolder, generations: u64) -> bool {
    // The page says so in its first lines.
    let mut beginning = Vec::new();
    let read = File::open(folder.report()).and_then(|page| page.take(2048).read_to_end(&mut beginning));
    read.is_ok() && page::shows(&String::from_utf8_lossy(&beginning), &page::state(generations, true))
}

/// The report of a run with one task.
fn compose(folder: &RunFolder, registry: &Registry, ended: Option<StopReason>) -> Result<Report, ReportError> {
    let config = folder.read_config()?;
    if folder.checkpoint().is_file() {
        check_lines(folder, &config)?;
    }
    let (log, gallery) = (folder.read_log()?, folder.read_gallery()?);
    let champion = read_champion(folder, &config)?;
    let setup = gambol_runs::setup::Setup::new(&config, registry)?;
    let stills = Stills::new(&setup, config.seed);
    let newest = champion.as_ref().filter(|_| setup.reference.is_some()).map(gallery_entry);
    let mut champions: Vec<_> = gallery.iter().filter(|entry| entry.kind == GalleryKind::Champion).collect();
    let is_new = |entry: &&GalleryEntry| champions.last().is_none_or(|last| last.members != entry.members);
    // One that was chosen at the end of the run, between two re-evaluations, is in no gallery.
    champions.extend(newest.as_ref().filter(is_new));
    let populations: Vec<_> = gallery.iter().filter(|entry| entry.kind == GalleryKind::Population).collect();
    let movement = movement_data(registry, &config.movement.name, &setup.unit);
    let last = log.last();
    let diverged = champion.as_ref().is_some_and(Champion::diverged);
    let fitness = match &champion {
        // The log knows the newest champion, but only as training knew it.
        Some(champion) if diverged || setup.reference.is_some() => Some(champion.fitness),
        _ => last.and_then(|last| last.best_so_far),
    };
    let champion_data = champion.as_ref().map(|champion| champion_data(champion, registry)).transpose()?;
    Ok(Report {
        title: format!("{} · {} · Gambol", config.creature.name, config.movement.name),
        creature: config.creature.clone(),
        movement,
        summary: last.map(|last| Summary {
            fitness: fitness.map(f64::from),
            fitness_in_training: champion.as_ref().and_then(Champion::fitness_in_training).map(f64::from),
            judged: config.has_champion_selection(),
            warning: divergence::warning(&log, diverged),
            generations: last.generation,
            evaluations: last.evaluations,
            physics_steps: last.steps,
            stopped_because: ended.map(|reason| reason.to_string()),
            body_lengths_per_second: champion_data.as_ref().and_then(|champion| champion.body_lengths_per_second),
        }),
        stages: Vec::new(),
        history: history::points(&log, fitness),
        species: history::species(&log),
        statistics: history::statistics(&log),
        gait: champion.as_ref().map(|champion| gait_data(champion, registry)).transpose()?.flatten(),
        champion: champion_data,
        front: front_data(folder, &stills)?,
        ground: GroundData::new(setup.episode.environment().ground(), DRAWN),
        strip: stills.champions(&spread(&champions, STRIP)),
        populations: stills.populations(&spread(&populations, POPULATIONS)),
        settings: data::settings(&config, registry),
        config: serde_json::to_value(&config).unwrap_or_default(),
        commands: commands(folder),
        versions: data::versions(),
    })
}

/// Makes a page that replays a champion, and nothing else: in the world in which its gait is judged, for so many steps, or
/// for as long as it is judged. No term ends it.
///
/// # Errors
/// If the champion's task cannot be built, or the page cannot be written.
pub fn write_replay(
    champion: &Champion,
    registry: &Registry,
    steps: Option<u32>,
    path: &Path,
) -> Result<(), ReportError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    let steps = steps.unwrap_or(judge.steps());
    let (recording, _) = Recording::play(judge.environment(), &champion.network, steps);
    let body_length = judge.environment().blueprint().body_length();
    let unit = registry.movements.find(&champion.movement.name).map_or_else(String::new, |entry| entry.unit.clone());
    let report = Report {
        title: format!("{} · {} · Gambol", champion.creature.name, champion.movement.name),
        creature: champion.creature.clone(),
        movement: movement_data(registry, &champion.movement.name, &unit),
        summary: None,
        stages: Vec::new(),
        history: Vec::new(),
        species: Vec::new(),
        statistics: Vec::new(),
        champion: Some(ChampionData::new(champion, &recording, body_length, covers_distance(champion, registry))),
        ground: GroundData::new(judge.environment().ground(), DRAWN),
        gait: gait_data(champion, registry)?,
        front: None,
        strip: Vec::new(),
        populations: Vec::new(),
        settings: vec![
            Fact::new("Creature", &champion.creature.name),
            Fact::new("Movement", &champion.movement.name),
            Fact::new("Fitness", fitness(champion, &unit)),
            match champion.generation {
                0 => Fact::new("Found", "before its run"),
                found => Fact::new("Found in generation", found),
            },
            Fact::new("Strategy", &champion.strategy),
            Fact::new("Net", champion.network.topology()),
            Fact::new("Terrain", data::terrain(&champion.terrain, &champion.physics)),
            Fact::new("Physics", format!("{} {}", champion.engine.name, champion.engine.version)),
        ],
        config: serde_json::Value::Null,
        commands: Vec::new(),
        versions: data::versions(),
    };
    write_page(path, &report)
}

fn fitness(champion: &Champion, unit: &str) -> String {
    let trained = champion.fitness_in_training();
    let trained = trained.map_or_else(String::new, |fitness| format!(" ({fitness:.3} {unit} in training)"));
    format!("{:.3} {unit}{trained}", champion.fitness)
}

fn gallery_entry(champion: &Champion) -> GalleryEntry {
    let member = GalleryMember { fitness: Some(champion.fitness), network: champion.network.clone() };
    GalleryEntry { generation: champion.generation, kind: GalleryKind::Champion, members: vec![member] }
}

fn write_page(path: &Path, report: &Report) -> Result<(), ReportError> {
    let page = page::render(report);
    archive::write_whole(path, page.as_bytes()).map_err(|source| ReportError::Write { path: path.into(), source })
}

fn movement_data(registry: &Registry, name: &str, unit: &str) -> MovementData {
    let description = registry.movements.find(name).map_or_else(String::new, |entry| entry.description.clone());
    MovementData { name: name.into(), unit: unit.into(), description }
}

fn champion_data(champion: &Champion, registry: &Registry) -> Result<ChampionData, ReportError> {
    let episode = champion.episode(registry)?;
    let recording = play(&episode, champion.network.clone(), champion.seed, episode.steps());
    let body_length = episode.environment().blueprint().body_length();
    Ok(ChampionData::new(champion, &recording, body_length, covers_distance(champion, registry)))
}

/// Whether the gaits of its movement are judged by the way they make forwards on the ground.
fn covers_distance(champion: &Champion, registry: &Registry) -> bool {
    let rules = registry.movements.rules(&champion.movement.name);
    rules.is_some_and(|rules| rules.view() == View::default())
}

/// The champion's first seconds, small.
fn champion_film(champion: &Champion, registry: &Registry) -> Result<data::Replay, ReportError> {
    let episode = champion.episode(registry)?;
    Ok(replays::film(&episode, champion.network.clone(), champion.seed))
}

fn gait_data(champion: &Champion, registry: &Registry) -> Result<Option<GaitData>, ReportError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    let Some(gait) = judge.measure(&champion.network) else { return Ok(None) };
    let sheet = sheet::of_champion(champion, &gait.report, registry)?;
    Ok(Some(GaitData::new(gait, &sheet)))
}

fn front_data(folder: &RunFolder, stills: &Stills<'_>) -> Result<Option<FrontData>, ReportError> {
    if !folder.front().is_file() {
        return Ok(None);
    }
    let front = Front::read(&folder.front()).map_err(FolderError::from)?;
    let command = format!("{} replay {} --trajectory gait.csv --point", program_name(), shell_word(folder.path()));
    Ok(FrontData::new(&front, stills, command))
}

/// About `count` of the items, evenly spread, the first and the last among them.
fn spread<'a, T>(items: &[&'a T], count: usize) -> Vec<&'a T> {
    if items.len() <= count {
        return items.to_vec();
    }
    (0..count).map(|index| items[index * (items.len() - 1) / (count - 1)]).collect()
}

fn commands(folder: &RunFolder) -> Vec<Command> {
    let (program, path) = (program_name(), shell_word(folder.path()));
    let (config, champion) = (shell_word(&folder.config()), shell_word(&folder.champion()));
    [
        ("Repeat this run", format!("{program} train --config {config} --out again")),
        ("Go on training", format!("{program} resume {path} --generations 1000")),
        ("Measure the gait", format!("{program} gait {path}")),
        ("Prove the champion", format!("{program} verify {champion}")),
        ("Take the trajectory", format!("{program} replay {champion} --trajectory gait.csv")),
    ]
    .map(|(what, command)| Command { what: what.into(), command })
    .into()
}
