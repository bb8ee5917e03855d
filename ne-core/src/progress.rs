use serde::{Deserialize, Serialize};

/// What a run has used up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Progress {
    /// Generations done.
    pub generations: u64,
    /// Evaluations done.
    pub evaluations: u64,
    /// Steps of work done.
    pub steps: u64,
    /// Generations since the champion was found; with a [champion selection](crate::champion_selection), as of the last re-evaluation.
    pub stagnation: u64,
}
