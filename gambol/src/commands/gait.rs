use super::{NOT_USABLE, Outcome, gait_text};
use clap::Args;
use creatures::Blueprint;
use gambol::{
    champion::Champion,
    gait,
    run_folder::RunFolder,
    source,
    trajectory::{CsvTrajectory, read_csv},
};
use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
    process::ExitCode,
};
use tasks::{
    MovementCatalogue,
    gait::{GaitError, GaitReport, Kind},
};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol gait runs/biped-1-running
  gambol gait champion.json --json
  gambol replay champion.json --trajectory gait.csv
  gambol gait gait.csv --creature biped-1 --movement running

A champion is replayed in rapier, for as long as its movement is judged: 20 s of running and what is judged like it, 5 s
of jumps, 20 s of what is not judged. A trajectory is
taken as it is; of flat ground, with gravity as on Earth. Where it has no columns for speeds they are found by central
differences; where it has none for torques, what a step costs is not known, and energy from nowhere is not looked for.

Exit code 0: usable, or not judged. 1: something was wrong. 3: not usable.")]
pub(crate) struct Gait {
    /// A champion file, the folder of a run, or a trajectory: a CSV file as `gambol replay --trajectory` writes it
    #[arg(value_name = "CHAMPION|FOLDER|TRAJECTORY.csv")]
    gait: PathBuf,
    /// Whose trajectory it is: a shipped creature's name or a creature file
    #[arg(long, value_name = "NAME|FILE")]
    creature: Option<String>,
    /// As what a trajectory is judged [default: it is measured alone]
    #[arg(long, value_parser = Kind::JUDGED)]
    movement: Option<String>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// A gait that was measured, and whose.
struct Measured {
    gait: gait::Gait,
    name: String,
}

impl Gait {
    pub(crate) fn run(self) -> Outcome {
        let is_csv = self.gait.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        let Measured { gait, name } = match &self.creature {
            Some(creature) => of_trajectory(&self.gait, creature, self.movement.as_deref())?,
            None if is_csv => {
                let path = self.gait.display();
                return Err(format!("{path} does not say whose trajectory it is: give --creature NAME or FILE").into());
            }
            None if self.movement.is_some() => {
                return Err("--movement is for trajectories: a champion says itself what it has learned".into());
            }
            None => of_champion(&champion_file(&self.gait)?)?,
        };
        if self.json {
            say!("{}", serde_json::to_string(&gait)?)?;
        } else {
            say!("{}", gait_text::describe(&name, &gait.report, &gait.obstacles).trim_end())?;
        }
        let usable = gait.report.verdict.is_none_or(|verdict| verdict.usable);
        Ok(if usable { ExitCode::SUCCESS } else { ExitCode::from(NOT_USABLE) })
    }
}

/// The champion's file: the one that is given, or that of the run whose folder is given.
pub(super) fn champion_file(path: &Path) -> Result<PathBuf, Box<dyn Error>> {
    Ok(if path.is_dir() { RunFolder::open(path)?.champion() } else { path.into() })
}

fn of_champion(path: &Path) -> Result<Measured, Box<dyn Error>> {
    let champion = Champion::read(path)?;
    let gait = gait::measure(&champion, &MovementCatalogue::default())
        .map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Measured { gait, name: format!("{} {}", champion.creature.name, champion.movement.name) })
}

fn of_trajectory(path: &Path, creature: &str, movement: Option<&str>) -> Result<Measured, Box<dyn Error>> {
    let blueprint = Blueprint::new(source::creature(creature)?)?;
    let text = fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let body = envs_core::body_of(&blueprint);
    let read = read_csv(&text, &body).map_err(|error| format!("{}, {error}", path.display()))?;
    let trajectory = read.trajectory(&body).map_err(|error| located(path, &read, &error))?;
    let report = GaitReport::of(&trajectory, movement.and_then(Kind::of));
    let movement = movement.map_or_else(String::new, |movement| format!(" {movement}"));
    let gait = gait::Gait { report, obstacles: Vec::new() };
    Ok(Measured { gait, name: format!("{}{movement}", blueprint.name()) })
}

/// The error with the file and, if it is about a step, its line.
fn located(path: &Path, read: &CsvTrajectory, error: &GaitError) -> String {
    let path = path.display();
    let line = |step: usize| read.lines.get(step).map_or_else(String::new, |line| format!(", line {line}"));
    match error {
        GaitError::TooShort { snapshots } => {
            format!("{path}: a gait needs the start and at least 1 step; it has {snapshots} of these")
        }
        GaitError::Clock { snapshot, expected, found } => format!(
            "{path}{}: step {snapshot} comes {found:.4} s after the one before; expected a constant time step of 0.0001 to 1 s \
             ({expected:.4} s on average)",
            line(*snapshot)
        ),
        GaitError::NotFinite { snapshot, what } if read.speeds_known => {
            format!("{path}{}: step {snapshot}: {what} is too large", line(*snapshot))
        }
        GaitError::NotFinite { snapshot, .. } => {
            format!("{path}{}: step {snapshot} is too far from its neighbours for any speed", line(*snapshot))
        }
        other => format!("{path}: {other}"),
    }
}
