use gambol_runs::episode_parts::SetupError;
use ne_core::Failure;
use player::{ChampionError, FileError};
use std::path::PathBuf;

/// Why a champion is not exported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// Its episode cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A player cannot play it.
    #[error(transparent)]
    Champion(#[from] ChampionError),
    /// A player's file cannot hold it.
    #[error("a player's file cannot hold it: {0}")]
    Character(#[from] FileError),
    /// What it does cannot be shown to the end.
    #[error("it cannot be played to the end: {failure}")]
    Failed {
        /// What went wrong.
        failure: Failure,
    },
    /// It does not repeat itself, so that there is no loop.
    #[error(
        "its gait has no cycle to make a loop of: its joints repeat themselves to {:.0} %, which is too little, or no stride ends \
         as it begins", 100.0 * strength
    )]
    NoCycle {
        /// How regularly its joints repeat themselves, from 0 to 1.
        strength: f64,
    },
    /// Sky and ground are to be painted behind a swimmer.
    #[error("there is no ground to paint: it swims")]
    NoGround,
    /// What it does cannot be measured.
    #[error(transparent)]
    Gait(#[from] tasks::gait::GaitError),
    /// Its creature is not valid.
    #[error(transparent)]
    Creature(#[from] creatures::CreatureError),
    /// An option that is out of its range.
    #[error("{field}: {value} is not from {least} to {most}")]
    Setting {
        /// Which.
        field: &'static str,
        /// What was asked for.
        value: f64,
        /// The least allowed.
        least: f64,
        /// The greatest allowed.
        most: f64,
    },
    /// It cannot be drawn.
    #[error(transparent)]
    Drawing(#[from] gambol_reports::drawing::DrawingError),
    /// The image cannot be made.
    #[error("the image cannot be made: {0}")]
    Image(String),
    /// Its net is too large.
    #[error("its net takes {weights} weights, those that are zero included, and a file holds {most}")]
    TooLarge {
        /// How many numbers its matrices have.
        weights: usize,
        /// How many are allowed.
        most: usize,
    },
    /// The file that was asked for is called like one that stands beside it.
    #[error("{}: must not be called like the file beside it; {usual} is usual", .file.display())]
    SameName {
        /// The file.
        file: PathBuf,
        /// How its name usually ends.
        usual: &'static str,
    },
    /// It cannot be written.
    #[error(transparent)]
    Write(#[from] std::io::Error),
}
