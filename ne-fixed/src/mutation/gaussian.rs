use super::Mutation;
use crate::{Setting, chance::for_each_chosen, normal::Normal};
use ne_core::{RandomStream, SettingError};
use serde::{Deserialize, Serialize};

/// Gaussian mutation: each gene with probability `rate` changes by a normally distributed amount.
///
/// Most changes are small, a few are large: unlike the uniform mutation it can leave any local optimum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct GaussianMutation {
    /// The probability that a gene changes, from 0 to 1; default 0.05.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub rate: f64,
    /// The standard deviation of a change, in units of the weights, from 0 to 1000; default 0.5.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub deviation: f64,
}

impl Default for GaussianMutation {
    fn default() -> Self {
        Self { rate: 0.05, deviation: 0.5 }
    }
}

impl Setting for GaussianMutation {
    fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("rate", self.rate, 0.0, 1.0)?;
        SettingError::check_range("deviation", self.deviation, 0.0, 1000.0)
    }
}

impl Mutation for GaussianMutation {
    fn mutate(&self, weights: &mut [f32], _deviation: &mut f32, strength: f32, stream: &mut RandomStream) {
        let deviation = self.deviation as f32 * strength;
        let normal = Normal::new();
        for_each_chosen(self.rate, weights.len(), stream, |index, stream| {
            weights[index] += normal.next(stream) * deviation;
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{changes, measured_rate, mutated, spread};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rate_0_is_identity(weights in proptest::collection::vec(-5.0..5.0f32, 0..200), seed: u64) {
            let mutation = GaussianMutation { rate: 0.0, deviation: 1.0 };
            prop_assert_eq!(mutated(&mutation, weights.clone(), 0.5, 1.0, seed), (weights, 0.5));
        }

        #[test]
        fn rate_1_touches_all(count in 1..200usize, seed: u64) {
            let changes = changes(&GaussianMutation { rate: 1.0, deviation: 1.0 }, count, 1.0, seed);
            prop_assert!(changes.iter().all(|change| change.is_finite() && *change != 0.0));
        }
    }

    #[test]
    fn genes_change_with_the_rate() {
        for rate in [0.05, 0.1, 0.7] {
            assert!((measured_rate(&GaussianMutation { rate, deviation: 1.0 }) - rate).abs() < 0.006);
        }
    }

    #[test]
    fn changes_have_the_deviation_times_the_strength() {
        for strength in [1.0, 3.0] {
            let changes = changes(&GaussianMutation { rate: 1.0, deviation: 0.2 }, 20_000, strength, 1);
            assert!((spread(&changes) / f64::from(strength) - 0.2).abs() < 0.004);
        }
    }

    #[test]
    fn errors_name_the_field() {
        let error = |mutation: GaussianMutation| mutation.validate().expect_err("out of range").to_string();
        let default = GaussianMutation::default();
        assert_eq!(error(GaussianMutation { rate: f64::NAN, ..default }), "rate = NaN: must be from 0 to 1");
        assert_eq!(
            error(GaussianMutation { deviation: 1001.0, ..default }),
            "deviation = 1001: must be from 0 to 1000"
        );
    }
}
