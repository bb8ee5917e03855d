use super::Selector;
use crate::{Fitness, RandomStream, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Tournament selection: each parent is the best of a few drawn uniformly, with repetition.
///
/// Of equals the one drawn first wins. A failure loses against any fitness; if failures alone were drawn, the best
/// individual of all is chosen instead, and one of those drawn if all are failures.
///
/// Source: Goldberg & Deb, *A Comparative Analysis of Selection Schemes*, FOGA 1991.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Tournament {
    /// How many compete, from 1 (uniform choice) to 1000; default 3. More is more selective.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub size: usize,
}

impl Default for Tournament {
    fn default() -> Self {
        Self { size: 3 }
    }
}

impl Tournament {
    /// The largest tournament.
    pub const MAX_SIZE: usize = 1000;

    /// Checks the size.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("size", self.size as f64, 1.0, Self::MAX_SIZE as f64)
    }
}

impl Selector for Tournament {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        if scores.is_empty() {
            return;
        }
        for _ in 0..count {
            let mut winner = stream.random_range(0..scores.len());
            for _ in 1..self.size {
                let rival = stream.random_range(0..scores.len());
                if scores[rival] > scores[winner] {
                    winner = rival;
                }
            }
            // Every individual drawn had failed: the best of all that have not, if there is one.
            if scores[winner].is_none() {
                let scored = (0..scores.len()).filter(|&index| scores[index].is_some());
                winner = scored.max_by_key(|&index| scores[index]).unwrap_or(winner);
            }
            chosen.push(winner);
        }
    }
}
