use crate::{CrossoverChoice, GaussianMutation, Initialization, MutationChoice, Setting, UniformCrossover};
use ne_core::{Selection, SettingError, Tournament};
use serde::{Deserialize, Serialize};

/// The settings of [`Nsga2`](crate::Nsga2). What a file leaves out has its default.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Nsga2Settings {
    /// Number of individuals evaluated in each generation, from 4 to 10,000; default 100. (Sorting takes time in
    /// proportion to its square.)
    #[cfg_attr(feature = "schema", schemars(range(min = 4, max = 10_000)))]
    pub population: usize,
    /// Whether parents are evaluated again beside their children, each half of the population, so that all were in the
    /// same worlds; default yes. Without, as in the paper, a parent keeps what it was told once, and in worlds that
    /// vary with the generation the front fills with lucky individuals.
    pub parents_again: bool,
    /// How parents are selected by rank and crowding; default a tournament of two, as in the paper.
    pub selection: Selection,
    /// The share of children that have two parents, from 0 to 1; the others begin as a copy of one. Default 0.5.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub crossover_rate: f64,
    /// How a child's genes are made from two parents'; default uniform. (The paper: simulated binary crossover.)
    pub crossover: CrossoverChoice,
    /// How a child's genes change; default Gaussian. (The paper: polynomial mutation.)
    pub mutation: MutationChoice,
    /// How the weights of the first generation are drawn; default uniform in ±1.
    pub initialization: Initialization,
}

/// Variation as in conventional neuroevolution, a population as in the paper.
impl Default for Nsga2Settings {
    fn default() -> Self {
        Self {
            population: 100,
            parents_again: true,
            selection: Selection::Tournament(Tournament { size: 2 }),
            crossover_rate: 0.5,
            crossover: CrossoverChoice::Uniform(UniformCrossover {}),
            mutation: MutationChoice::Gaussian(GaussianMutation::default()),
            initialization: Initialization::Uniform { limit: 1.0 },
        }
    }
}

impl Nsga2Settings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `mutation.gaussian.rate = 2: must be from 0 to 1`.
    pub fn validate(&self) -> Result<(), SettingError> {
        if !(4..=10_000).contains(&self.population) {
            return Err(SettingError::new("population", self.population, "from 4 to 10000"));
        }
        self.selection.validate().map_err(|error| error.within("selection"))?;
        SettingError::check_range("crossover_rate", self.crossover_rate, 0.0, 1.0)?;
        self.crossover.validate().map_err(|error| error.within("crossover"))?;
        self.mutation.validate().map_err(|error| error.within("mutation"))?;
        self.initialization.validate().map_err(|error| error.within("initialization"))
    }

    /// How many parents there are.
    pub(super) fn parent_count(&self) -> usize {
        if self.parents_again { self.population / 2 } else { self.population }
    }
}
