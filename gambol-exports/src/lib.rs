//! What leaves Gambol: a champion in the formats that games and other programs read.
//!
//! Each [`Format`] is a file, or several that belong together; [`export`] gives their bytes, and what is not whole is not given. All of
//! them show the champion as `gambol gait` judges it: in rapier, in the world without variation. Pictures and animations show
//! its [`Cycle`]: the stride of the gait that meets itself best, made to meet itself exactly.
//!
//! | format | what it is |
//! |---|---|
//! | [`Player`](Format::Player) | a character for the crate `player`, a few kB: see `docs/player.md` |
//! | [`Trace`](Format::Trace) | what was sensed and commanded at every step, which a player must give again |
//! | [`Csv`](Format::Csv) | the trajectory: where every part is at every step |
//! | [`Gif`](Format::Gif), [`Apng`](Format::Apng), [`Svg`](Format::Svg) | a loop, transparent or with ground |
//! | [`Sprites`](Format::Sprites) | a sheet of frames with its atlas, root motion for each frame |
//! | [`Gltf`](Format::Gltf) | body and gait in three dimensions, with root motion |
//! | [`DragonBones`](Format::DragonBones) | a skeleton with its gait, in place, and pictures of its parts on a texture atlas |
//! | [`Onnx`](Format::Onnx) | the net, and as metadata what its inputs and outputs are |

mod bones;
mod character;
mod cycle;
mod destination;
mod dragonbones;
mod error;
mod gltf;
mod onnx;
mod outline;
mod picture;
mod pose;
#[cfg(test)]
mod sample;
mod trace;

pub use character::character_of;
pub use cycle::Cycle;
pub use destination::Destination;
pub use error::ExportError;
pub use picture::Picture;
pub use pose::Pose;

use creatures::Blueprint;
use gambol_runs::{Registry, champion::Champion, judge::Judge, trajectory::Recording};
use picture::Loop;
use tasks::{Body, Environment};

/// What a champion can be exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A character for the crate `player`.
    Player,
    /// A golden trace for it.
    Trace,
    /// A trajectory.
    Csv,
    /// A loop as a GIF image.
    Gif,
    /// A loop as an animated PNG image.
    Apng,
    /// A loop as an animated SVG image.
    Svg,
    /// A loop as a sheet of frames, with its atlas.
    Sprites,
    /// Body and gait as glTF.
    Gltf,
    /// Body and gait as a skeleton for DragonBones, with a texture atlas of the parts.
    DragonBones,
    /// The net as an ONNX model.
    Onnx,
}

/// How a champion is exported.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What the files are called, without their endings; a file that names another needs it.
    pub name: String,
    /// How many steps are shown, for traces and trajectories; by default as many as are judged.
    pub steps: Option<u32>,
    /// How pictures are drawn.
    pub picture: Picture,
}

/// A file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// How its name ends, with the dot or other sign before.
    pub ending: &'static str,
    /// What is in it.
    pub bytes: Vec<u8>,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 10] = [
        Self::Player,
        Self::Trace,
        Self::Csv,
        Self::Gif,
        Self::Apng,
        Self::Svg,
        Self::Sprites,
        Self::Gltf,
        Self::DragonBones,
        Self::Onnx,
    ];

    /// The name a command line has for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Player => "player",
            Self::Trace => "trace",
            Self::Csv => "csv",
            Self::Gif => "gif",
            Self::Apng => "apng",
            Self::Svg => "svg",
            Self::Sprites => "sprites",
            Self::Gltf => "gltf",
            Self::DragonBones => "dragonbones",
            Self::Onnx => "onnx",
        }
    }

    /// How the names of its files end, after what they are [called](Options::name); the first is the file that is asked for.
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Player => &[".player"],
            Self::Trace => &[".trace.csv"],
            Self::Csv => &[".csv"],
            Self::Gif => &[".gif"],
            Self::Apng => &[".apng"],
            Self::Svg => &[".svg"],
            Self::Sprites => &[".json", ".png"],
            Self::Gltf => &[".gltf"],
            Self::DragonBones => &["_ske.json", "_tex.json", "_tex.png"],
            Self::Onnx => &[".onnx"],
        }
    }
}

/// A champion in another format: files in the order of its [endings](Format::endings).
///
/// # Errors
/// If the champion's episode cannot be built, its gait has no cycle though the format wants one, an option is out of range, or
/// the format cannot hold it: the error names the field.
pub fn export(
    champion: &Champion,
    registry: &Registry,
    format: Format,
    options: &Options,
) -> Result<Vec<Exported>, ExportError> {
    let files = match format {
        Format::Player => vec![character_of(champion, registry)?.to_bytes()?],
        Format::Trace => vec![trace::of(champion, registry, options.steps)?],
        Format::Csv => vec![trajectory(champion, registry, options.steps)?],
        Format::Gif => vec![picture::gif(&drawn_at(champion, registry, &options.picture, picture::GIF_RATE)?)?],
        Format::Apng => vec![picture::apng(&drawn(champion, registry, &options.picture)?)?],
        Format::Svg => {
            vec![picture::svg(
                &drawn(champion, registry, &options.picture)?,
                &Blueprint::new(champion.creature.clone())?,
            )]
        }
        Format::Sprites => {
            let (name, image) = ([&*champion.creature.name, &*champion.movement.name], format!("{}.png", options.name));
            let (sheet, atlas) = picture::sprites(&drawn(champion, registry, &options.picture)?, name, &image)?;
            vec![atlas, sheet]
        }
        Format::Gltf => vec![gltf::of(champion, registry)?],
        Format::DragonBones => dragonbones::of(champion, registry, options)?.into(),
        Format::Onnx => vec![onnx::of(champion, registry)?],
    };
    Ok(format.endings().iter().zip(files).map(|(ending, bytes)| Exported { ending, bytes }).collect())
}

fn drawn(champion: &Champion, registry: &Registry, picture: &Picture) -> Result<Loop, ExportError> {
    drawn_at(champion, registry, picture, f64::INFINITY)
}

/// With at most so many frames a second.
fn drawn_at(champion: &Champion, registry: &Registry, picture: &Picture, most: f64) -> Result<Loop, ExportError> {
    picture.check()?;
    if picture.ground && champion.physics.water.is_some() {
        return Err(ExportError::NoGround);
    }
    let cycle = Cycle::of_champion(champion, registry)?;
    let picture = picture.at_most(most, &cycle);
    Loop::new(&Blueprint::new(champion.creature.clone())?, cycle, &picture)
}

fn trajectory(champion: &Champion, registry: &Registry, steps: Option<u32>) -> Result<Vec<u8>, ExportError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    let world = judge.environment();
    let (recording, failure) = Recording::play(world, &champion.network, steps.unwrap_or(judge.steps()));
    if let Some(failure) = failure {
        return Err(ExportError::Failed { failure });
    }
    let mut csv = Vec::new();
    recording.write_csv(world.body().unwrap_or(&Body::default()), &mut csv)?;
    Ok(csv)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_two_formats_may_lie_side_by_side() {
        let endings: Vec<_> = Format::ALL.into_iter().flat_map(Format::endings).collect();
        for (index, ending) in endings.iter().enumerate() {
            assert!(!endings[..index].contains(ending), "{ending}");
        }
    }
}
