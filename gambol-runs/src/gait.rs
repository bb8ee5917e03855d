//! The gait of a champion: measured and judged as it moves in rapier.

use crate::{
    Registry,
    champion::Champion,
    episode_parts::SetupError,
    judge::{Gait, Judge},
};
use tasks::gait::GaitReport;

/// Why a champion's gait cannot be told.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GaitOfChampionError {
    /// Its world cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Its body exploded, or its controller failed, before there was anything to measure.
    #[error("its episode breaks off before there is anything to measure")]
    Unmeasurable,
}

/// Replays a champion in rapier, for as long as the judgement asks for, and measures its gait. A usable one is tried in near
/// worlds as well, on the threads of the current pool.
///
/// # Errors
/// If a field of the champion is out of range, its movement is unknown, or there is nothing to measure.
pub fn judge(champion: &Champion, registry: &Registry) -> Result<GaitReport, GaitOfChampionError> {
    measure(champion, registry).map(|gait| gait.report)
}

/// The same, and how many obstacles it passes.
///
/// # Errors
/// As [`judge`].
pub fn measure(champion: &Champion, registry: &Registry) -> Result<Gait, GaitOfChampionError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    judge.measure(&champion.network).ok_or(GaitOfChampionError::Unmeasurable)
}
