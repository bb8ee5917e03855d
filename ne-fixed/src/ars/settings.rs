use crate::{Initialization, setting::check_pairs};
use ne_core::{SettingError, share_rounded_down};
use serde::{Deserialize, Serialize};

/// The settings of [`Ars`](crate::Ars). Those a file leaves out have their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct ArsSettings {
    /// Number of samples, 2N for N directions, even, from 2 to 1,000,000; default 32. The centre is evaluated besides, so
    /// that a generation has one individual more.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 1_000_000), extend("multipleOf" = 2)))]
    pub population: usize,
    /// The step size α, above 0 and at most 1000; default 0.05.
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0)))]
    pub step_size: f64,
    /// The deviation of the samples from the centre, ν, in units of the weights, from 1e-6 to 1000; default 0.1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 1000.0)))]
    pub noise: f64,
    /// The share of the directions, the best, that the step is made of, b/N, above 0 and at most 1; default ½. At least
    /// one is.
    #[cfg_attr(feature = "schema", schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0)))]
    pub top_directions: f64,
    /// How the first centre is drawn; default Gaussian, scaled by fan-in.
    pub initial_centre: Initialization,
}

impl Default for ArsSettings {
    fn default() -> Self {
        Self {
            population: 32,
            step_size: 0.05,
            noise: 0.1,
            top_directions: 0.5,
            initial_centre: Initialization::ScaledGaussian { scale: 1.0 },
        }
    }
}

impl ArsSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `population = 7: must be even, from 2 to 1000000`.
    pub fn validate(&self) -> Result<(), SettingError> {
        check_pairs(self.population)?;
        SettingError::check_above_0("step_size", self.step_size, 1000.0)?;
        SettingError::check_range("noise", self.noise, 1e-6, 1000.0)?;
        SettingError::check_above_0("top_directions", self.top_directions, 1.0)?;
        self.initial_centre.validate().map_err(|error| error.within("initial_centre"))
    }

    /// Of how many directions a step is made, b.
    pub(super) fn top(&self) -> usize {
        share_rounded_down(self.top_directions, self.population / 2).max(1)
    }
}
