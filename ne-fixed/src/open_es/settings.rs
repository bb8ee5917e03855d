use super::Adam;
use crate::{Initialization, setting::check_pairs};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The settings of [`OpenEs`](crate::OpenEs). Those a file leaves out have their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct OpenEsSettings {
    /// Number of samples, even, from 2 to 1,000,000; default 50. The centre is evaluated besides, so that a generation
    /// has one individual more.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 1_000_000), extend("multipleOf" = 2)))]
    pub population: usize,
    /// The deviation of the samples from the centre, σ, in units of the weights, from 1e-6 to 1000; default 0.1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 1000.0)))]
    pub deviation: f64,
    /// What the deviation is multiplied by after each generation, above 0 and at most 1; default 1. Below 1 the search
    /// gets finer.
    #[cfg_attr(feature = "schema", schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0)))]
    pub deviation_decay: f64,
    /// What the deviation decays to, from 1e-6 to `deviation`; default 0.01.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 1000.0)))]
    pub least_deviation: f64,
    /// How the centre climbs.
    pub adam: Adam,
    /// How strongly weights are drawn to 0: a gradient of −`weight_decay` times the weight is added, from 0 to 1;
    /// default 0.005. Large weights saturate their neurons, where nothing can be learnt.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub weight_decay: f64,
    /// How the first centre is drawn; default Gaussian, scaled by fan-in.
    pub initial_centre: Initialization,
}

impl Default for OpenEsSettings {
    fn default() -> Self {
        Self {
            population: 50,
            deviation: 0.1,
            deviation_decay: 1.0,
            least_deviation: 0.01,
            adam: Adam::default(),
            weight_decay: 0.005,
            initial_centre: Initialization::ScaledGaussian { scale: 1.0 },
        }
    }
}

impl OpenEsSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `population = 7: must be even, from 2 to 1000000`.
    pub fn validate(&self) -> Result<(), SettingError> {
        check_pairs(self.population)?;
        SettingError::check_range("deviation", self.deviation, 1e-6, 1000.0)?;
        SettingError::check_above_0("deviation_decay", self.deviation_decay, 1.0)?;
        SettingError::check_range("least_deviation", self.least_deviation, 1e-6, self.deviation)?;
        self.adam.validate().map_err(|error| error.within("adam"))?;
        SettingError::check_range("weight_decay", self.weight_decay, 0.0, 1.0)?;
        self.initial_centre.validate().map_err(|error| error.within("initial_centre"))
    }
}
