/// Why a trajectory cannot be measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GaitError {
    /// Nothing moves in fewer than two snapshots.
    #[error("a gait needs at least 2 snapshots, there are {snapshots}")]
    TooShort {
        /// How many there are.
        snapshots: usize,
    },
    /// A snapshot of another body.
    #[error("snapshot {snapshot} has {found} parts, the body has {expected}")]
    Parts {
        /// Index of the snapshot.
        snapshot: usize,
        /// Parts of the body.
        expected: usize,
        /// Parts of the snapshot.
        found: usize,
    },
    /// A NaN or an infinity.
    #[error("snapshot {snapshot}: {what} is not a finite number")]
    NotFinite {
        /// Index of the snapshot.
        snapshot: usize,
        /// What it is.
        what: String,
    },
    /// Snapshots must follow each other by one constant time step.
    #[error(
        "snapshot {snapshot} comes {found} s after the one before; expected a constant step of 0.0001 to 1 s, {expected} s on average"
    )]
    Clock {
        /// Index of the snapshot.
        snapshot: usize,
        /// Mean time step, s.
        expected: f64,
        /// This time step, s.
        found: f64,
    },
    /// The body makes no sense.
    #[error("the body's {what}")]
    Body {
        /// What is wrong with it.
        what: String,
    },
}
