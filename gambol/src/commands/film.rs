use super::{Outcome, check_ending, check_output, gait::champion_file, write_output};
use crate::{
    Registry,
    champion::Champion,
    film::{self, Cut},
};
use clap::Args;
use std::{path::PathBuf, process::ExitCode};

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol film runs/biped-1-running --out gentleman.png
  gambol film runs/*-running --out all.png --columns 4 --from 5 --seconds 3

The image is a PNG with 25 frames a second that repeats for ever; browsers and chats play it, other programs show its first \
frame. Each creature is played in rapier, in the world without variation, and the camera follows it.")]
pub(crate) struct Film {
    /// Champion files, or folders of runs
    #[arg(required = true, value_name = "CHAMPION|FOLDER")]
    champions: Vec<PathBuf>,
    /// The image to write
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// The first moment shown, seconds after the start of the episode
    #[arg(long, value_name = "SECONDS", default_value_t = Cut::default().from)]
    from: f64,
    /// How long the film is
    #[arg(long, value_name = "SECONDS", default_value_t = Cut::default().seconds)]
    seconds: f64,
    /// Creatures side by side
    #[arg(long, value_name = "NUMBER", default_value_t = Cut::default().columns)]
    columns: u32,
    /// The width of a creature's panel
    #[arg(long, value_name = "PIXELS", default_value_t = Cut::default().width)]
    width: u32,
    /// The height of a creature's panel
    #[arg(long, value_name = "PIXELS", default_value_t = Cut::default().height)]
    height: u32,
    /// Overwrite the image if it exists
    #[arg(long)]
    force: bool,
}

impl Film {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let files = self.champions.iter().map(|path| champion_file(path)).collect::<Result<Vec<_>, _>>()?;
        if self.out.exists() {
            let out = self.out.canonicalize().ok();
            if let Some(file) = files.iter().find(|file| out.is_some() && file.canonicalize().ok() == out) {
                return Err(format!("{} is what is to be filmed", file.display()).into());
            }
        }
        check_output(&self.out, self.force)?;
        check_ending(&self.out)?;
        let Self { from, seconds, columns, width, height, .. } = self;
        let champions = files.iter().map(|file| Champion::read(file)).collect::<Result<Vec<_>, _>>()?;
        let cut = Cut { from, seconds, columns, width, height };
        let bytes = film::of_champions(&champions, &cut, registry)?;
        write_output(&self.out, &bytes, self.force)?;
        say!("film  {}, {} frames, {} kB", self.out.display(), cut.frames(), bytes.len().div_ceil(1000))?;
        Ok(ExitCode::SUCCESS)
    }
}
