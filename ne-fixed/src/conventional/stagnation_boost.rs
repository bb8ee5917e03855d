use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// Larger mutations when a population stagnates, in the hope of leaving the local optimum it sits in.
///
/// Each time the best fitness so far has not been beaten for another `patience` generations, mutations are multiplied
/// by `factor`, up to `limit`; with the first progress the strength is 1 again.
///
/// Source: an idea the thesis left for later; a slow form of Cobb's triggered hypermutation (*An Investigation into the
/// Use of Hypermutation*, NRL Memorandum 6760, 1990).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct StagnationBoost {
    /// Generations without progress until the strength rises (again), at least 1; default 10.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub patience: u64,
    /// What the strength is multiplied by, from 1 to 100; default 1.5.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 100.0)))]
    pub factor: f64,
    /// The greatest strength, from 1 to 100; default 4.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 100.0)))]
    pub limit: f64,
}

impl Default for StagnationBoost {
    fn default() -> Self {
        Self { patience: 10, factor: 1.5, limit: 4.0 }
    }
}

impl StagnationBoost {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        if self.patience == 0 {
            return Err(SettingError::new("patience", self.patience, "at least 1"));
        }
        SettingError::check_range("factor", self.factor, 1.0, 100.0)?;
        SettingError::check_range("limit", self.limit, 1.0, 100.0)
    }

    /// The strength of mutations after this many generations without progress: from 1 to `limit`.
    pub fn strength(&self, stagnation: u64) -> f64 {
        let mut strength = 1.0;
        // Not `powi`, whose rounding depends on the platform. The loop ends by the second condition or, with a factor
        // next to 1, after a thousand rounds.
        for _ in 0..(stagnation / self.patience).min(1000) {
            if strength >= self.limit {
                break;
            }
            strength *= self.factor;
        }
        strength.min(self.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rises_in_steps_to_the_limit() {
        let boost = StagnationBoost { patience: 10, factor: 2.0, limit: 5.0 };
        for (stagnation, strength) in [(0, 1.0), (9, 1.0), (10, 2.0), (19, 2.0), (20, 4.0), (30, 5.0), (u64::MAX, 5.0)]
        {
            assert_eq!(boost.strength(stagnation), strength, "{stagnation}");
        }
    }

    #[test]
    fn errors_name_the_field() {
        let error = |boost: StagnationBoost| boost.validate().expect_err("out of range").to_string();
        let default = StagnationBoost::default();
        assert_eq!(error(StagnationBoost { patience: 0, ..default }), "patience = 0: must be at least 1");
        assert_eq!(error(StagnationBoost { factor: 0.5, ..default }), "factor = 0.5: must be from 1 to 100");
        assert_eq!(error(StagnationBoost { limit: 1000.0, ..default }), "limit = 1000: must be from 1 to 100");
    }
}
