use super::Mutation;
use crate::{Distribution, Setting, chance::for_each_chosen};
use ne_core::{RandomStream, SettingError};
use serde::{Deserialize, Serialize};

/// Each gene with probability `rate` changes by a number of a [`Distribution`]: Cauchy, exponential, log-normal or normal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct DistributedMutation {
    /// The probability that a gene changes, from 0 to 1; default 0.05.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub rate: f64,
    /// The changes, in units of the weights; default Cauchy with scale 0.2.
    pub distribution: Distribution,
}

impl Default for DistributedMutation {
    fn default() -> Self {
        Self { rate: 0.05, distribution: Distribution::Cauchy { scale: 0.2 } }
    }
}

impl Setting for DistributedMutation {
    fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("rate", self.rate, 0.0, 1.0)?;
        self.distribution.validate().map_err(|error| error.within("distribution"))
    }
}

impl Mutation for DistributedMutation {
    fn mutate(&self, weights: &mut [f32], _deviation: &mut f32, strength: f32, stream: &mut RandomStream) {
        for_each_chosen(self.rate, weights.len(), stream, |index, stream| {
            weights[index] += self.distribution.draw(stream) * strength;
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{changes, measured_rate, mutated};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rate_0_is_identity(weights in proptest::collection::vec(-5.0..5.0f32, 0..200), seed: u64) {
            let mutation = DistributedMutation { rate: 0.0, ..DistributedMutation::default() };
            prop_assert_eq!(mutated(&mutation, weights.clone(), 0.5, 1.0, seed), (weights, 0.5));
        }

        #[test]
        fn changes_grow_with_the_strength(strength in 0.5..8.0f32, seed: u64) {
            let mutation = DistributedMutation { rate: 1.0, ..DistributedMutation::default() };
            let (plain, strong) = (changes(&mutation, 50, 1.0, seed), changes(&mutation, 50, strength, seed));
            for (plain, strong) in plain.iter().zip(strong) {
                prop_assert_eq!(plain * strength, strong);
            }
        }
    }

    #[test]
    fn genes_change_with_the_rate() {
        let mutation = DistributedMutation { rate: 0.1, ..DistributedMutation::default() };
        assert!((measured_rate(&mutation) - 0.1).abs() < 0.006);
    }

    #[test]
    fn half_of_the_changes_are_within_the_scale_and_some_far_beyond() {
        let changes = changes(&DistributedMutation { rate: 1.0, ..DistributedMutation::default() }, 20_000, 1.0, 1);
        let beyond = |distance: f32| changes.iter().filter(|change| change.abs() > distance).count() as f64 / 20_000.0;
        assert!((beyond(0.2) - 0.5).abs() < 0.02);
        // Of normal changes of this median hardly one in a hundred million is.
        assert!((beyond(2.0) - 0.063).abs() < 0.01);
    }

    #[test]
    fn errors_name_the_field() {
        let wrong = DistributedMutation { distribution: Distribution::Cauchy { scale: -1.0 }, ..Default::default() };
        let error = wrong.validate().expect_err("out of range").to_string();
        assert_eq!(error, "distribution.cauchy.scale = -1: must be from 0 to 1000");
    }
}
