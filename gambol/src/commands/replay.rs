use super::{Outcome, check_output, gait::champion_file, write_output};
use crate::{
    Registry, Setup,
    champion::Champion,
    dot::dot,
    front::Front,
    judge::Judge,
    report,
    run_folder::RunFolder,
    shaping::{self, stage_runs},
    trajectory::Recording,
};
use clap::Args;
use std::{
    error::Error,
    path::{Path, PathBuf},
    process::ExitCode,
};
use tasks::{Body, Environment};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol replay runs/biped-1-running/champion.json --html gait.html
  gambol replay champion.json --trajectory gait.csv --seconds 10
  gambol replay champion.json --dot net.dot     then, with Graphviz: dot -Tsvg net.dot > net.svg
  gambol replay runs/tetrapod-1-running --point 3 --trajectory thrifty.csv --save thrifty.json

Trajectory and page show what `gambol gait` judges: the champion in rapier, in the world without variation, for as long as \
its movement is judged (or --seconds), and no term ends it. What is printed at the end is an evaluation, which terms may end.

The trajectory has a row for each step and part, the start included:
  step,time_s,part,x_m,y_m,angle_rad,ground_contact,vx_m_per_s,vy_m_per_s,spin_rad_per_s,motor_torque_n_m
The torque is that of the motor of the joint on which the part hangs, empty if a controller moves none there. `gambol gait` \
reads such a file.")]
pub(crate) struct Replay {
    /// A champion file, or the folder of a run
    champion: PathBuf,
    /// Replay this point of the run's front (see: --strategy nsga2), from 1, which is the best in the first objective
    #[arg(long, value_name = "NUMBER")]
    point: Option<usize>,
    /// Write the point as a champion file
    #[arg(long, value_name = "FILE", requires = "point")]
    save: Option<PathBuf>,
    /// Write a page that shows the gait
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write where every part is after every step, how fast, and what its motor does, as CSV
    #[arg(long, value_name = "FILE")]
    trajectory: Option<PathBuf>,
    /// Write the net as a graph in the DOT language
    #[arg(long, value_name = "FILE")]
    dot: Option<PathBuf>,
    /// How long to play [default: trajectory and page as long as the movement is judged, else as long as an evaluation]
    #[arg(long)]
    seconds: Option<f64>,
    /// Overwrite files that exist
    #[arg(long)]
    force: bool,
}

impl Replay {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        self.check_outputs(&champion_file(&self.champion)?)?;
        let registry = registry.clone();
        let mut champion = match self.point {
            Some(number) => point(&self.champion, number, &registry)?,
            None => Champion::read(&champion_file(&self.champion)?)?,
        };
        if let Some(path) = &self.save {
            champion.write(path)?;
            say!("champion    {}", path.display())?;
        }
        let steps = self.seconds.map(|seconds| steps_in(&champion, seconds)).transpose()?;
        champion.movement.steps = steps.or(champion.movement.steps);
        let in_file = |error: &dyn std::fmt::Display| format!("{}: {error}", self.champion.display());
        let episode = champion.episode(&registry).map_err(|error| in_file(&error))?;
        let played = episode.play(&mut champion.network.clone(), champion.seed.trial(0), &mut ());
        if let Some(failure) = &played.outcome.failure {
            say!("the replay failed after {} steps: {failure}", played.outcome.steps)?;
        }
        if let Some(path) = &self.trajectory {
            let judge = Judge::new(champion.episode_parts(), &registry).map_err(|error| in_file(&error))?;
            let world = judge.environment();
            let (recording, failure) = Recording::play(world, &champion.network, steps.unwrap_or(judge.steps()));
            let mut csv = Vec::new();
            recording.write_csv(world.body().unwrap_or(&Body::default()), &mut csv)?;
            write_output(path, &csv, self.force)?;
            let seconds = recording.snapshots.last().map_or(0.0, |last| last.time);
            let failure = failure.map_or_else(String::new, |failure| format!(", ended by a failure: {failure}"));
            say!("trajectory  {}, {seconds:.2} s{failure}", path.display())?;
        }
        if let Some(path) = &self.dot {
            write_output(path, dot(&champion).as_bytes(), self.force)?;
            say!("net         {}", path.display())?;
        }
        if let Some(path) = &self.html {
            check_output(path, self.force)?;
            report::write_replay(&champion, &registry, steps, path)?;
            say!("page        {}", path.display())?;
        }
        // Terms are of other units.
        let (value, unit) = (played.movement.value(), played.movement.unit());
        let value = match champion.movement.terms.is_empty() {
            true => format!("{value:.3} {unit}"),
            false => format!("fitness {value:.3}"),
        };
        let seconds = f64::from(played.outcome.steps) * f64::from(champion.physics.time_step);
        say!("{} {}: {value} in {seconds:.2} s", champion.creature.name, champion.movement.name)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Nothing may be overwritten unasked, and the files must be different ones.
    fn check_outputs(&self, champion: &Path) -> Result<(), String> {
        let outputs =
            [("page", &self.html), ("trajectory", &self.trajectory), ("drawing", &self.dot), ("champion", &self.save)];
        let outputs: Vec<_> = outputs.iter().filter_map(|(what, path)| Some((what, path.as_ref()?))).collect();
        for (index, &(what, path)) in outputs.iter().enumerate() {
            check_output(path, self.force)?;
            if same_file(path, champion) {
                return Err(format!("{} is the champion itself", champion.display()));
            }
            if let Some((other, _)) = outputs[..index].iter().find(|(_, other)| same_file(other, path)) {
                return Err(format!("{} cannot be both the {other} and the {what}", path.display()));
            }
        }
        Ok(())
    }
}

/// Whether two paths name one file, which need not be there yet.
fn same_file(one: &Path, other: &Path) -> bool {
    let place = |path: &Path| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        path.canonicalize()
            .or_else(|_| Ok::<_, std::io::Error>(folder.canonicalize()?.join(path.file_name().unwrap_or_default())))
    };
    one == other || matches!((place(one), place(other)), (Ok(one), Ok(other)) if one == other)
}

/// How many steps `--seconds` are.
pub(super) fn steps_in(champion: &Champion, seconds: f64) -> Result<u32, String> {
    champion.steps_in(seconds).map_err(|error| format!("--{error}"))
}

/// A point of the front in a run's folder, counted from 1; of a run with stages, of the one whose champion is the run's.
fn point(folder: &Path, number: usize, registry: &Registry) -> Result<Champion, Box<dyn Error>> {
    let run = RunFolder::open(folder)?;
    let stage_runs = stage_runs(&run)?;
    let leading = shaping::leading(&stage_runs);
    let folder = leading.map_or(Ok(run), |stage_run| RunFolder::open(&stage_run.folder))?;
    let config = folder.read_config()?;
    if !folder.front().is_file() {
        let (path, strategy) = (folder.path().display(), config.strategy.name());
        return Err(format!("{path} has no front.json: {strategy} looks for no front; --strategy nsga2 does").into());
    }
    let front = Front::read(&folder.front())?;
    let setup = Setup::new(&config, registry)?;
    match number.checked_sub(1).and_then(|index| front.points.get(index)) {
        Some(point) => Ok(point.champion(&config, &setup)),
        None if front.points.is_empty() => {
            Err(format!("--point {number}: the front in {} is empty", folder.front().display()).into())
        }
        None => Err(format!("--point {number}: must be from 1 to {}", front.points.len()).into()),
    }
}
