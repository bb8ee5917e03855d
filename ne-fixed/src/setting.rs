use ne_core::{RankSelector, Roulette, Selection, SettingError, StochasticUniversal, Tournament, Truncation};
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

/// Checks a population of pairs.
pub(crate) fn check_pairs(population: usize) -> Result<(), SettingError> {
    match (2..=1_000_000).contains(&population) && population.is_multiple_of(2) {
        true => Ok(()),
        false => Err(SettingError::new("population", population, "even, from 2 to 1000000")),
    }
}

/// Selectors of `ne-core` that check themselves.
macro_rules! checked {
    ($($selector:ty),+) => {$(
        impl Setting for $selector {
            fn validate(&self) -> Result<(), SettingError> {
                Self::validate(self)
            }
        }
    )+};
}

checked!(Selection, Tournament, RankSelector, Truncation);

impl Setting for Roulette {}

impl Setting for StochasticUniversal {}
