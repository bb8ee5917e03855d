use super::{Outcome, balance, check_input};
use crate::{
    Registry, Setup,
    champion::{CHAMPION_FORMAT, Champion},
    program_name,
    request::Request,
    shaping::Stages,
    source,
    texts::shell_word,
};
use clap::Args;
use creatures::{Blueprint, Creature, DEFAULT_INPUT_RANGE, Motors, Senses};
use envs_core::{Conditions, Engine, Ground, PhysicsSettings};
use envs_lanes::LaneEngine;
use ne_core::{
    CHECKPOINT_FORMAT,
    bounded_read::{LARGEST_DATA, read_text},
};
use serde_json::{Map, Value};
use std::{
    error::Error,
    path::{Path, PathBuf},
    process::ExitCode,
};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol check my-creature.json
  gambol check tetrapod-2
  gambol check my-config.json
  gambol check runs/biped-1-running/champion.json

A creature is also let settle in rapier, its motors holding still, as before every episode. It is warned of if its torso \
then has turned by more than 5° from the pose in its file, or has sunk by more than 15 % of its height. Warnings leave \
the exit code at 0.")]
pub(crate) struct Check {
    /// A creature, configuration or champion file, or a shipped creature's name (see: gambol creatures)
    #[arg(value_name = "FILE|NAME")]
    file: PathBuf,
}

impl Check {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let path = &self.file;
        if let Some(name) = path.to_str().filter(|name| !path.exists() && !name.contains(['/', '\\', '.'])) {
            check_creature(path, source::creature(name, registry)?, registry)?;
            return Ok(ExitCode::SUCCESS);
        }
        check_input(path)?;
        let text = read_text(path, LARGEST_DATA).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        // What is not even JSON is left to the readers of creatures and configurations, which say where.
        let unreadable = |_| if text.contains(creatures::FORMAT) { Value::Null } else { Map::new().into() };
        let value: Value = serde_json::from_str(&text).unwrap_or_else(unreadable);
        match value.get("format").and_then(Value::as_str) {
            Some(CHAMPION_FORMAT) => check_champion(path, registry)?,
            Some(CHECKPOINT_FORMAT) => {
                return Err(format!("a checkpoint is checked by: {} resume FOLDER", program_name()).into());
            }
            Some(creatures::FORMAT) => check_creature(path, source::creature_file(path)?, registry)?,
            _ if !value.is_object() || value.get("parts").is_some() => {
                check_creature(path, source::creature_file(path)?, registry)?
            }
            _ => check_config(path, &value, registry)?,
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn check_creature(path: &Path, creature: Creature, registry: &Registry) -> Result<(), Box<dyn Error>> {
    let of_file = |error: &dyn Error| format!("{}: {error}", path.display());
    let blueprint = Blueprint::new(creature)?;
    let sensors = registry.sensors.telling(&blueprint.creature().sensors, &blueprint).map_err(|it| of_file(&it))?;
    let senses = Senses::new(&blueprint, &sensors, DEFAULT_INPUT_RANGE).map_err(|error| of_file(&error))?;
    let motors = Motors::new(&blueprint);
    say!(
        "{}: a valid creature, \"{}\": {} parts, {} joints, {} inputs, {} outputs",
        path.display(),
        blueprint.name(),
        blueprint.parts().len(),
        blueprint.hinges().len(),
        senses.len(),
        motors.len()
    )?;
    let lowest = blueprint.bounding_box()[1];
    if lowest.abs() > 0.05 {
        let place = if lowest > 0.0 { "above" } else { "below" };
        say!("  note: in the start pose its lowest point is {:.2} m {place} the ground (y = 0)", lowest.abs())?;
    }
    let world = (PhysicsSettings::default(), Ground::flat(), Conditions::reference(motors.len()));
    if let Err(refusal) = LaneEngine::new(&blueprint, &world.0, &world.1, &world.2) {
        say!("  note: {refusal}; the default preset trains it in rapier, for others say --engine rapier")?;
    }
    if blueprint.symmetry().is_none() {
        say!("  note: it looks the same from both sides: what it learns one way, a game can play the other way")?;
    }
    if let Some(note) = is_small(&blueprint) {
        say!("  note: {note}")?;
    }
    for warning in balance::warnings(&blueprint).into_iter().chain(ends_in_passive(&blueprint)) {
        say!("  warning: {warning}")?;
    }
    for channel in senses.channels() {
        say!("  in   {}: {} to {} {}", channel.name, channel.range[0], channel.range[1], channel.unit)?;
    }
    for channel in motors.channels() {
        say!("  out  {}: {} to {} {}", channel.name, channel.range[0], channel.range[1], channel.unit)?;
    }
    Ok(())
}

/// That a body on legs falls over in fewer than six steps of the world, as one does that is less than 14 cm high: no controller is fast
/// enough then. Fifteen are as many as a biped of 0.9 m has.
fn is_small(blueprint: &Blueprint) -> Option<String> {
    let PhysicsSettings { time_step, gravity, .. } = PhysicsSettings::default();
    let fall = (blueprint.start_height() / gravity).sqrt();
    (!blueprint.is_legless() && fall < 6.0 * time_step).then(|| {
        let finer = (fall / 15.0).max(0.001);
        format!(
            "it is so small that it falls over within {fall:.2} s, and the world has steps of {time_step} s: train it with \
             --set physics.time_step={finer:.3}, and with {:.0} times as many steps in movement.steps and training_steps",
            time_step / finer
        )
    })
}

/// Chains of actuated parts that are no legs, since what hangs on their last part is not actuated.
fn ends_in_passive(blueprint: &Blueprint) -> Vec<String> {
    let (parts, hinges) = (blueprint.parts(), blueprint.hinges());
    let hanging =
        |part: usize| hinges.iter().filter(move |hinge| hinge.parent == part).map(|hinge| &parts[hinge.child]);
    let warning = |part: usize| {
        let first = hanging(part).next()?;
        let (name, on) = (&first.name, &parts[part].name);
        (parts[part].actuated && parts[part].leg && hanging(part).all(|child| !child.actuated)).then(|| {
            format!(
                "{name} is not actuated and hangs on {on}, so that {on} is no foot and its chain no leg: \
                 have {name} actuated, or say \"leg\": false of {on}"
            )
        })
    };
    (1..parts.len()).filter_map(warning).collect()
}

fn check_champion(path: &Path, registry: &Registry) -> Result<(), Box<dyn Error>> {
    let champion = Champion::read(path)?;
    champion.episode(registry).map_err(|error| format!("{}: {error}", path.display()))?;
    let (creature, movement) = (&champion.creature.name, &champion.movement.name);
    say!("{}: a valid champion, {creature} {movement}, fitness {}", path.display(), champion.fitness)?;
    say!("  to prove that it still does the same: {} verify {}", program_name(), shell_word(path))?;
    Ok(())
}

/// A configuration may leave out creature and movement, which are then given to `train`.
fn check_config(path: &Path, value: &Value, registry: &Registry) -> Result<(), Box<dyn Error>> {
    let fields = value.get("content").unwrap_or(value);
    let missing = |pointer: &str, stand_in: &str| fields.pointer(pointer).is_none().then(|| stand_in.to_owned());
    let request = Request {
        creature: missing("/creature", "biped-1"),
        movement: missing("/movement/name", "running"),
        config: Some(path.into()),
        ..Request::default()
    };
    let config = request.resolve(registry)?;
    Setup::new(&config, registry).map_err(|error| format!("{}: {error}", path.display()))?;
    let stages = Stages::new(&config, registry).map_err(|error| format!("{}: {error}", path.display()))?;
    say!("{}: a valid configuration{}", path.display(), super::in_bodies(config.bodies()))?;
    for (index, (stage, config)) in stages.configs().enumerate() {
        let rule = stage.promotion.as_ref().map_or_else(|| "the run ends".into(), ToString::to_string);
        let bodies = super::in_bodies(config.bodies());
        let give_up = stage.give_up.as_ref().map_or_else(String::new, |give_up| format!("; {give_up}"));
        say!("  stage {} {}: {}{bodies}, until {rule}{give_up}", index + 1, stage.name, config.movement.name)?;
    }
    Ok(())
}
