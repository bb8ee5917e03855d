use super::{
    Beginning, Curriculum, PlannedStage, ShapingError, StageRun,
    transfer::{TransferError, TransferOptions, check_planned},
};
use crate::Registry;
use crate::{
    assembly::{Assembly, ConfigError},
    champion_selection::highest_tier,
    config::{GiveUp, RunConfig, StageSettings, Transferred},
    defaults,
    episode_parts::SetupError,
    setup::Setup,
    tiers::USABLE,
};
use creatures::Sensor;
use envs_core::Variation;
use ne_core::{
    SettingError,
    field_path::{self, FieldError},
    promotion::{Decision, Promotion, PromotionRule, StageState},
};
use serde_json::{Value, json};
use std::sync::Arc;

/// The stages of a configuration, in their order: a stage that is passed is followed by the next, one that is left by the
/// one before.
#[derive(Clone, Debug)]
pub struct Stages {
    stages: Vec<(StageSettings, RunConfig)>,
}

/// What is wrong with a stage. The message begins with its number and name.
#[derive(Debug, thiserror::Error)]
#[error("stages[{index}] (\"{name}\"): {problem}")]
pub struct StageError {
    /// Which, from 0.
    pub index: usize,
    /// Its name.
    pub name: String,
    /// What is wrong.
    pub problem: StageProblem,
}

/// What can be wrong with a stage.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StageProblem {
    /// A field is unknown, missing or of the wrong type.
    #[error("changes.{0}")]
    Config(#[from] ConfigError),
    /// A number is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// It cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Nothing can be transferred to it.
    #[error(transparent)]
    Transfer(#[from] TransferError),
    /// Nothing can be transferred back from it to the stage before.
    #[error("demotion: {0}")]
    Demotion(Box<TransferError>),
}

impl Stages {
    /// The stages of a configuration, each checked: that it can be built, that it can be left, and that its rules ask for
    /// what there is.
    ///
    /// # Errors
    /// Names the stage and the field.
    pub fn new(config: &RunConfig, registry: &Registry) -> Result<Self, StageError> {
        let mut stages: Vec<(StageSettings, RunConfig)> = Vec::new();
        let mut before = RunConfig { stages: Vec::new(), origin: None, ..config.clone() };
        let mut setup_before: Option<Setup> = None;
        for (index, settings) in config.stages.iter().enumerate() {
            let wrong = |problem: StageProblem| StageError { index, name: settings.name.clone(), problem };
            check_name(settings, &stages).map_err(|error| wrong(error.into()))?;
            let changed = resolve(&before, settings, registry).map_err(wrong)?;
            let resolved = in_its_worlds(&changed, settings);
            let setup = Setup::new(&resolved, registry).map_err(|error| wrong(error.into()))?;
            let place = (index == 0, index + 1 == config.stages.len());
            check_rules(settings, &setup, place).map_err(|error| wrong(error.into()))?;
            check_giving_up(settings, &stages).map_err(|error| wrong(error.into()))?;
            if let Some(setup_before) = &setup_before {
                let how = TransferOptions { transferred: settings.transfer, allow_loss: settings.allow_loss };
                let (earlier, this) = ((&before.strategy, setup_before), (&resolved.strategy, &setup));
                check_planned(earlier, this, how, &registry.strategies).map_err(|error| wrong(error.into()))?;
                if settings.demotion.is_some() {
                    check_planned(this, earlier, BACK, &registry.strategies)
                        .map_err(|error| wrong(StageProblem::Demotion(error.into())))?;
                }
            }
            stages.push((within_reach(settings, &setup), resolved));
            setup_before = Some(setup);
            before = changed;
        }
        Ok(Self { stages })
    }

    /// The stages of a configuration that has some.
    pub(super) fn listed(config: &RunConfig, registry: &Registry) -> Result<Self, ShapingError> {
        match config.stages.is_empty() {
            true => Err(ShapingError::NoStages),
            false => Ok(Self::new(config, registry)?),
        }
    }

    /// Where the stage after this one begins: at the end of the best of several attempts, else of the last stage run that was passed.
    fn end_of(&self, stage: usize, stage_runs: &[StageRun]) -> Beginning {
        let gives_up = self.stages.get(stage).is_some_and(|(settings, _)| settings.give_up.is_some());
        let mut of_stage = attempts(stage, stage_runs);
        let end = match gives_up {
            true => of_stage.max_by_key(|stage_run| stage_run.champion),
            false => of_stage.rfind(|stage_run| stage_run.decision == Decision::Promote),
        };
        end.map_or(Beginning::Before, |stage_run| Beginning::After(stage_run.number))
    }

    /// Whether a stage, by its index, learns what the whole run is for: no later one changes what is learned. An index without a stage
    /// does not.
    pub fn is_goal(&self, stage: usize) -> bool {
        let changes = |(settings, _): &(StageSettings, RunConfig)| {
            !settings.changes.is_empty() || !settings.add_sensors.is_empty()
        };
        stage < self.stages.len() && !self.stages[stage + 1..].iter().any(changes)
    }

    /// How an attempt at this stage is given up; `None`: it is not, or all attempts are over.
    fn give_up(&self, stage: usize, stage_runs: &[StageRun]) -> Option<&GiveUp> {
        let give_up = self.stages.get(stage)?.0.give_up.as_ref()?;
        // A later stage was visited since: these are new attempts.
        let mut since = stage_runs.iter().rev().take_while(|stage_run| stage_run.stage != stage);
        if since.any(|stage_run| stage_run.stage > stage) {
            return Some(give_up);
        }
        let given_up = attempts(stage, stage_runs).filter(|stage_run| stage_run.decision == Decision::GiveUp);
        (given_up.count() <= give_up.times as usize).then_some(give_up)
    }

    /// The index of a stage, where it begins, and with what.
    fn beginning(&self, stage: usize, stage_runs: &[StageRun]) -> Option<(usize, Beginning, TransferOptions)> {
        let (settings, _) = self.stages.get(stage)?;
        let begins = stage.checked_sub(1).map_or(Beginning::Nothing, |earlier| self.end_of(earlier, stage_runs));
        let how = TransferOptions { transferred: settings.transfer, allow_loss: settings.allow_loss };
        Some((stage, begins, how))
    }

    /// The configuration of each stage, without what it takes from the one before.
    pub fn configs(&self) -> impl Iterator<Item = (&StageSettings, &RunConfig)> {
        self.stages.iter().map(|(settings, config)| (settings, config))
    }
}

/// The latest attempts at a stage, between which no later one was visited: what that gave up is not gone on from again.
fn attempts(stage: usize, stage_runs: &[StageRun]) -> impl DoubleEndedIterator<Item = &StageRun> {
    let last = stage_runs.iter().rposition(|stage_run| stage_run.stage == stage).map_or(0, |last| last + 1);
    let later = stage_runs[..last].iter().rposition(|stage_run| stage_run.stage > stage);
    let first = later.map_or(0, |later| later + 1);
    stage_runs[first..last].iter().filter(move |stage_run| stage_run.stage == stage)
}

/// A population that goes back takes as much as can be, and gives up what the later stage had added.
const BACK: TransferOptions = TransferOptions { transferred: None, allow_loss: true };

/// The best of several attempts goes on with its own search.
const TAKEN_UP: TransferOptions = TransferOptions { transferred: Some(Transferred::Population), allow_loss: false };

impl Curriculum for Stages {
    fn next(&self, stage_runs: &[StageRun]) -> Option<PlannedStage> {
        let (stage, begins, how) = match stage_runs.last() {
            None => self.beginning(0, stage_runs),
            Some(StageRun { stage, decision: Decision::Demote, .. }) => {
                Some((stage.saturating_sub(1), Beginning::Before, BACK))
            }
            Some(StageRun { stage, decision: Decision::GiveUp, .. }) => match self.give_up(*stage, stage_runs) {
                Some(GiveUp { back_to, .. }) => {
                    let back_to = self.stages.iter().position(|(settings, _)| settings.name == *back_to)?;
                    self.beginning(back_to, stage_runs)
                }
                None => Some((*stage, self.end_of(*stage, stage_runs), TAKEN_UP)),
            },
            Some(StageRun { stage, .. }) => self.beginning(stage + 1, stage_runs),
        }?;
        let (settings, config) = self.stages.get(stage)?;
        let give_up = self.give_up(stage, stage_runs).map(|give_up| give_up.when.clone());
        let rules = Rules { promotion: settings.promotion.clone(), demotion: settings.demotion.clone(), give_up };
        let has_rules = rules.promotion.is_some() || rules.demotion.is_some() || rules.give_up.is_some();
        Some(PlannedStage {
            stage,
            name: settings.name.clone(),
            config: config.clone(),
            promotion: has_rules.then(|| Arc::new(rules) as Arc<dyn Promotion>),
            is_goal: self.is_goal(stage),
            begins,
            transfer: how.transferred,
            allow_loss: how.allow_loss,
        })
    }
}

/// The rules of a stage.
struct Rules {
    promotion: Option<PromotionRule>,
    demotion: Option<PromotionRule>,
    give_up: Option<PromotionRule>,
}

impl Promotion for Rules {
    fn decide(&self, moment: &StageState<'_>) -> Decision {
        let is_met = |rule: &Option<PromotionRule>| rule.as_ref().is_some_and(|rule| rule.is_met(moment));
        if is_met(&self.promotion) {
            Decision::Promote
        } else if is_met(&self.demotion) {
            Decision::Demote
        } else if is_met(&self.give_up) {
            Decision::GiveUp
        } else {
            Decision::Stay
        }
    }
}

/// The configuration of a stage, from that of the stage before.
fn resolve(before: &RunConfig, settings: &StageSettings, registry: &Registry) -> Result<RunConfig, StageProblem> {
    let forbidden = ["stages", "origin", "stop", "seed", "record", "preset"];
    if let Some(&field) = forbidden.iter().find(|&&field| settings.changes.contains_key(field)) {
        let allowed = "left to the whole run; what ends a stage is its promotion";
        return Err(SettingError::new(format!("changes.{field}"), "a change", allowed).into());
    }
    let mut assembly = Assembly::new(before, registry);
    let mut creature = before.creature.clone();
    if let Some(changed) = settings.changes.get("creature") {
        creature = field_path::from_value(changed).map_err(|FieldError { path, message, .. }| {
            let field = if path == "." { "creature".into() } else { format!("creature.{path}") };
            ConfigError::Field { field, message }
        })?;
        // A creature is chosen as a whole, too.
        assembly.lay_over(json!({ "creature": null }));
    }
    let mut planned = None;
    let movement = settings.changes.get("movement");
    let renamed = movement.and_then(|movement| movement.get("name")).and_then(Value::as_str);
    if let Some(name) = renamed.filter(|&name| name != before.movement.name)
        && let Ok(preset) = registry.presets.find(&before.preset)
    {
        let mut fresh = registry.configure(preset, creature, name);
        fresh.movement.objectives.clone_from(&before.movement.objectives);
        let former = registry.configure(preset, before.creature.clone(), &before.movement.name);
        if fresh.physics.water.is_some() != former.physics.water.is_some() {
            // Into the water or out of it, and to the engine that has it.
            assembly.lay_over(json!({ "physics": { "water": fresh.physics.water }, "engine": fresh.engine }));
        }
        // Null first: a movement is merged, and terms of the old one must not stay.
        assembly.lay_over(json!({ "movement": null, "training_steps": fresh.training_steps }));
        assembly.lay_over(json!({ "movement": fresh.movement }));
        planned = Some(fresh.movement);
    }
    let chosen = settings.changes.get("strategy").and_then(Value::as_object).and_then(|choice| choice.keys().next());
    let chosen = chosen.and_then(|name| registry.strategies.find(name));
    if let Some(entry) = chosen.filter(|entry| entry.name() != before.strategy.name()) {
        // Another strategy begins with its own defaults.
        assembly.lay_over(json!({ "strategy": entry.settings() }));
    }
    if settings.changes.contains_key("terrain") {
        // A terrain is chosen as a whole: the one before must not shine through.
        assembly.lay_over(json!({ "terrain": null }));
    }
    assembly.lay_over(Value::Object(settings.changes.clone()));
    let mut config = assembly.finish()?;
    if !settings.add_sensors.is_empty() {
        let own = config.creature.sensors.clone();
        let sensors: &mut Vec<Sensor> = config.sensors.get_or_insert(own);
        sensors.extend(settings.add_sensors.iter().cloned());
    }
    if let Some(planned) = planned {
        defaults::follow_clock(&mut config, &planned);
    }
    Ok(config)
}

/// The configuration of a stage in its worlds.
fn in_its_worlds(config: &RunConfig, settings: &StageSettings) -> RunConfig {
    let variation = if settings.near && !config.variation.is_none() { Variation::near() } else { config.variation };
    RunConfig { variation, ..config.clone() }
}

fn check_name(settings: &StageSettings, earlier: &[(StageSettings, RunConfig)]) -> Result<(), SettingError> {
    let name = &settings.name;
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if name.is_empty() || name.len() > 40 || !name.chars().all(is_plain) {
        let allowed = "1 to 40 lower-case letters, digits and hyphens: it names a folder";
        return Err(SettingError::new("name", format!("\"{name}\""), allowed));
    }
    if earlier.iter().any(|(other, _)| other.name == *name) {
        return Err(SettingError::new("name", format!("\"{name}\""), "another than that of an earlier stage"));
    }
    Ok(())
}

/// Checks that a stage can be left, and that its rules ask for something there is.
fn check_rules(settings: &StageSettings, setup: &Setup, (is_first, is_last): (bool, bool)) -> Result<(), SettingError> {
    if settings.promotion.is_none() && !is_last {
        let allowed = "a rule, or the stage could never be left; only the last stage needs none";
        return Err(SettingError::new("promotion", "missing", allowed));
    }
    if settings.demotion.is_some() && is_first {
        return Err(SettingError::new("demotion", "a rule", "missing in the first stage: there is none before it"));
    }
    if (settings.transfer.is_some() || settings.allow_loss) && is_first {
        let field = if settings.allow_loss { "allow_loss" } else { "transfer" };
        return Err(SettingError::new(field, "given", "missing in the first stage: there is none before it"));
    }
    let rules = [
        ("promotion", settings.promotion.as_ref()),
        ("demotion", settings.demotion.as_ref()),
        ("give_up.when", settings.give_up.as_ref().map(|give_up| &give_up.when)),
    ];
    for (field, rule) in rules {
        let Some(rule) = rule else { continue };
        rule.validate().map_err(|error| error.within(field))?;
        if !rule.can_be_met() {
            return Err(SettingError::new(field, rule, "a rule that some number of generations can meet"));
        }
        check_tier(rule, setup).map_err(|error| error.within(field))?;
        let known = measurements(setup);
        if let Some(name) = rule.measurements().into_iter().find(|name| !known.iter().any(|known| known == name)) {
            let allowed = format!("one of those there are: {}", known.join(", "));
            return Err(SettingError::new(format!("{field}.measurement.name"), format!("\"{name}\""), allowed));
        }
    }
    Ok(())
}

/// A tier that is asked for can be reached, or could be if worlds varied.
fn check_tier(rule: &PromotionRule, setup: &Setup) -> Result<(), SettingError> {
    let Some((asking, tier)) = rule.highest_tier() else { return Ok(()) };
    let allowed = match highest_tier(setup.reference.as_ref()) {
        Some(highest) if tier <= u64::from(highest) || highest == USABLE => return Ok(()),
        Some(highest) => format!("from 1 to {highest}"),
        None => "asked for only where gaits are judged during training: of movements that are judged, in runs with a \
                 variation, random commands, shortened training episodes or further_bodies"
            .into(),
    };
    let is_usable = *asking == PromotionRule::Usable;
    let (field, found) = if is_usable { ("usable", "usable".into()) } else { ("tier", tier.to_string()) };
    Err(SettingError::new(field, found, allowed))
}

/// The same stage, where rules ask for no tier that is out of reach: without variation every tier counts as the lowest, as of a run until
/// usable.
fn within_reach(settings: &StageSettings, setup: &Setup) -> StageSettings {
    let highest = highest_tier(setup.reference.as_ref()).map_or(u64::MAX, u64::from);
    let limited = |rule: PromotionRule| rule.with_tiers_up_to(highest);
    StageSettings {
        promotion: settings.promotion.clone().map(limited),
        demotion: settings.demotion.clone().map(limited),
        give_up: settings.give_up.clone().map(|give_up| GiveUp { when: limited(give_up.when), ..give_up }),
        ..settings.clone()
    }
}

fn check_giving_up(settings: &StageSettings, earlier: &[(StageSettings, RunConfig)]) -> Result<(), SettingError> {
    let Some(GiveUp { back_to, times, .. }) = &settings.give_up else { return Ok(()) };
    SettingError::check_range("give_up.times", *times, 1.0, 100.0)?;
    let names = || earlier.iter().map(|(stage, _)| &stage.name).chain([&settings.name]);
    match names().any(|name| name == back_to) {
        true => Ok(()),
        false => {
            let names: Vec<&str> = names().map(String::as_str).collect();
            let allowed = format!("this stage or an earlier one: {}", names.join(", "));
            Err(SettingError::new("give_up.back_to", format!("\"{back_to}\""), allowed))
        }
    }
}

/// The measurements an evaluation of this setup has.
fn measurements(setup: &Setup) -> Vec<String> {
    let mut names = vec!["duration".to_owned()];
    setup.episode.movement().measurements(&mut |name, _| names.push(name.to_owned()));
    names.sort();
    names
}

#[cfg(test)]
mod tests;
