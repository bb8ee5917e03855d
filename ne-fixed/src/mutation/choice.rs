use super::{DistributedMutation, GaussianMutation, Mutation, SelfAdaptiveMutation, UniformMutation};
use crate::Setting;
use ne_core::{RandomStream, SettingError};
use serde::{Deserialize, Serialize};

/// One of the four mutation operators, chosen at run time: how a configuration file names it.
///
/// In JSON the name with its settings: `{"gaussian": {"rate": 0.1, "deviation": 0.2}}`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum MutationChoice {
    /// Changes within a limit.
    Uniform(UniformMutation),
    /// Normally distributed changes.
    Gaussian(GaussianMutation),
    /// Normally distributed changes whose deviation evolves.
    SelfAdaptive(SelfAdaptiveMutation),
    /// Changes of another distribution, such as Cauchy.
    Distributed(DistributedMutation),
}

impl Setting for MutationChoice {
    fn validate(&self) -> Result<(), SettingError> {
        match self {
            Self::Uniform(mutation) => mutation.validate().map_err(|error| error.within("uniform")),
            Self::Gaussian(mutation) => mutation.validate().map_err(|error| error.within("gaussian")),
            Self::SelfAdaptive(mutation) => mutation.validate().map_err(|error| error.within("self-adaptive")),
            Self::Distributed(mutation) => mutation.validate().map_err(|error| error.within("distributed")),
        }
    }
}

impl Mutation for MutationChoice {
    fn mutate(&self, weights: &mut [f32], deviation: &mut f32, strength: f32, stream: &mut RandomStream) {
        match self {
            Self::Uniform(mutation) => mutation.mutate(weights, deviation, strength, stream),
            Self::Gaussian(mutation) => mutation.mutate(weights, deviation, strength, stream),
            Self::SelfAdaptive(mutation) => mutation.mutate(weights, deviation, strength, stream),
            Self::Distributed(mutation) => mutation.mutate(weights, deviation, strength, stream),
        }
    }

    fn initial_deviation(&self) -> f32 {
        match self {
            Self::Uniform(mutation) => mutation.initial_deviation(),
            Self::Gaussian(mutation) => mutation.initial_deviation(),
            Self::SelfAdaptive(mutation) => mutation.initial_deviation(),
            Self::Distributed(mutation) => mutation.initial_deviation(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::mutated;
    use super::*;

    #[test]
    fn does_what_the_chosen_operator_does() {
        let weights = vec![0.5; 30];
        let mutate = |choice: MutationChoice| mutated(&choice, weights.clone(), 0.1, 2.0, 1);
        let uniform = UniformMutation::default();
        assert_eq!(mutate(MutationChoice::Uniform(uniform)), mutated(&uniform, weights.clone(), 0.1, 2.0, 1));
        let gaussian = GaussianMutation::default();
        assert_eq!(mutate(MutationChoice::Gaussian(gaussian)), mutated(&gaussian, weights.clone(), 0.1, 2.0, 1));
        let distributed = DistributedMutation::default();
        assert_eq!(
            mutate(MutationChoice::Distributed(distributed)),
            mutated(&distributed, weights.clone(), 0.1, 2.0, 1)
        );
        let adaptive = SelfAdaptiveMutation::default();
        assert_eq!(mutate(MutationChoice::SelfAdaptive(adaptive)), mutated(&adaptive, weights.clone(), 0.1, 2.0, 1));
        assert_eq!(MutationChoice::SelfAdaptive(adaptive).initial_deviation(), 0.3);
        assert_eq!(MutationChoice::Gaussian(gaussian).initial_deviation(), 0.0);
    }

    #[test]
    fn is_named_in_files_and_names_the_field_in_errors() {
        for (text, message) in [
            (r#"{"uniform":{"rate":2.0,"limit":0.1}}"#, "uniform.rate = 2: must be from 0 to 1"),
            (r#"{"gaussian":{"rate":0.1,"deviation":-1.0}}"#, "gaussian.deviation = -1: must be from 0 to 1000"),
            (
                r#"{"self-adaptive":{"rate":-1.0,"initial":0.3,"minimum":0.01,"maximum":2.0,"learning_rate":null}}"#,
                "self-adaptive.rate = -1: must be from 0 to 1",
            ),
            (
                r#"{"distributed":{"rate":0.1,"distribution":{"exponential":{"mean":-1.0}}}}"#,
                "distributed.distribution.exponential.mean = -1: must be from 0 to 1000",
            ),
        ] {
            let choice: MutationChoice = serde_json::from_str(text).expect("deserialises");
            assert_eq!(serde_json::to_string(&choice).expect("serialises"), text);
            assert_eq!(choice.validate().expect_err("out of range").to_string(), message);
        }
    }
}
