use crate::Compatibility;
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// How the population is divided into species, and what becomes of them.
///
/// Source: Stanley & Miikkulainen, 2002, sections 3.3 and 4.1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SpeciationSettings {
    /// How far two genomes are apart.
    pub compatibility: Compatibility,
    /// Genomes nearer to a species' representative than this belong to it; from 0.001 to 1000. Where a number of species
    /// is aimed at it is the first threshold.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1000.0)))]
    pub threshold: f64,
    /// The number of species to aim at, by moving the threshold; none to keep the threshold, as the paper does.
    pub target: Option<TargetSpecies>,
    /// What fitness is counted from when species share it out.
    pub baseline: FitnessBaseline,
    /// A species whose best fitness has not been beaten for this many generations does not breed, at least 1; 15 in the
    /// paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub stagnation: u64,
    /// So many of the best species breed even if they stagnate, and have at least one child each; at least 1, so that
    /// there are parents. The best individual itself is lost if its species is too small for its champion to be copied.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1_000_000)))]
    pub protected: usize,
    /// What happens when the whole population stagnates; none for nothing.
    pub population_stagnation: Option<PopulationStagnation>,
}

/// A number of species to aim at: after each generation with more species the threshold rises by a step, after each with
/// fewer it falls by one, but never below one step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TargetSpecies {
    /// How many species; at least 1 and at most half of the population.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 500_000)))]
    pub species: usize,
    /// The step of the threshold, from 0.001 to 100.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 100.0)))]
    pub step: f64,
}

/// What fitness is counted from when it is shared.
///
/// Children are apportioned by the mean fitness of species, for which fitness must not be negative. A failed evaluation
/// counts as 0, the same as the worst there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum FitnessBaseline {
    /// From 0, as in the paper; if there is a negative fitness in the generation, from the lowest.
    Zero,
    /// From the lowest in the generation, so that adding a constant to all fitnesses changes nothing.
    Worst,
}

/// When the whole population has not progressed, only its best species breed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PopulationStagnation {
    /// Generations without a better best fitness after which it happens, at least 1; 20 in the paper. It happens again
    /// after as many more.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub generations: u64,
    /// How many species breed then, at least 1; 2 in the paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub species: usize,
}

impl SpeciationSettings {
    /// Checks the numbers, for a population of this size.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self, population: usize) -> Result<(), SettingError> {
        self.compatibility.validate().map_err(|error| error.within("compatibility"))?;
        SettingError::check_range("threshold", self.threshold, 0.001, 1000.0)?;
        if let Some(TargetSpecies { species, step }) = self.target {
            if species == 0 || species > population / 2 {
                let allowed = format!("at least 1 and at most {}, half of the population", population / 2);
                return Err(SettingError::new("target.species", species, allowed));
            }
            SettingError::check_range("target.step", step, 0.001, 100.0)?;
        }
        let at_least_1 = |field, value: u64| {
            if value == 0 { Err(SettingError::new(field, value, "at least 1")) } else { Ok(()) }
        };
        at_least_1("stagnation", self.stagnation)?;
        if self.protected == 0 || self.protected > population {
            let allowed = format!("at least 1 and at most {population}, the population");
            return Err(SettingError::new("protected", self.protected, allowed));
        }
        if let Some(PopulationStagnation { generations, species }) = self.population_stagnation {
            at_least_1("population_stagnation.generations", generations)?;
            at_least_1("population_stagnation.species", species as u64)?;
        }
        Ok(())
    }
}
