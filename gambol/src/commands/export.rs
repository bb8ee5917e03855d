use super::{Outcome, check_output, gait::champion_file, replay::steps_of};
use crate::{
    Registry,
    champion::Champion,
    export::{self, Format, Options, Picture},
};
use clap::{Args, ValueEnum, builder::PossibleValue};
use ne_core::archive;
use std::{
    path::{Path, PathBuf},
    process::ExitCode,
};

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
    /// The longer side of a frame, for pictures; of the body, for dragonbones
    #[arg(long, value_name = "PIXELS", default_value_t = Picture::default().size)]
    size: u32,
    /// Frames a second, for pictures
    #[arg(long, value_name = "NUMBER", default_value_t = Picture::default().rate)]
    rate: f64,
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
        let champion = Champion::read(&file)?;
        let (name, places) = self.places(format, format!("{}-{}", champion.creature.name, champion.movement.name))?;
        for place in &places {
            if place.canonicalize().is_ok_and(|out| file.canonicalize().is_ok_and(|file| file == out)) {
                return Err(format!("{} is what is to be exported", file.display()).into());
            }
            check_output(place, self.force)?;
        }
        let steps = self.seconds.map(|seconds| steps_of(seconds, champion.physics.time_step)).transpose()?;
        let picture = Picture { size: self.size, rate: self.rate, ground: self.ground };
        let options = Options { name, steps, picture };
        let exported = export::export(&champion, registry, format, &options)
            .map_err(|error| format!("{}: {error}", file.display()))?;
        let written: Vec<(&Path, &[u8])> =
            places.iter().zip(&exported).map(|(place, exported)| (&**place, &*exported.bytes)).collect();
        // The file that names the others comes last: what it names is there.
        let in_order: Vec<_> = written.iter().rev().copied().collect();
        archive::write_whole_together(&in_order).map_err(|error| format!("cannot write {error}"))?;
        for (place, bytes) in written {
            say!("{}  {}, {} bytes", format.name(), place.display(), bytes.len())?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// What the files are called, and where they go: the first as asked for, the others beside it.
    fn places(&self, format: Format, name: String) -> Result<(String, Vec<PathBuf>), String> {
        let (first_ending, others) = format.endings().split_first().ok_or("a format without files")?;
        let first = self.out.clone().unwrap_or_else(|| format!("{name}{first_ending}").into());
        let last = first.file_name().map_or_else(String::new, |last| last.to_string_lossy().into_owned());
        let without_extension =
            || first.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let name = match last.strip_suffix(first_ending) {
            Some(name) if !name.is_empty() => name.to_owned(),
            _ => without_extension(),
        };
        let others: Vec<PathBuf> =
            others.iter().map(|ending| first.with_file_name(format!("{name}{ending}"))).collect();
        if others.contains(&first) {
            let out = first.display();
            return Err(format!("--out {out}: must not be called like the file beside it; {first_ending} is usual"));
        }
        Ok((name, std::iter::once(first).chain(others).collect()))
    }
}
