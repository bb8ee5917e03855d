use super::{Outcome, check_output, gait::champion_file, replay::steps_in};
use crate::{
    Registry,
    champion::Champion,
    export::{self, Destination, ExportError, Format, Options, Picture},
};
use clap::{Args, ValueEnum, builder::PossibleValue};
use std::{path::PathBuf, process::ExitCode};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol export runs/tetrapod-2-playing --to player            the character, for a game: see docs/player.md
  gambol export runs/tetrapod-2-playing --to trace --seconds 5 what a player must do with it, to test one with
  gambol export champion.json --to csv --out gait.csv
  gambol export runs/biped-1-running --to gif --size 400 --ground
  gambol export runs/biped-1-running --to sprites --rate 12
  gambol export runs/biped-1-running --to dragonbones --size 512

A loop is the stride of the gait that meets itself best, made to meet itself exactly; a gait without rhythm has none.

What the champion does is what `gambol gait` judges: in rapier, in the world without variation.")]
pub(crate) struct Export {
    /// A champion file, or the folder of a run
    champion: PathBuf,
    /// What to make of it
    #[arg(long, value_name = "FORMAT")]
    to: Named,
    /// The file to write; others that belong to it stand beside it [default: CREATURE-MOVEMENT with the ending of the format, in
    /// the current folder]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// How long it is played, for traces and trajectories [default: as long as its movement is judged]
    #[arg(long)]
    seconds: Option<f64>,
    /// The longer side of a frame, for pictures; of the body, for dragonbones [default: 256]
    #[arg(long, value_name = "PIXELS")]
    size: Option<u32>,
    /// Frames a second, for pictures; a GIF shows at most 50 [default: 25]
    #[arg(long, value_name = "NUMBER")]
    rate: Option<f64>,
    /// Draw sky and ground behind the creature, for pictures [default: it is transparent]
    #[arg(long)]
    ground: bool,
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
            Format::Gif => "a loop, as an image that every program plays",
            Format::Apng => "a loop, as an animated PNG image: half-transparent edges, all colours",
            Format::Svg => "a loop, as a drawing that plays by itself",
            Format::Sprites => "a loop, as a sheet of frames (PNG) with its atlas (JSON) and root motion",
            Format::Gltf => {
                "body and gait as glTF 2.0, with root motion, for engines and modellers in three dimensions"
            }
            Format::DragonBones => {
                "body and gait for DragonBones 5.5: a skeleton (JSON), with a texture atlas (JSON, PNG) of its parts"
            }
            Format::Onnx => "the net as an ONNX model, with what its inputs and outputs are as metadata",
        };
        Some(PossibleValue::new(self.0.name()).help(help))
    }
}

impl Export {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let file = champion_file(&self.champion)?;
        let Named(format) = self.to;
        self.check_options()?;
        let champion = Champion::read(&file)?;
        let destination = Destination::new(format, &champion, self.out)?;
        for place in &destination.paths {
            if place.canonicalize().is_ok_and(|out| file.canonicalize().is_ok_and(|file| file == out)) {
                return Err(format!("{} is what is to be exported", file.display()).into());
            }
            check_output(place, self.force)?;
        }
        let steps = self.seconds.map(|seconds| steps_in(&champion, seconds)).transpose()?;
        let usual = Picture::default();
        let (size, rate) = (self.size.unwrap_or(usual.size), self.rate.unwrap_or(usual.rate));
        let picture = Picture { size, rate, ground: self.ground };
        let options = Options { name: destination.name.clone(), steps, picture };
        let exported = export::export(&champion, registry, format, &options).map_err(|error| match error {
            ExportError::Setting { .. } => format!("--{error}"),
            error => format!("{}: {error}", file.display()),
        })?;
        // What has come there since is not overwritten unasked either.
        destination.paths.iter().try_for_each(|place| check_output(place, self.force))?;
        destination.write(&exported).map_err(|error| format!("cannot write {error}"))?;
        for (place, file) in destination.paths.iter().zip(&exported) {
            say!("{}  {}, {} bytes", format.name(), place.display(), file.bytes.len())?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// What a format does not use is not asked for.
    fn check_options(&self) -> Result<(), String> {
        let Named(format) = self.to;
        let is_loop = matches!(format, Format::Gif | Format::Apng | Format::Svg | Format::Sprites);
        let is_played = matches!(format, Format::Trace | Format::Csv);
        let options = [
            ("--seconds", self.seconds.is_some(), is_played),
            ("--size", self.size.is_some(), is_loop || format == Format::DragonBones),
            ("--rate", self.rate.is_some(), is_loop),
            ("--ground", self.ground, is_loop),
        ];
        let useless = options.iter().find(|(_, is_given, is_used)| *is_given && !is_used);
        useless.map_or(Ok(()), |(option, ..)| Err(format!("{option} has no effect on {}; leave it out", format.name())))
    }
}
