use crate::{GaussianMutation, Initialization};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The settings of [`HillClimbing`](crate::HillClimbing). Those a file leaves out have their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct HillClimbingSettings {
    /// Number of nets evaluated in a generation, from 2 to 1,000,000; default 16: the parent and its children.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 1_000_000)))]
    pub population: usize,
    /// The probability that a child's weight changes, from 0 to 1; default 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub mutation_rate: f64,
    /// The standard deviation of a change, in units of the weights, from 0 to 1000; default 0.1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub mutation_deviation: f64,
    /// How the weights of the first generation, of which the best is the first parent, are drawn; default uniform in ±1.
    pub initialization: Initialization,
}

impl Default for HillClimbingSettings {
    fn default() -> Self {
        let initialization = Initialization::Uniform { limit: 1.0 };
        Self { population: 16, mutation_rate: 1.0, mutation_deviation: 0.1, initialization }
    }
}

impl HillClimbingSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `mutation_rate = 2: must be from 0 to 1`.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("population", self.population as f64, 2.0, 1_000_000.0)?;
        SettingError::check_range("mutation_rate", self.mutation_rate, 0.0, 1.0)?;
        SettingError::check_range("mutation_deviation", self.mutation_deviation, 0.0, 1000.0)?;
        self.initialization.validate().map_err(|error| error.within("initialization"))
    }

    /// What makes a child of a copy of its parent.
    pub(super) fn mutation(&self) -> GaussianMutation {
        GaussianMutation { rate: self.mutation_rate, deviation: self.mutation_deviation }
    }
}
