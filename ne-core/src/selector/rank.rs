use super::{Selector, Wheel, ascending};
use crate::{Fitness, RandomStream, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Linear ranking: a parent's chance grows evenly with its rank, whatever the distances between fitnesses.
///
/// With n survivors, the one of rank r (0 = worst) has weight (2 − s) + 2 (s − 1) r / (n − 1), where s is the pressure:
/// the expected number of times the best is chosen per n draws. Equals rank by index. Failures have no rank; if all
/// failed the choice is uniform.
///
/// Source: Baker, *Adaptive Selection Methods for Genetic Algorithms*, ICGA 1985.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct RankSelector {
    /// The selection pressure s, from 1 (uniform) to 2 (the worst has no chance); default 1.8.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 2.0)))]
    pub pressure: f64,
}

impl Default for RankSelector {
    fn default() -> Self {
        Self { pressure: 1.8 }
    }
}

impl RankSelector {
    /// Checks the pressure.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("pressure", self.pressure, 1.0, 2.0)
    }
}

impl Selector for RankSelector {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        if scores.is_empty() {
            return;
        }
        let order = ascending(scores);
        let failed = scores.iter().filter(|score| score.is_none()).count();
        let (survivors, pressure) =
            if failed == scores.len() { (&order[..], 1.0) } else { (&order[failed..], self.pressure) };
        let last = (survivors.len() - 1).max(1) as f64;
        let weight = |rank| (2.0 - pressure) + 2.0 * (pressure - 1.0) * rank as f64 / last;
        let wheel = Wheel::new((0..survivors.len()).map(weight));
        chosen.extend((0..count).map(|_| survivors[wheel.slot(stream.random::<f64>() * wheel.circumference())]));
    }
}
