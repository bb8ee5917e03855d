use ne_core::{Selection, SettingError};
use serde::{Serialize, de::DeserializeOwned};
use std::fmt::Debug;

/// A part of a strategy that is plain data: named and adjusted in a configuration file, saved with the strategy.
///
/// It is checked once, when the strategy is made or loaded; after that it is right.
pub trait Setting: Clone + Debug + PartialEq + Serialize + DeserializeOwned + Send + Sync + 'static {
    /// Checks the numbers; by default there is nothing to check.
    ///
    /// # Errors
    /// Names the field and its range.
    fn validate(&self) -> Result<(), SettingError> {
        Ok(())
    }
}

impl Setting for Selection {
    fn validate(&self) -> Result<(), SettingError> {
        Self::validate(self)
    }
}
