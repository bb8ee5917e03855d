//! The page of a run with stages: that of the stage whose champion is the run's, with the curves of all and a film of each champion.

use super::{
    DRAWN, ReportError, champion_film,
    data::{Fact, Replay, Report, Summary},
    history,
};
use crate::page::ground::GroundData;
use creatures::Creature;
use gambol_runs::Registry;
use gambol_runs::{
    config::{RunConfig, StageSettings},
    recorder::{check_lines, read_champion},
    run_folder::{FolderError, RunFolder},
    shaping::{self, StageRun},
};
use ne_core::{StopReason, promotion::Decision};
use serde::Serialize;

/// A stage run of the way through the stages.
#[derive(Serialize)]
pub(super) struct StageData {
    /// The stage's number, from 1.
    number: usize,
    name: String,
    /// The generations of the run that were its, counted through all stages; none before the first was done.
    first_generation: u64,
    last_generation: u64,
    fitness: Option<f64>,
    unit: String,
    facts: Vec<Fact>,
    /// The champion's first seconds.
    film: Option<Replay>,
    /// What it moves on; `None`: flat ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    ground: Option<GroundData>,
    /// Its body, if that is another than the run's.
    #[serde(skip_serializing_if = "Option::is_none")]
    creature: Option<Creature>,
}

/// The report of a run with stages.
pub(super) fn compose(
    folder: &RunFolder,
    config: &RunConfig,
    registry: &Registry,
    ended: Option<StopReason>,
) -> Result<Report, ReportError> {
    let stage_runs = shaping::stage_runs(folder)?;
    let Some(shown) = shaping::leading(&stage_runs).or(stage_runs.last()) else {
        let missing = "stage that has begun".into();
        return Err(FolderError::NotARun { path: folder.path().into(), missing }.into());
    };
    let mut report = super::compose(&RunFolder::at(&shown.folder), registry, ended)?;
    let (mut generations, mut evaluations, mut steps) = (0, 0, 0);
    report.history.clear();
    for stage_run in &stage_runs {
        let stage_folder = RunFolder::at(&stage_run.folder);
        check_lines(&stage_folder, &stage_folder.read_config()?)?;
        let log = stage_folder.read_log()?;
        report.history.extend(history::points(&log, None).into_iter().map(|point| point.after(generations)));
        let data = stage(stage_run, &stage_folder, config, generations, log.len() as u64, registry)?;
        report.stages.push(data);
        generations += log.len() as u64;
        evaluations += log.last().map_or(0, |last| last.evaluations);
        steps += log.last().map_or(0, |last| last.steps);
    }
    // The numbers of strategies and species are each stage's own; they are in its own report.
    (report.species, report.statistics) = (Vec::new(), Vec::new());
    report.summary =
        report.summary.map(|summary| Summary { generations, evaluations, physics_steps: steps, ..summary });
    report.config = serde_json::to_value(config).unwrap_or_default();
    report.commands = super::commands(folder);
    Ok(report)
}

fn stage(
    stage_run: &StageRun,
    folder: &RunFolder,
    run: &RunConfig,
    before: u64,
    generations: u64,
    registry: &Registry,
) -> Result<StageData, ReportError> {
    let config = folder.read_config()?;
    let champion = read_champion(folder, &config)?;
    let ground = champion.as_ref().map(|champion| champion.episode(registry)).transpose()?;
    let ground = ground.and_then(|episode| GroundData::new(episode.environment().ground(), DRAWN));
    let film = champion.as_ref().map(|champion| champion_film(champion, registry)).transpose()?;
    Ok(StageData {
        number: stage_run.stage + 1,
        name: stage_run.name.clone(),
        first_generation: before + 1,
        last_generation: before + generations,
        fitness: champion.as_ref().map(|champion| champion.fitness.get()),
        unit: registry.movements.find(&config.movement.name).map_or_else(String::new, |entry| entry.unit.clone()),
        facts: facts(stage_run, &config, run.stages.get(stage_run.stage)),
        film,
        ground,
        creature: (config.creature != run.creature).then(|| config.creature.clone()),
    })
}

fn facts(stage_run: &StageRun, config: &RunConfig, settings: Option<&StageSettings>) -> Vec<Fact> {
    let rule = settings.and_then(|settings| settings.promotion.as_ref());
    let ended = match stage_run.decision {
        Decision::Promote => "passed",
        Decision::Demote => "sent back to the stage before",
        Decision::GiveUp => "given up; another began anew",
        Decision::Stay if rule.is_some() => "not passed when the run ended",
        Decision::Stay => "went on until the run ended",
    };
    let mut facts = vec![Fact::new("Movement", &config.movement.name)];
    facts.extend(rule.map(|rule| Fact::new("Passed with", rule)));
    facts.extend(settings.and_then(|settings| settings.give_up.as_ref()).map(|give_up| Fact::new("Or else", give_up)));
    facts.push(Fact::new("Result", ended));
    facts.push(Fact::new("Evaluations", stage_run.progress.evaluations));
    facts.extend(config.origin.as_ref().map(|origin| Fact::new("Kept", origin)));
    facts
}
