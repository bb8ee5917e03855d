use creatures::Blueprint;
use gambol_runs::episode_parts::SetupError;
use tasks::Snapshot;

/// Why a gait cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingError {
    /// Nothing moves in fewer than two snapshots.
    #[error("a picture of a gait needs at least 2 snapshots, there are {snapshots}")]
    TooShort {
        /// How many there are.
        snapshots: usize,
    },
    /// A snapshot of another body.
    #[error("snapshot {snapshot} has {found} parts, the creature has {expected}")]
    Parts {
        /// Index of the snapshot.
        snapshot: usize,
        /// Parts of the creature.
        expected: usize,
        /// Parts of the snapshot.
        found: usize,
    },
    /// A NaN or an infinity.
    #[error("snapshot {snapshot}: the place of {part} is not a finite number")]
    NotFinite {
        /// Index of the snapshot.
        snapshot: usize,
        /// Name of the part.
        part: String,
    },
    /// A number that is out of its range.
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
    /// The episode ends before the film.
    #[error("the film is to end at {end} s, the episode of {creature} ends after {lasts:.2} s")]
    TooLate {
        /// Name of the creature.
        creature: String,
        /// How long the episode is, s.
        lasts: f64,
        /// When the film is to end, s of the episode.
        end: f64,
    },
    /// The champion's world cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The image cannot be made.
    #[error("the image cannot be made: {0}")]
    Image(String),
}

/// Whether these poses can be drawn as this creature.
pub(crate) fn check_poses(blueprint: &Blueprint, snapshots: &[Snapshot]) -> Result<(), DrawingError> {
    let parts = blueprint.parts();
    if snapshots.len() < 2 {
        return Err(DrawingError::TooShort { snapshots: snapshots.len() });
    }
    for (index, snapshot) in snapshots.iter().enumerate() {
        let (expected, found) = (parts.len(), snapshot.parts.len());
        if expected != found {
            return Err(DrawingError::Parts { snapshot: index, expected, found });
        }
        let astray = snapshot
            .parts
            .iter()
            .position(|state| ![state.x, state.y, state.cos, state.sin].iter().all(|number| number.is_finite()));
        if let Some(part) = astray {
            return Err(DrawingError::NotFinite { snapshot: index, part: parts[part].name.clone() });
        }
    }
    Ok(())
}
