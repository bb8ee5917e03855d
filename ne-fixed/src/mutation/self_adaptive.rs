use super::Mutation;
use crate::{Setting, chance::for_each_chosen, normal::Normal};
use ne_core::{RandomStream, SettingError};
use serde::{Deserialize, Serialize};

/// Self-adaptive Gaussian mutation: each individual inherits a deviation σ, which mutates first and then measures the
/// mutation of its genes, so that good step sizes survive with the good genes they made.
///
/// σ' = σ · exp(τ N), limited to [`minimum`, `maximum`]; then each gene with probability `rate` changes by σ' N, with
/// an N of its own, normal with mean 0 and deviation 1.
///
/// Source: Schwefel, *Numerical Optimization of Computer Models*, 1981; Beyer & Schwefel, *Evolution Strategies: A
/// Comprehensive Introduction*, Natural Computing 1, 2002, section 4.2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct SelfAdaptiveMutation {
    /// The probability that a gene changes, from 0 to 1; default 0.1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub rate: f64,
    /// The deviation of the first generation, in units of the weights, from `minimum` to `maximum`; default 0.3.
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0)))]
    pub initial: f64,
    /// The least deviation, above 0 and at most 1000; default 0.01.
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0)))]
    pub minimum: f64,
    /// The greatest deviation, from `minimum` to 1000; default 2.
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0)))]
    pub maximum: f64,
    /// How fast the deviation changes, τ, from 0 to 10; default none, which means 1 / √(2n) for n genes.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
    pub learning_rate: Option<f64>,
}

impl Default for SelfAdaptiveMutation {
    fn default() -> Self {
        Self { rate: 0.1, initial: 0.3, minimum: 0.01, maximum: 2.0, learning_rate: None }
    }
}

impl Setting for SelfAdaptiveMutation {
    fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("rate", self.rate, 0.0, 1.0)?;
        SettingError::check_above_0("minimum", self.minimum, 1000.0)?;
        SettingError::check_range("maximum", self.maximum, self.minimum, 1000.0)?;
        SettingError::check_range("initial", self.initial, self.minimum, self.maximum)?;
        self.learning_rate.map_or(Ok(()), |rate| SettingError::check_range("learning_rate", rate, 0.0, 10.0))
    }
}

impl Mutation for SelfAdaptiveMutation {
    fn mutate(&self, weights: &mut [f32], deviation: &mut f32, strength: f32, stream: &mut RandomStream) {
        let normal = Normal::new();
        let learning_rate = self.learning_rate.unwrap_or_else(|| 1.0 / (2.0 * weights.len().max(1) as f64).sqrt());
        // One of another mutation has none yet.
        if *deviation == 0.0 {
            *deviation = self.initial_deviation();
        }
        *deviation *= libm::expf(learning_rate as f32 * normal.next(stream));
        *deviation = deviation.clamp(self.minimum as f32, self.maximum as f32);
        let deviation = *deviation * strength;
        for_each_chosen(self.rate, weights.len(), stream, |index, stream| {
            weights[index] += normal.next(stream) * deviation;
        });
    }

    fn initial_deviation(&self) -> f32 {
        self.initial as f32
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{changes, measured_rate, mutated, spread};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_has_no_deviation_yet_begins_with_the_initial_one() {
        let mutation = SelfAdaptiveMutation { learning_rate: Some(1e-6), ..Default::default() };
        let (_, deviation) = mutated(&mutation, vec![0.0; 20], 0.0, 1.0, 7);
        assert!((deviation - 0.3).abs() < 1e-4, "{deviation}");
    }

    proptest! {
        #[test]
        fn the_deviation_stays_within_its_bounds(start in 0.0..10.0f32, rate in 0.0..10.0f64, seed: u64) {
            let mutation = SelfAdaptiveMutation { learning_rate: Some(rate), ..Default::default() };
            let (weights, deviation) = mutated(&mutation, vec![0.0; 20], start, 1.0, seed);
            prop_assert!((0.01..=2.0).contains(&deviation));
            prop_assert!(weights.iter().all(|weight| weight.is_finite()));
        }

        #[test]
        fn rate_0_changes_the_deviation_alone(weights in proptest::collection::vec(-5.0..5.0f32, 1..200), seed: u64) {
            let mutation = SelfAdaptiveMutation { rate: 0.0, ..Default::default() };
            let (mutated, deviation) = mutated(&mutation, weights.clone(), 0.5, 1.0, seed);
            prop_assert_eq!(mutated, weights);
            prop_assert!(deviation != 0.5);
        }

        #[test]
        fn rate_1_touches_all(count in 1..200usize, seed: u64) {
            let changes = changes(&SelfAdaptiveMutation { rate: 1.0, ..Default::default() }, count, 1.0, seed);
            prop_assert!(changes.iter().all(|change| *change != 0.0));
        }
    }

    #[test]
    fn genes_change_with_the_rate() {
        for rate in [0.05, 0.7] {
            assert!((measured_rate(&SelfAdaptiveMutation { rate, ..Default::default() }) - rate).abs() < 0.006);
        }
    }

    #[test]
    fn the_logarithm_of_the_deviation_walks_with_the_learning_rate() {
        let logarithms: Vec<f32> = (0..2000)
            .map(|seed| mutated(&SelfAdaptiveMutation::default(), vec![0.0; 188], 0.3, 1.0, seed).1 / 0.3)
            .map(libm::logf)
            .collect();
        let mean = logarithms.iter().sum::<f32>() / 2000.0;
        assert!(mean.abs() < 0.005, "{mean}");
        assert!((spread(&logarithms) - 1.0 / 376.0_f64.sqrt()).abs() < 0.003);
    }

    #[test]
    fn the_strength_is_not_inherited() {
        let mutation = SelfAdaptiveMutation { rate: 1.0, ..Default::default() };
        let (weak, deviation) = mutated(&mutation, vec![0.0; 100], 0.3, 1.0, 1);
        let (strong, same) = mutated(&mutation, vec![0.0; 100], 0.3, 4.0, 1);
        assert_eq!(deviation, same);
        assert_eq!(strong, weak.iter().map(|change| 4.0 * change).collect::<Vec<_>>());
    }

    #[test]
    fn errors_name_the_field() {
        let error = |mutation: SelfAdaptiveMutation| mutation.validate().expect_err("out of range").to_string();
        let default = SelfAdaptiveMutation::default();
        for (mutation, message) in [
            (SelfAdaptiveMutation { rate: -1.0, ..default }, "rate = -1: must be from 0 to 1"),
            (SelfAdaptiveMutation { minimum: 0.0, ..default }, "minimum = 0: must be above 0 and at most 1000"),
            (SelfAdaptiveMutation { maximum: 0.001, ..default }, "maximum = 0.001: must be from 0.01 to 1000"),
            (SelfAdaptiveMutation { initial: 3.0, ..default }, "initial = 3: must be from 0.01 to 2"),
            (SelfAdaptiveMutation { learning_rate: Some(11.0), ..default }, "learning_rate = 11: must be from 0 to 10"),
        ] {
            assert_eq!(error(mutation), message);
        }
    }
}
