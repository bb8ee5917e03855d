use super::CmaEsSettings;
use ne_core::{RandomStream, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// When the search of [`CmaEs`](crate::CmaEs) has ended, whether it begins anew, and how. The mean is drawn again, from
/// [`initial_mean`](CmaEsSettings::initial_mean), also where the first search was told where to begin; nothing else is kept of the
/// search before, but with [`Returning`](Self::Returning). The default mean is 0, so that restarts differ in their populations, step
/// sizes and samples; in the papers the mean is drawn from the domain, which weights have not.
///
/// A search has ended, by the criteria of Hansen's tutorial, appendix B.3, and of Auger & Hansen,
/// - when no weight deviates by more than the least deviation (TolX), or one by 10,000 times the first (TolXUp);
/// - when the condition number of the covariance passes 1e14 (ConditionCov);
/// - when the best fitness was the same, to within 1e-12, for 10 + ⌈30 n / λ⌉ generations (EqualFunValues);
/// - when all individuals failed for as many generations in a row, which no paper needs;
/// - when best and median fitness have not risen in a long while (Stagnation).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Restart {
    /// Never; the search goes on with the least deviation. The default.
    #[default]
    None,
    /// With twice the population each time, which sees more of a landscape's large shape.
    ///
    /// Source: Auger & Hansen, *A Restart CMA Evolution Strategy with Increasing Population Size*, CEC 2005.
    Ipop,
    /// In one of two ways, whichever has had fewer evaluations so far: with twice the population of the last such
    /// restart, or with a small population and a small step size, both by chance, for at most half the evaluations of
    /// the last large search.
    ///
    /// Source: Hansen, *Benchmarking a BI-Population CMA-ES on the BBOB-2009 Function Testbed*, GECCO 2009.
    Bipop,
    /// By turns as [`Bipop`](Self::Bipop), and back where the best search so far had ended, with a step size that can leave
    /// it. For landscapes whose best place is found early and can be made better for long, such as gaits in worlds that
    /// vary: restarts alone spend the rest of a long run in worse places.
    Returning,
    /// As [`Returning`](Self::Returning), but only for a search that was given no start: one that was told where to begin, or goes on
    /// from another task, never restarts. For a task that is learned in steps: elsewhere all of them would have to be learned again, and in a long
    /// run that is where most of it would be spent.
    Anew,
}

/// The population grows to at most this many times the first: nine doublings, as in the papers; and never beyond
/// [`MOST_GENES`](CmaEsSettings::MOST_GENES).
const GREATEST_GROWTH: usize = 512;

/// What the restarts so far have come to, and what the present search is like.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Restarts {
    /// How many there were.
    pub(super) count: u64,
    /// The population of the present search.
    pub(super) population: usize,
    /// The first step size of the present search.
    pub(super) step_size: f64,
    /// The evaluations of the present search.
    pub(super) evaluations: u64,
    /// The generations of it, up to the last, that failed as a whole.
    #[serde(default)]
    pub(super) failed_generations: usize,
    /// The regime of the present search.
    regime: Regime,
    /// The evaluations after which the present search ends in any case.
    evaluation_limit: Option<u64>,
    /// The population of the last large search.
    large_population: usize,
    /// The evaluations of the large searches that have ended, and of the last of all that was not small.
    large_evaluations: u64,
    last_large_evaluations: u64,
    /// The evaluations of the small searches that have ended.
    small_evaluations: u64,
    /// How many [starts](CmaEsSettings::starts) have ended.
    pub(super) starts: usize,
    /// Whether the first search went on from another task.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) carried: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Regime {
    First,
    Large,
    Small,
    /// Where the best search had ended.
    Return,
}

impl Restarts {
    /// Before the first restart.
    pub(super) fn new(population: usize, step_size: f64) -> Self {
        Self {
            count: 0,
            population,
            step_size,
            evaluations: 0,
            failed_generations: 0,
            regime: Regime::First,
            evaluation_limit: None,
            large_population: population,
            large_evaluations: 0,
            last_large_evaluations: 0,
            small_evaluations: 0,
            starts: 0,
            carried: false,
        }
    }

    /// Checks the numbers of a saved one.
    pub(super) fn check(&self) -> Result<(), SettingError> {
        for (field, population) in [("population", self.population), ("large_population", self.large_population)] {
            if !(2..=CmaEsSettings::MAX_POPULATION).contains(&population) {
                return Err(SettingError::new(field, population, "from 2 to 1000000"));
            }
        }
        SettingError::check_range("step_size", self.step_size, f64::MIN_POSITIVE, 1000.0)
    }

    /// Whether the present search has had its share.
    pub(super) fn is_over(&self) -> bool {
        self.evaluation_limit.is_some_and(|limit| self.evaluations >= limit)
    }

    /// Whether the present search is a place away from the best so far.
    pub(super) fn is_elsewhere(&self) -> bool {
        matches!(self.regime, Regime::Large | Regime::Small)
    }

    /// Begins the next search anew, for so many weights; `first` is the population of the first.
    pub(super) fn next(&mut self, settings: &CmaEsSettings, first: usize, weights: usize, stream: &mut RandomStream) {
        self.close();
        let bipop = matches!(settings.restart, Restart::Bipop | Restart::Returning | Restart::Anew);
        if bipop && self.small_evaluations < self.large_evaluations {
            // Hansen 2009, section 2: λ (½ λ_large / λ)^(U²), and 10^(−2U) times the step size.
            let (size, shrink): (f64, f64) = (stream.random(), stream.random());
            let growth = 0.5 * self.large_population as f64 / first as f64;
            self.population = ((first as f64 * libm::pow(growth, size * size)) as usize).max(2);
            self.step_size = (settings.step_size * libm::pow(10.0, -2.0 * shrink)).max(settings.least_deviation);
            self.regime = Regime::Small;
            self.evaluation_limit = Some(self.last_large_evaluations / 2);
        } else {
            let most = CmaEsSettings::most_individuals(weights).max(first);
            let greatest = (first * GREATEST_GROWTH).min(most);
            self.large_population = (2 * self.large_population).min(greatest);
            self.population = self.large_population;
            self.step_size = settings.step_size;
            self.regime = Regime::Large;
            self.evaluation_limit = None;
        }
    }

    /// Goes back to a search with this population and first step size.
    pub(super) fn back(&mut self, population: usize, step_size: f64) {
        self.close();
        (self.population, self.step_size) = (population, step_size);
        self.regime = Regime::Return;
        self.evaluation_limit = None;
    }

    /// The present search has ended.
    fn close(&mut self) {
        match self.regime {
            Regime::First => self.last_large_evaluations = self.evaluations,
            Regime::Large => {
                self.last_large_evaluations = self.evaluations;
                self.large_evaluations += self.evaluations;
            }
            Regime::Small => self.small_evaluations += self.evaluations,
            Regime::Return => {}
        }
        self.count += 1;
        (self.evaluations, self.failed_generations) = (0, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};

    /// 2²¹ weights of 128 individuals are a GiB.
    #[test]
    fn a_population_grows_no_further_than_memory_allows() {
        let settings = CmaEsSettings { restart: Restart::Ipop, ..CmaEsSettings::default() };
        let mut stream = Seed::of_run(1).stream(Purpose::new("test"));
        let mut populations = |weights| {
            let mut restarts = Restarts::new(32, settings.step_size);
            [(); 4].map(|()| {
                restarts.next(&settings, 32, weights, &mut stream);
                restarts.population
            })
        };
        assert_eq!(populations(100), [64, 128, 256, 512]);
        assert_eq!(populations(1 << 21), [64, 128, 128, 128]);
        assert_eq!(populations(1 << 24), [32; 4], "never fewer than at first");
    }
}
