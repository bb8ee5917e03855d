use crate::Initialization;
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The settings of [`RandomSearch`](crate::RandomSearch). Those a file leaves out have their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct RandomSearchSettings {
    /// Number of nets drawn in a generation, from 1 to 1,000,000; default 50.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1_000_000)))]
    pub population: usize,
    /// How weights are drawn; default uniform in ±1.
    pub initialization: Initialization,
}

impl Default for RandomSearchSettings {
    fn default() -> Self {
        Self { population: 50, initialization: Initialization::Uniform { limit: 1.0 } }
    }
}

impl RandomSearchSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `population = 0: must be from 1 to 1000000`.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("population", self.population as f64, 1.0, 1_000_000.0)?;
        self.initialization.validate().map_err(|error| error.within("initialization"))
    }
}
