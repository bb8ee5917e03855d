use ne_core::{Purpose, Seed, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

const TRIAL_VARIATION: Purpose = Purpose::new("trial variation");

/// How much the world differs from trial to trial, so that a gait cannot lean on one exact world. Each field is a
/// share: 0.2 draws a factor uniformly from 0.8 to 1.2. From 0 to 0.9; default 0, no variation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Variation {
    /// Of the ground's friction coefficient.
    pub friction: f32,
    /// Of the density of all parts together.
    pub mass: f32,
    /// Of the top torque of all motors together.
    pub torque: f32,
}

/// The factors of one trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Factors {
    pub(crate) friction: f32,
    pub(crate) mass: f32,
    pub(crate) torque: f32,
}

impl Factors {
    /// The world as the settings have it.
    pub(crate) const NOMINAL: Self = Self { friction: 1.0, mass: 1.0, torque: 1.0 };
}

impl Variation {
    /// Whether every trial has the same world.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        for (field, share) in [("friction", self.friction), ("mass", self.mass), ("torque", self.torque)] {
            if !(0.0..=0.9).contains(&share) {
                return Err(SettingError::new(field, share, "from 0 to 0.9"));
            }
        }
        Ok(())
    }

    pub(crate) fn draw(&self, seed: Seed) -> Factors {
        let mut stream = seed.stream(TRIAL_VARIATION);
        let mut factor = |share: f32| 1.0 + share * (2.0 * stream.random::<f32>() - 1.0);
        Factors { friction: factor(self.friction), mass: factor(self.mass), torque: factor(self.torque) }
    }
}
