use super::{NOT_USABLE, Outcome, check_ending, check_input, check_output, gait_text, write_output};
use crate::{
    Registry,
    champion::Champion,
    gait, judge, program_name,
    run_folder::RunFolder,
    shaping::why_all_failed,
    sheet, source, suggest,
    texts::shell_word,
    trajectory::{COMMAND_COLUMNS, CsvTrajectory, read_csv},
};
use clap::Args;
use creatures::Blueprint;
use envs_core::Ground;
use ne_core::bounded_read::{LARGEST_DATA, read_text};
use std::{
    error::Error,
    path::{Path, PathBuf},
    process::ExitCode,
};
use tasks::gait::{GaitError, GaitReport};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol gait runs/biped-1-running
  gambol gait champion.json --json
  gambol gait runs/biped-1-running --sheet sheet.png
  gambol replay champion.json --trajectory gait.csv
  gambol gait gait.csv --creature biped-1 --movement running

The contact sheet is one image: twelve frames over a stride or a jump, footfalls, pitch and height of the torso, the verdict.

A champion is replayed in rapier, for as long as its movement is judged: 60 s of running, what is judged like it, and playing, \
5 s of jumps, 20 s of swimming and of what is not judged. One that is usable must be so in 7 of 8 near worlds as well: \
friction, gravity, mass and time step off by up to 1 %, the start pose by up to 1 degree, the torso spinning by up to 0.05 \
rad/s. A trajectory is taken as it is and judged alone; of flat ground, with gravity as on Earth. Where it has no columns \
for speeds they are found by central differences; where it has none for torques, what a step costs is not known, and \
energy from nowhere is not looked for.

Exit code 0: usable, or not judged. 1: something was wrong. 3: not usable.")]
pub(crate) struct Gait {
    /// A champion file, the folder of a run, or a trajectory: a CSV file as `gambol replay --trajectory` writes it
    #[arg(value_name = "CHAMPION|FOLDER|TRAJECTORY.csv")]
    gait: PathBuf,
    /// Whose trajectory it is: a shipped creature's name or a creature file
    #[arg(long, value_name = "NAME|FILE")]
    creature: Option<String>,
    /// As what a trajectory is judged [default: it is measured alone]
    #[arg(long, value_name = "NAME")]
    movement: Option<String>,
    /// Draw a contact sheet of the gait, a PNG image
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
    /// Overwrite the contact sheet if it exists
    #[arg(long, requires = "sheet")]
    force: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// A gait that was measured, and whose.
struct Measured {
    gait: judge::Gait,
    name: String,
    /// Its contact sheet, if asked for.
    sheet: Option<Vec<u8>>,
}

impl Gait {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        self.check_sheet()?;
        check_input(&self.gait)?;
        let with_sheet = self.sheet.is_some();
        let is_csv = self.gait.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        let Measured { gait, name, sheet } = match &self.creature {
            Some(_) if !is_csv && champion_file(&self.gait).is_ok_and(|file| Champion::read(&file).is_ok()) => {
                return Err("--creature is for trajectories: a champion says itself whose it is".into());
            }
            Some(creature) => of_trajectory(&self.gait, creature, self.movement.as_deref(), with_sheet, registry)?,
            None if is_csv => {
                let path = self.gait.display();
                return Err(format!("{path} does not say whose trajectory it is: give --creature NAME or FILE").into());
            }
            None if self.movement.is_some() => {
                return Err("--movement is for trajectories: a champion says itself what it has learned".into());
            }
            None => of_champion(&champion_file(&self.gait)?, with_sheet, registry)?,
        };
        if let (Some(path), Some(sheet)) = (&self.sheet, &sheet) {
            write_output(path, sheet, self.force)?;
        }
        if self.json {
            say!("{}", serde_json::to_string(&gait)?)?;
        } else {
            say!("{}", gait_text::describe(&name, &gait.report, &gait.obstacles, registry).trim_end())?;
            if let Some(path) = &self.sheet {
                say!("\ncontact sheet: {}", path.display())?;
            }
        }
        let usable = gait.report.verdict.is_none_or(|verdict| verdict.usable);
        Ok(if usable { ExitCode::SUCCESS } else { ExitCode::from(NOT_USABLE) })
    }

    /// Nothing may be overwritten unasked, and never what is measured.
    fn check_sheet(&self) -> Result<(), Box<dyn Error>> {
        let Some(sheet) = &self.sheet else { return Ok(()) };
        check_output(sheet, self.force)?;
        let measured = champion_file(&self.gait)?;
        if sheet.canonicalize().ok().is_some_and(|sheet| Some(sheet) == measured.canonicalize().ok()) {
            return Err(format!("{} is what is to be measured", sheet.display()).into());
        }
        Ok(check_ending(sheet)?)
    }
}

/// The champion's file: the one that is given, or that of the run whose folder is given.
pub(super) fn champion_file(path: &Path) -> Result<PathBuf, Box<dyn Error>> {
    if !path.is_dir() {
        return Ok(path.into());
    }
    let folder = RunFolder::open(path)?;
    if folder.champion().is_file() { Ok(folder.champion()) } else { Err(no_champion(&folder)) }
}

/// Why a run has no champion.
pub(super) fn no_champion(folder: &RunFolder) -> Box<dyn Error> {
    let path = folder.path().display();
    match why_all_failed(folder) {
        Ok(Some(reason)) => {
            format!("{path} has no champion: in its last generation every evaluation failed, most often for this reason: {reason}")
        }
        Ok(None) => format!(
            "{path} has no champion.json: none was chosen so far, or it was removed; `{} resume {}` goes on, or writes it anew",
            program_name(),
            shell_word(folder.path())
        ),
        Err(error) => error.to_string(),
    }
    .into()
}

fn of_champion(path: &Path, with_sheet: bool, registry: &Registry) -> Result<Measured, Box<dyn Error>> {
    let champion = Champion::read(path)?;
    let gait = gait::measure(&champion, registry).map_err(|error| format!("{}: {error}", path.display()))?;
    let sheet = with_sheet.then(|| sheet::of_champion(&champion, &gait.report, registry)).transpose()?;
    Ok(Measured { gait, name: format!("{} {}", champion.creature.name, champion.movement.name), sheet })
}

fn of_trajectory(
    path: &Path,
    creature: &str,
    movement: Option<&str>,
    with_sheet: bool,
    registry: &Registry,
) -> Result<Measured, Box<dyn Error>> {
    let blueprint = Blueprint::new(source::creature(creature, registry)?)?;
    let text = read_text(path, LARGEST_DATA).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let body = envs_core::body_of(&blueprint);
    let read = read_csv(&text, &body).map_err(|error| format!("{}, {error}", path.display()))?;
    let trajectory = read.trajectory(&body).map_err(|error| located(path, &read, &error))?;
    let judged = || registry.movements.judged().collect::<Vec<_>>();
    let unknown = |movement| suggest::unknown("movement whose gaits are judged", movement, &judged());
    let rules =
        movement.map(|movement| registry.movements.rules(movement).ok_or_else(|| unknown(movement))).transpose()?;
    if rules.as_ref().is_some_and(|rules| rules.needs_commands()) && !read.commands_known {
        let columns = COMMAND_COLUMNS.join(" and ");
        let movement = movement.unwrap_or_default();
        return Err(format!(
            "{}: {movement} is judged by what the body was told, in columns {columns}",
            path.display()
        )
        .into());
    }
    let report = GaitReport::of(&trajectory, rules.as_deref());
    let subject = sheet::Subject {
        blueprint: &blueprint,
        movement,
        ground: &Ground::flat(),
        snapshots: &read.snapshots,
        report: &report,
    };
    let sheet = with_sheet.then(|| sheet::draw(&subject)).transpose()?;
    let movement = movement.map_or_else(String::new, |movement| format!(" {movement}"));
    let gait = judge::Gait { report, obstacles: Vec::new() };
    Ok(Measured { gait, name: format!("{}{movement}", blueprint.name()), sheet })
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
