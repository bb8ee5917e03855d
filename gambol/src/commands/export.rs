use super::{Outcome, check_output, gait::champion_file, replay::steps_of};
use crate::{
    Registry,
    champion::Champion,
    export::{self, Format},
};
use clap::{Args, ValueEnum, builder::PossibleValue};
use ne_core::archive;
use std::{path::PathBuf, process::ExitCode};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol export runs/tetrapod-2-playing --to player            the character, for a game: see docs/player.md
  gambol export runs/tetrapod-2-playing --to trace --seconds 5 what a player must do with it, to test one with
  gambol export champion.json --to csv --out gait.csv

What the champion does is what `gambol gait` judges: in rapier, in the world without variation.")]
pub(crate) struct Export {
    /// A champion file, or the folder of a run
    champion: PathBuf,
    /// What to make of it
    #[arg(long, value_name = "FORMAT")]
    to: Named,
    /// The file to write [default: CREATURE-MOVEMENT with the ending of the format, in the current folder]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// How long it is played, for formats that show it [default: as long as its movement is judged]
    #[arg(long)]
    seconds: Option<f64>,
    /// Overwrite the file if it exists
    #[arg(long)]
    force: bool,
}

/// A format by its name.
#[derive(Clone, Copy)]
struct Named(Format);

impl ValueEnum for Named {
    fn value_variants<'a>() -> &'a [Self] {
        const NAMED: [Named; Format::ALL.len()] = {
            let mut named = [Named(Format::Player); Format::ALL.len()];
            let mut index = 0;
            while index < named.len() {
                named[index] = Named(Format::ALL[index]);
                index += 1;
            }
            named
        };
        &NAMED
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let help = match self.0 {
            Format::Player => "a character for a game: body, senses, net and motors in a few kB",
            Format::Trace => "what is sensed and commanded at every step, as CSV, to test a player with",
            Format::Csv => "where every part is at every step",
        };
        Some(PossibleValue::new(self.0.name()).help(help))
    }
}

impl Export {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let file = champion_file(&self.champion)?;
        let Named(format) = self.to;
        let champion = Champion::read(&file)?;
        let name = || format!("{}-{}.{}", champion.creature.name, champion.movement.name, format.ending()).into();
        let out = self.out.clone().unwrap_or_else(name);
        if out.canonicalize().is_ok_and(|out| file.canonicalize().is_ok_and(|file| file == out)) {
            return Err(format!("{} is what is to be exported", file.display()).into());
        }
        check_output(&out, self.force)?;
        let steps = self.seconds.map(|seconds| steps_of(seconds, champion.physics.time_step)).transpose()?;
        let bytes = export::export(&champion, registry, format, steps)
            .map_err(|error| format!("{}: {error}", file.display()))?;
        let shown = out.display();
        archive::write_whole(&out, &bytes).map_err(|error| format!("cannot write {shown}: {error}"))?;
        say!("{}  {shown}, {} bytes", format.name(), bytes.len())?;
        Ok(ExitCode::SUCCESS)
    }
}
