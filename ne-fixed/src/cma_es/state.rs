use super::{
    CmaEs, CmaEsSettings, CovarianceModel, covariance::Covariance, distribution::Distribution, history::History,
    restart::Restarts, strategy::Kept, triangle::Triangle,
};
use crate::{
    StateError,
    state_error::{check_numbers, generation},
};
use ne_core::SettingError;
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// A [`CmaEs`] as a checkpoint has it: without the factor of the covariance, which follows from it, and without memory
/// that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "CmaEs")]
pub(super) struct State {
    settings: CmaEsSettings,
    topology: Topology,
    start: Option<Vec<f32>>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    is_guess: bool,
    restarts: Restarts,
    history: History,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    kept: Option<KeptState>,
    distribution: Option<DistributionState>,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Vec<f32>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct KeptState {
    distribution: DistributionState,
    history: History,
    population: usize,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct DistributionState {
    mean: Vec<f64>,
    step_size: f64,
    /// Row by row, each from its diagonal on; of a separable one the diagonal.
    covariance: Vec<f64>,
    step_size_path: Vec<f64>,
    covariance_path: Vec<f64>,
    updates: u64,
}

impl From<CmaEs> for State {
    fn from(strategy: CmaEs) -> Self {
        let asked = if strategy.asked { strategy.population } else { Vec::new() };
        Self {
            settings: strategy.settings,
            topology: strategy.topology,
            start: strategy.start,
            is_guess: strategy.is_guess,
            restarts: strategy.restarts,
            history: strategy.history,
            kept: strategy.kept.map(|kept| KeptState {
                distribution: kept.distribution.into(),
                history: kept.history,
                population: kept.population,
            }),
            distribution: strategy.distribution.map(DistributionState::from),
            asked: asked.iter().map(|individual| individual.weights().to_vec()).collect(),
        }
    }
}

impl From<Distribution> for DistributionState {
    fn from(distribution: Distribution) -> Self {
        let covariance = match distribution.covariance {
            Covariance::Full { matrix, .. } => matrix.elements().to_vec(),
            Covariance::Separable { variances } => variances,
        };
        Self {
            mean: distribution.mean,
            step_size: distribution.step_size,
            covariance,
            step_size_path: distribution.step_size_path,
            covariance_path: distribution.covariance_path,
            updates: distribution.updates,
        }
    }
}

impl TryFrom<State> for CmaEs {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        if let Some(start) = state.start {
            strategy = strategy.with_start(&[start])?;
            strategy.is_guess = state.is_guess;
        }
        state.restarts.check().map_err(|error| error.within("restarts"))?;
        strategy.restarts = state.restarts;
        strategy.history = state.history;
        let (model, n) = (strategy.settings.covariance, strategy.topology.weight_count());
        if let Some(kept) = state.kept {
            let distribution = kept.distribution.check(model, n).map_err(|error| error.within("kept.distribution"))?;
            if !(2..=CmaEsSettings::MAX_POPULATION).contains(&kept.population) {
                return Err(SettingError::new("kept.population", kept.population, "from 2 to 1000000").into());
            }
            strategy.kept = Some(Kept { distribution, history: kept.history, population: kept.population });
        }
        if let Some(distribution) = state.distribution {
            let checked = distribution.check(model, n).map_err(|error| error.within("distribution"))?;
            strategy.distribution = Some(checked);
        }
        strategy.population = generation("asked", state.asked, strategy.restarts.population, &strategy.topology)?;
        strategy.asked = !strategy.population.is_empty();
        if strategy.asked && strategy.distribution.is_none() {
            return Err(SettingError::new("distribution", "none", "there when individuals were asked").into());
        }
        Ok(strategy)
    }
}

impl DistributionState {
    fn check(self, model: CovarianceModel, n: usize) -> Result<Distribution, SettingError> {
        check_numbers("mean", &self.mean, n)?;
        check_numbers("step_size_path", &self.step_size_path, n)?;
        check_numbers("covariance_path", &self.covariance_path, n)?;
        if !(self.step_size > 0.0 && self.step_size.is_finite()) {
            return Err(SettingError::new("step_size", self.step_size, "above 0"));
        }
        let count = match model {
            CovarianceModel::Full => Triangle::element_count(n),
            CovarianceModel::Separable => n,
        };
        check_numbers("covariance", &self.covariance, count)?;
        let covariance = match model {
            CovarianceModel::Full => Covariance::full(Triangle::new(n, self.covariance)),
            CovarianceModel::Separable => Covariance::Separable { variances: self.covariance },
        };
        if covariance.is_degenerate() {
            return Err(SettingError::new("covariance", "a degenerate matrix", "positive definite"));
        }
        Ok(Distribution {
            mean: self.mean,
            step_size: self.step_size,
            covariance,
            step_size_path: self.step_size_path,
            covariance_path: self.covariance_path,
            updates: self.updates,
        })
    }
}
