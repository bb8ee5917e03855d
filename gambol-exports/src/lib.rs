//! What leaves Gambol: a champion in the formats that games and other programs read.
//!
//! Each [`Format`] is a file; [`export`] gives its bytes, and what is not whole is not given. All of them show the champion as
//! `gambol gait` judges it: in rapier, in the world without variation.
//!
//! | format | what it is |
//! |---|---|
//! | [`Player`](Format::Player) | a character for the crate `player`, a few kB: see `docs/player.md` |
//! | [`Trace`](Format::Trace) | what was sensed and commanded at every step, which a player must give again |
//! | [`Csv`](Format::Csv) | the trajectory: where every part is at every step |

mod character;
mod error;
mod trace;

pub use character::character_of;
pub use error::ExportError;

use gambol_runs::{Registry, champion::Champion, judge::Judge, trajectory::Recording};
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
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Player, Self::Trace, Self::Csv];

    /// The name a command line has for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Player => "player",
            Self::Trace => "trace",
            Self::Csv => "csv",
        }
    }

    /// How the name of such a file ends.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Player => "player",
            Self::Trace => "trace.csv",
            Self::Csv => "csv",
        }
    }
}

/// A champion in another format. `steps`: how long it is played, for formats that show it; by default as long as it is judged.
///
/// # Errors
/// If the champion's episode cannot be built, or the format cannot hold it: the error names the field.
pub fn export(
    champion: &Champion,
    registry: &Registry,
    format: Format,
    steps: Option<u32>,
) -> Result<Vec<u8>, ExportError> {
    match format {
        Format::Player => Ok(character_of(champion, registry)?.to_bytes()?),
        Format::Trace => trace::of(champion, registry, steps),
        Format::Csv => trajectory(champion, registry, steps),
    }
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
