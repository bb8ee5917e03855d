use super::Mutation;
use crate::{
    Setting,
    chance::{for_each_chosen, symmetric},
};
use ne_core::{RandomStream, SettingError};
use serde::{Deserialize, Serialize};

/// Uniform mutation, the thesis': each gene with probability `rate` changes by a uniform amount of at most `limit`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct UniformMutation {
    /// The probability that a gene changes, from 0 to 1; default 0.1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub rate: f64,
    /// The largest change, in units of the weights, from 0 to 1000; default 0.1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub limit: f64,
}

impl Default for UniformMutation {
    fn default() -> Self {
        Self { rate: 0.1, limit: 0.1 }
    }
}

impl Setting for UniformMutation {
    fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("rate", self.rate, 0.0, 1.0)?;
        SettingError::check_range("limit", self.limit, 0.0, 1000.0)
    }
}

impl Mutation for UniformMutation {
    fn mutate(&self, weights: &mut [f32], _deviation: &mut f32, strength: f32, stream: &mut RandomStream) {
        let limit = self.limit as f32 * strength;
        for_each_chosen(self.rate, weights.len(), stream, |index, stream| weights[index] += symmetric(stream) * limit);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{changes, measured_rate, mutated, spread};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_change_exceeds_the_limit(rate in 0.0..1.0f64, limit in 0.0..2.0f64, strength in 0.5..8.0f32, seed: u64) {
            let largest = limit as f32 * strength;
            for change in changes(&UniformMutation { rate, limit }, 200, strength, seed) {
                prop_assert!(change.abs() <= largest);
            }
        }

        #[test]
        fn rate_0_is_identity(weights in proptest::collection::vec(-5.0..5.0f32, 0..200), seed: u64) {
            let mutation = UniformMutation { rate: 0.0, limit: 1.0 };
            prop_assert_eq!(mutated(&mutation, weights.clone(), 0.5, 1.0, seed), (weights, 0.5));
        }

        #[test]
        fn limit_0_is_identity(weights in proptest::collection::vec(-5.0..5.0f32, 0..200), seed: u64) {
            let mutation = UniformMutation { rate: 1.0, limit: 0.0 };
            prop_assert_eq!(mutated(&mutation, weights.clone(), 0.5, 1.0, seed), (weights, 0.5));
        }
    }

    #[test]
    fn genes_change_with_the_rate() {
        for rate in [0.05, 0.1, 0.7] {
            assert!((measured_rate(&UniformMutation { rate, limit: 1.0 }) - rate).abs() < 0.006);
        }
        // A change of exactly 0 is possible, but not with these seeds.
        assert_eq!(measured_rate(&UniformMutation { rate: 1.0, limit: 1.0 }), 1.0);
    }

    #[test]
    fn changes_fill_the_range() {
        let changes = changes(&UniformMutation { rate: 1.0, limit: 0.3 }, 20_000, 2.0, 1);
        assert!((spread(&changes) - 0.6 / 3.0_f64.sqrt()).abs() < 0.005);
    }

    #[test]
    fn errors_name_the_field() {
        let error = |mutation: UniformMutation| mutation.validate().expect_err("out of range").to_string();
        let default = UniformMutation::default();
        assert_eq!(error(UniformMutation { rate: 1.5, ..default }), "rate = 1.5: must be from 0 to 1");
        assert_eq!(error(UniformMutation { limit: -0.1, ..default }), "limit = -0.1: must be from 0 to 1000");
    }
}
