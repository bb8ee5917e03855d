use super::StagnationBoost;
use crate::{
    CrossoverChoice, GaussianMutation, Initialization, MutationChoice, OnePoint, Setting, UniformCrossover,
    UniformMutation,
};
use ne_core::{Roulette, Selection, SettingError, Tournament};
use serde::{Deserialize, Serialize};

/// The settings of [`ConventionalNe`](crate::ConventionalNe).
///
/// Two presets: [`thesis`](Self::thesis) and [`default`](Self::default). A file states every field (only
/// `stagnation_boost` may be left out), since what a missing one means would depend on the preset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ConventionalNeSettings<S = Selection, C = CrossoverChoice, M = MutationChoice> {
    /// Number of individuals, from 2 to 1,000,000.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 1_000_000)))]
    pub population: usize,
    /// How many of the best pass into the next generation unchanged, below `population`.
    #[cfg_attr(feature = "schema", schemars(range(max = 999_999)))]
    pub elites: usize,
    /// How many newcomers, drawn like the first generation, join each generation; with the elites below `population`.
    #[cfg_attr(feature = "schema", schemars(range(max = 999_999)))]
    pub immigrants: usize,
    /// How parents are selected.
    pub selection: S,
    /// The share of children that have two parents, from 0 to 1; the others begin as a copy of one.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub crossover_rate: f64,
    /// How a child's genes are made from two parents'.
    pub crossover: C,
    /// How a child's genes change, whether it has one parent or two.
    pub mutation: M,
    /// How the weights of the first generation are drawn.
    pub initialization: Initialization,
    /// How much larger mutations become when the population stagnates; none for never.
    pub stagnation_boost: Option<StagnationBoost>,
}

impl ConventionalNeSettings {
    /// The algorithm of the thesis: population 50, roulette selection, one-point crossover 0.7, each gene mutated with
    /// probability 0.1 by at most 0.1, no elite, first weights uniform in ±1.
    ///
    /// Source: Gegendorfer, *Using Neuroevolution for Physics-Based Character Animation in Two Dimensions*, TU Wien,
    /// 2017. The thesis does not say how the first weights are drawn, and calls the elite optional.
    pub fn thesis() -> Self {
        Self {
            population: 50,
            elites: 0,
            immigrants: 0,
            selection: Selection::Roulette(Roulette {}),
            crossover_rate: 0.7,
            crossover: CrossoverChoice::OnePoint(OnePoint {}),
            mutation: MutationChoice::Uniform(UniformMutation { rate: 0.1, limit: 0.1 }),
            initialization: Initialization::Uniform { limit: 1.0 },
            stagnation_boost: None,
        }
    }
}

/// The project's own: chosen by experiment on closed-loop control (swimmers of 3 to 7 links in a viscous fluid, two poles
/// on a cart, jumping creatures), where it is ahead of the thesis'. The stagnation boost is off: with so few genes
/// mutated by so much, jumping creatures did better without it.
impl Default for ConventionalNeSettings {
    fn default() -> Self {
        Self {
            population: 50,
            elites: 2,
            immigrants: 0,
            selection: Selection::Tournament(Tournament { size: 3 }),
            crossover_rate: 0.5,
            crossover: CrossoverChoice::Uniform(UniformCrossover {}),
            mutation: MutationChoice::Gaussian(GaussianMutation { rate: 0.05, deviation: 0.5 }),
            initialization: Initialization::Uniform { limit: 1.0 },
            stagnation_boost: None,
        }
    }
}

impl<S: Setting, C: Setting, M: Setting> ConventionalNeSettings<S, C, M> {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `mutation.gaussian.rate = 2: must be from 0 to 1`.
    pub fn validate(&self) -> Result<(), SettingError> {
        if !(2..=1_000_000).contains(&self.population) {
            return Err(SettingError::new("population", self.population, "from 2 to 1000000"));
        }
        let below = |field, value, bound| {
            if value < bound { Ok(()) } else { Err(SettingError::new(field, value, format!("below {bound}"))) }
        };
        below("elites", self.elites, self.population)?;
        below("immigrants", self.immigrants, self.population - self.elites)?;
        self.selection.validate().map_err(|error| error.within("selection"))?;
        SettingError::check_range("crossover_rate", self.crossover_rate, 0.0, 1.0)?;
        self.crossover.validate().map_err(|error| error.within("crossover"))?;
        self.mutation.validate().map_err(|error| error.within("mutation"))?;
        self.initialization.validate().map_err(|error| error.within("initialization"))?;
        let boost = self.stagnation_boost.as_ref();
        boost.map_or(Ok(()), |boost| boost.validate().map_err(|error| error.within("stagnation_boost")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_thesis_preset_is_the_thesis() {
        let text = serde_json::to_value(ConventionalNeSettings::thesis()).expect("serialises");
        let expected = serde_json::json!({
            "population": 50,
            "elites": 0,
            "immigrants": 0,
            "selection": {"roulette": {}},
            "crossover_rate": 0.7,
            "crossover": {"one-point": {}},
            "mutation": {"uniform": {"rate": 0.1, "limit": 0.1}},
            "initialization": {"uniform": {"limit": 1.0}},
            "stagnation_boost": null,
        });
        assert_eq!(text, expected);
    }

    #[test]
    fn presets_are_valid_and_survive_serialisation() {
        for settings in [ConventionalNeSettings::thesis(), ConventionalNeSettings::default()] {
            assert_eq!(settings.validate(), Ok(()));
            let text = serde_json::to_string(&settings).expect("serialises");
            let loaded: ConventionalNeSettings = serde_json::from_str(&text).expect("deserialises");
            assert_eq!(loaded, settings);
        }
    }

    #[test]
    fn errors_name_the_field() {
        type Change = fn(&mut ConventionalNeSettings);
        let changes: [(Change, &str); 11] = [
            (|s| s.population = 0, "population = 0: must be from 2 to 1000000"),
            (|s| s.population = 1, "population = 1: must be from 2 to 1000000"),
            (|s| s.population = 1_000_001, "population = 1000001: must be from 2 to 1000000"),
            (|s| s.elites = 50, "elites = 50: must be below 50"),
            (|s| s.immigrants = 48, "immigrants = 48: must be below 48"),
            (|s| s.crossover_rate = 1.1, "crossover_rate = 1.1: must be from 0 to 1"),
            (|s| s.crossover_rate = f64::NAN, "crossover_rate = NaN: must be from 0 to 1"),
            (
                |s| s.selection = Selection::Tournament(Tournament { size: 0 }),
                "selection.tournament.size = 0: must be from 1 to 1000",
            ),
            (
                |s| s.mutation = MutationChoice::Gaussian(GaussianMutation { rate: 2.0, deviation: 0.1 }),
                "mutation.gaussian.rate = 2: must be from 0 to 1",
            ),
            (
                |s| s.initialization = Initialization::Uniform { limit: f64::INFINITY },
                "initialization.uniform.limit = inf: must be from 0 to 1000",
            ),
            (
                |s| s.stagnation_boost = Some(StagnationBoost { patience: 0, ..Default::default() }),
                "stagnation_boost.patience = 0: must be at least 1",
            ),
        ];
        for (change, message) in changes {
            let mut settings = ConventionalNeSettings { elites: 2, ..Default::default() };
            change(&mut settings);
            assert_eq!(settings.validate().expect_err("out of range").to_string(), message);
        }
    }
}
