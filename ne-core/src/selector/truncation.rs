use super::{Selector, ascending};
use crate::{Fitness, RandomStream, SettingError, share_rounded_up};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Truncation selection: the best share of the population become parents, with equal chances.
///
/// The number of parents is the share times the population, rounded up. Of equals those with the higher index are in.
/// Failures are parents only if all failed.
///
/// Source: Mühlenbein & Schlierkamp-Voosen, *Predictive Models for the Breeder Genetic Algorithm*, Evolutionary
/// Computation 1(1), 1993.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Truncation {
    /// The share that become parents, above 0 and at most 1 (uniform choice); default 0.2.
    #[cfg_attr(feature = "schema", schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0)))]
    pub share: f64,
}

impl Default for Truncation {
    fn default() -> Self {
        Self { share: 0.2 }
    }
}

impl Truncation {
    /// Checks the share.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_above_0("share", self.share, 1.0)
    }
}

impl Selector for Truncation {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        if scores.is_empty() {
            return;
        }
        let order = ascending(scores);
        let survivors = scores.iter().flatten().count();
        let eligible = if survivors == 0 { scores.len() } else { survivors };
        let parents = share_rounded_up(self.share, scores.len()).clamp(1, eligible);
        let best = &order[scores.len() - parents..];
        chosen.extend((0..count).map(|_| best[stream.random_range(0..best.len())]));
    }
}
