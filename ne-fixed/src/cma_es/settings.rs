use super::{CovarianceModel, Restart};
use crate::Initialization;
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The settings of [`CmaEs`](crate::CmaEs). Those a file leaves out have their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct CmaEsSettings {
    /// Number of individuals, from 2 to 1,000,000, until a restart changes it; default none, which is 4 + ⌊3 ln n⌋ for
    /// n weights: 19 for 188. More make the search slower and steadier, which helps where fitness is noisy or full of
    /// traps.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 1_000_000)))]
    pub population: Option<usize>,
    /// The deviation of each weight in the first generation, σ, from 1e-6 to 1000; default 0.5. A third of the
    /// distance at which the answer may lie is right.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 1000.0)))]
    pub step_size: f64,
    /// The least the greatest deviation of a weight may become, from 1e-9 to `step_size`; default 1e-5. The search does
    /// not get finer than that; with restarts it then begins anew.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-9, max = 1000.0)))]
    pub least_deviation: f64,
    /// To how many times `step_size` the greatest deviation of a weight may grow, from 1 to 10,000; default 10,000. Where worlds
    /// vary, ranks are partly chance and deviations grow without end: saturated neurons then switch joints to and fro.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 10_000.0)))]
    pub greatest_growth: f64,
    /// The share of itself that each weight of the mean loses in a generation, from 0 to 0.5; default 0. Weights that hardly matter stay
    /// small so.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.5)))]
    pub mean_decay: f64,
    /// Which covariance matrices are adapted; default separable.
    pub covariance: CovarianceModel,
    /// When a search that has ended begins anew; default never.
    pub restart: Restart,
    /// How many searches of `start_generations` begin one after the other, of which only the one that got farthest goes on; from 1
    /// to 1000; default 1, which goes on in any case. Where a search that begins badly ends badly, a few are cheap insurance. A
    /// search that is told where to begin has one.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub starts: usize,
    /// How many generations each of several starts has, from 1 to 1000000; default 20.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1_000_000)))]
    pub start_generations: u64,
    /// How the mean of the first generation, and of each restart, is drawn; default zeros.
    pub initial_mean: Initialization,
}

impl Default for CmaEsSettings {
    fn default() -> Self {
        Self {
            population: None,
            step_size: 0.5,
            least_deviation: 1e-5,
            greatest_growth: Self::MOST_GROWTH,
            mean_decay: 0.0,
            covariance: CovarianceModel::default(),
            restart: Restart::default(),
            starts: 1,
            start_generations: 20,
            initial_mean: Initialization::Uniform { limit: 0.0 },
        }
    }
}

impl CmaEsSettings {
    /// For pole balancing with nets of about ten weights, whose sums must grow far beyond 1 before a logistic output
    /// pushes hard: population 16, σ = 2, a full covariance, and a restart with twice the population as soon as the search gets finer
    /// than 0.3 or stagnates, since a search that will balance does so early. Found by experiment.
    pub fn pole_balancing() -> Self {
        Self {
            population: Some(16),
            step_size: 2.0,
            least_deviation: 0.3,
            covariance: CovarianceModel::Full,
            restart: Restart::Ipop,
            ..Self::default()
        }
    }

    /// For gaits of nets with some dozens of weights: population 64, two starts of 80 generations, and as soon as the search gets finer
    /// than 0.1 or stagnates, another one or the best so far goes on by turns. Sooner than after some 60 generations it does not show which
    /// start will find a gait and which one ends beside it. Of the small searches, whose steps are drawn from 0.005 to 0.5 and are
    /// never below 0.1, two in three begin at that limit and may end within a few generations, so that the best goes on all the sooner.
    /// Found by experiment.
    pub fn gaits() -> Self {
        let restart = Restart::Returning;
        Self {
            population: Some(64),
            least_deviation: 0.1,
            restart,
            starts: 2,
            start_generations: 80,
            ..Self::default()
        }
    }

    /// The greatest deviation that a weight may have.
    pub(super) fn greatest_deviation(&self) -> f64 {
        self.greatest_growth * self.step_size
    }

    /// A search diverges when a deviation has grown by this much.
    pub(super) const MOST_GROWTH: f64 = 1e4;

    /// The greatest population.
    pub(super) const MAX_POPULATION: usize = 1_000_000;

    /// The most weights of all individuals together: 1 GiB of them.
    pub(super) const MOST_GENES: usize = 1 << 28;

    /// The most individuals of nets with so many weights.
    pub(super) fn most_individuals(weights: usize) -> usize {
        Self::MAX_POPULATION.min(Self::MOST_GENES / weights.max(1))
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `step_size = 0: must be from 0.000001 to 1000`.
    pub fn validate(&self) -> Result<(), SettingError> {
        if let Some(population) = self.population.filter(|size| !(2..=Self::MAX_POPULATION).contains(size)) {
            return Err(SettingError::new("population", population, "from 2 to 1000000"));
        }
        SettingError::check_range("step_size", self.step_size, 1e-6, 1000.0)?;
        SettingError::check_range("least_deviation", self.least_deviation, 1e-9, self.step_size)?;
        SettingError::check_range("greatest_growth", self.greatest_growth, 1.0, Self::MOST_GROWTH)?;
        SettingError::check_range("mean_decay", self.mean_decay, 0.0, 0.5)?;
        SettingError::check_range("starts", self.starts as f64, 1.0, 1000.0)?;
        SettingError::check_range("start_generations", self.start_generations as f64, 1.0, 1e6)?;
        self.initial_mean.validate().map_err(|error| error.within("initial_mean"))
    }
}
