use super::Permutation;
use crate::{CrossoverChoice, Initialization, OnePoint, Setting};
use ne_core::{SettingError, share_rounded_down};
use serde::{Deserialize, Serialize};

/// The settings of [`Cosyne`](crate::Cosyne). Those a file leaves out have their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct CosyneSettings {
    /// Number of nets, and of weights in each subpopulation, from 2 to 1,000,000; default 50.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 1_000_000)))]
    pub population: usize,
    /// The share of the nets, the best, that are parents, above 0 and at most 1; default ¼. At least two are.
    #[cfg_attr(feature = "schema", schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0)))]
    pub parents: f64,
    /// The share of the nets, the worst, that children take the place of, from 0 to below 1; default ¾.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0), extend("exclusiveMaximum" = 1.0)))]
    pub offspring: f64,
    /// How a child's genes are made from two parents'; default one-point.
    pub crossover: CrossoverChoice,
    /// The probability that a child's gene mutates, from 0 to 1; default 0.1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub mutation_rate: f64,
    /// The scale of mutations, which have a Cauchy distribution, in units of the weights, from 0 to 1000; default 0.3.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub mutation_scale: f64,
    /// Which weights change places; default by fitness.
    pub permutation: Permutation,
    /// How the weights of the first generation are drawn; default uniform in ±1.
    pub initialization: Initialization,
    /// Generations without a better best fitness after which the search begins anew, at least 1; default none, for never.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub restart: Option<u64>,
}

/// Chosen by experiment: two poles with velocities, a net 6-8-1. There, fewer children make the search slower, since nets
/// that are kept whole are evaluated again.
impl Default for CosyneSettings {
    fn default() -> Self {
        Self {
            population: 50,
            parents: 0.25,
            offspring: 0.75,
            crossover: CrossoverChoice::OnePoint(OnePoint {}),
            mutation_rate: 0.1,
            mutation_scale: 0.3,
            permutation: Permutation::ByFitness,
            initialization: Initialization::Uniform { limit: 1.0 },
            restart: None,
        }
    }
}

impl CosyneSettings {
    /// For pole balancing with nets of about ten weights: population 16, first weights uniform in ±10, strong
    /// mutation, all weights permuted, and a new search after 60 generations without progress, since one that will balance
    /// does so early. Found by experiment.
    pub fn pole_balancing() -> Self {
        Self {
            population: 16,
            mutation_rate: 0.8,
            mutation_scale: 2.0,
            permutation: Permutation::All,
            initialization: Initialization::Uniform { limit: 10.0 },
            restart: Some(60),
            ..Self::default()
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `mutation_rate = 2: must be from 0 to 1`.
    pub fn validate(&self) -> Result<(), SettingError> {
        if !(2..=1_000_000).contains(&self.population) {
            return Err(SettingError::new("population", self.population, "from 2 to 1000000"));
        }
        SettingError::check_above_0("parents", self.parents, 1.0)?;
        if !(0.0..1.0).contains(&self.offspring) {
            return Err(SettingError::new("offspring", self.offspring, "from 0 to below 1"));
        }
        self.crossover.validate().map_err(|error| error.within("crossover"))?;
        SettingError::check_range("mutation_rate", self.mutation_rate, 0.0, 1.0)?;
        SettingError::check_range("mutation_scale", self.mutation_scale, 0.0, 1000.0)?;
        self.initialization.validate().map_err(|error| error.within("initialization"))?;
        if self.restart == Some(0) {
            return Err(SettingError::new("restart", 0, "at least 1"));
        }
        Ok(())
    }

    /// How many nets are parents.
    pub(super) fn parent_count(&self) -> usize {
        share_rounded_down(self.parents, self.population).max(2)
    }

    /// How many nets children take the place of.
    pub(super) fn offspring_count(&self) -> usize {
        share_rounded_down(self.offspring, self.population)
    }
}
