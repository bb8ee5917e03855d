//! The selection of a child's parents.

use crate::{noise::happens, speciation::Species};
use ne_core::{RandomStream, SettingError, share_rounded_up};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Which individuals breed within a species, and how.
///
/// Source: Stanley & Miikkulainen, 2002, section 4.1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ReproductionSettings {
    /// The share of the best members of a species that breed, at least one of them; above 0, to 1. Where it is one, the
    /// species' children have a single parent.
    #[cfg_attr(feature = "schema", schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0)))]
    pub survival_share: f64,
    /// The best of a species with more members than this is copied unchanged; 5 in the paper.
    pub champion_above: usize,
    /// The share of children that have one parent, from 0 to 1; 0.25 in the paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub mutation_only: f64,
    /// The share of crossovers whose second parent is of another species, from 0 to 1; 0.001 in the paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub interspecies: f64,
}

impl ReproductionSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_above_0("survival_share", self.survival_share, 1.0)?;
        SettingError::check_range("mutation_only", self.mutation_only, 0.0, 1.0)?;
        SettingError::check_range("interspecies", self.interspecies, 0.0, 1.0)
    }

    /// Those of a species that breed.
    pub(crate) fn survivors<'a>(&self, species: &'a Species) -> &'a [usize] {
        let size = species.members.len();
        let survivors = share_rounded_up(self.survival_share, size);
        &species.members[..survivors.clamp(1, size)]
    }

    /// The parents of a child of the breeding species `home`; both the same if it has only one.
    pub(crate) fn parents(&self, home: usize, breeders: &[&Species], stream: &mut RandomStream) -> (usize, usize) {
        let one_of = |species: usize, stream: &mut RandomStream| {
            let survivors = self.survivors(breeders[species]);
            survivors[stream.random_range(0..survivors.len())]
        };
        let first = one_of(home, stream);
        if happens(self.mutation_only, stream) {
            return (first, first);
        }
        let mut other = home;
        if breeders.len() > 1 && happens(self.interspecies, stream) {
            other = stream.random_range(0..breeders.len() - 1);
            other += usize::from(other >= home);
        }
        (first, one_of(other, stream))
    }
}
