use gambol_runs::episode_parts::SetupError;
use ne_core::Failure;
use player::{ChampionError, FileError};

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
    /// It cannot be written.
    #[error(transparent)]
    Write(#[from] std::io::Error),
}
