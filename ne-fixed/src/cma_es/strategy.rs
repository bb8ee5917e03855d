use super::{
    CmaEsSettings, CovarianceModel, Restart,
    covariance::Covariance,
    distribution::Distribution,
    history::{History, equal_length},
    parameters::Parameters,
    restart::Restarts,
    state::State,
};
use crate::{
    WeightVector,
    genome::finite,
    nets::{check_growth, check_start},
    normal::Normal,
    ranking::best_first,
};
use ne_core::{Evaluation, Purpose, Seed, SettingError, Statistic, Strategy};
use ne_net::{Topology, TopologyMap};
use serde::{Deserialize, Serialize};

const MEAN: Purpose = Purpose::new("cma-es mean");
const SAMPLES: Purpose = Purpose::new("cma-es samples");
const RESTART: Purpose = Purpose::new("cma-es restart");

/// The evolution strategy with covariance matrix adaptation: draws weights from a normal distribution, and learns from
/// the better ones where its mean, its size and its shape should go.
///
/// A generation, once evaluated, changes in this order, with the weights of the better half positive and of the others
/// negative (active CMA):
/// 1. the mean: the weighted mean of the better half;
/// 2. the step size: it grows if successive steps of the mean agree, and shrinks if they cancel each other;
/// 3. the covariance: it grows along the path of the mean and the steps of the better half, and shrinks along those of
///    the others.
///
/// Only the order of the fitnesses counts. Failed evaluations rank below every fitness; of equals those with the lower
/// index are better. If all fail, nothing is learnt. If seven tenths are equally good, the step size grows.
///
/// Genes are rounded to `f32`, and what is learnt is learnt from the rounded ones. The mean itself is not evaluated.
/// If the covariance degenerates (its condition number passes 1e14) and there are no restarts, it begins anew
/// with its mean variance.
///
/// # Statistics
/// - `step_size`: σ;
/// - `greatest_deviation`: σ times the deviation of the weight that varies most, in units of the weights;
/// - `condition_number`: of the covariance matrix; of a full one a lower bound;
/// - `population`: of the next generation;
/// - `restarts`: how many there were, returns to the best search included;
/// - `evaluations_since_restart`.
///
/// Source: Hansen, *The CMA Evolution Strategy: A Tutorial*, arXiv 1604.00772. It differs in one place: where the tutorial
/// takes the root of the covariance from an eigendecomposition, now and then, this takes a Cholesky factor, anew in each
/// generation (Krause, Arbonès & Igel, *CMA-ES with Optimal Covariance Update and Storage Complexity*, NIPS 2016). The
/// samples have the same distribution, at a fraction of the cost.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "State", try_from = "State")]
pub struct CmaEs {
    pub(super) settings: CmaEsSettings,
    pub(super) topology: Topology,
    /// Where the first search begins, if the settings do not say it.
    pub(super) start: Option<Vec<f32>>,
    /// Whether it is but a guess.
    pub(super) is_guess: bool,
    pub(super) restarts: Restarts,
    pub(super) history: History,
    /// The best search that has ended, while others are tried.
    pub(super) kept: Option<Kept>,
    /// None before a search begins.
    pub(super) distribution: Option<Distribution>,
    /// The generation last asked. Once told, what stands here is memory to be used again.
    pub(super) population: Vec<WeightVector>,
    /// Whether `population` was asked and not told yet.
    pub(super) asked: bool,
}

/// A search that has ended and may go on.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub(super) distribution: Distribution,
    pub(super) history: History,
    pub(super) population: usize,
}

/// A search that goes on elsewhere begins with a greatest deviation of at least this share of the first step size: what
/// has settled on one task must be able to leave for the other.
const REVIVED: f64 = 0.3;

/// A search that is returned to begins with a greatest deviation of at most this many times the first step size: one that
/// had begun to diverge where it ended has nothing else to say.
const GREATEST_RETURN: f64 = 3.0;

impl CmaEs {
    /// The most weights a search with all covariances takes: time and memory of more are beyond reason.
    pub const MOST_WEIGHTS_OF_FULL: usize = 4096;

    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range, or there are more weights than
    /// [`MOST_WEIGHTS_OF_FULL`](Self::MOST_WEIGHTS_OF_FULL) for a full covariance.
    pub fn new(settings: CmaEsSettings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        let topology = topology.into();
        settings.validate()?;
        topology.validate().map_err(|error| error.within("topology"))?;
        let weights = topology.weight_count();
        if settings.covariance == CovarianceModel::Full && weights > Self::MOST_WEIGHTS_OF_FULL {
            let allowed = format!("separable for nets of more than {} weights", Self::MOST_WEIGHTS_OF_FULL);
            return Err(SettingError::new("covariance", format!("full for {weights} weights"), allowed));
        }
        let (population, most) =
            (Self::first_population(&settings, &topology), CmaEsSettings::most_individuals(weights));
        if population > most {
            let allowed = format!("at most {most} for nets of {weights} weights");
            return Err(SettingError::new("population", population, allowed));
        }
        Ok(Self {
            restarts: Restarts::new(population, settings.step_size),
            settings,
            topology,
            start: None,
            is_guess: false,
            history: History::default(),
            kept: None,
            distribution: None,
            population: Vec::new(),
            asked: false,
        })
    }

    /// The same search, beginning at these weights, those of the best net of several, with 0.3 of the first step size: a
    /// champion to be made better, or moved to another task. Restarts begin elsewhere. Without effect once a generation was asked.
    ///
    /// # Errors
    /// If they are not weights of this search's topology; the error names the net: `start[0]`.
    pub fn with_start(self, start: &[Vec<f32>]) -> Result<Self, SettingError> {
        check_start(start, &self.topology)?;
        let has_begun = self.asked || self.distribution.is_some() || self.kept.is_some() || self.restarts.count > 0;
        Ok(if has_begun { self } else { Self { start: start.first().cloned(), is_guess: false, ..self } })
    }

    /// As [`with_start`](Self::with_start), but with the whole of the first step size: weights that are likely to be near good ones, and
    /// are not good yet.
    ///
    /// # Errors
    /// As of [`with_start`](Self::with_start).
    pub fn with_guess(self, guess: &[f32]) -> Result<Self, SettingError> {
        Ok(Self { is_guess: true, ..self.with_start(&[guess.to_vec()])? })
    }

    /// Goes on with other settings, on another task, or with nets that have grown: with mean, step size, covariance and
    /// paths. A new weight has a mean of 0, the first step size as its deviation, and varies with no other. If no weight that
    /// goes on deviates by 0.3 of the first step size any more, the step size grows until one does. Restarts are counted anew, and
    /// begin elsewhere: at the mean that was carried they found less.
    ///
    /// # Errors
    /// If a setting is out of range, or the growth is not from this topology to that one.
    pub fn remapped(
        self,
        settings: CmaEsSettings,
        topology: impl Into<Topology>,
        growth: &TopologyMap,
    ) -> Result<Self, SettingError> {
        let next = Self::new(settings, topology)?;
        check_growth(growth, &self.topology, &next.topology)?;
        // A search that is elsewhere knows less than the one that it left; of several starts the best so far goes on.
        let (is_elsewhere, is_starting, level) =
            (self.restarts.is_elsewhere(), self.is_starting(), self.history.level());
        let is_better = |kept: &Kept| is_elsewhere || (is_starting && kept.history.level() >= level);
        let left = self.kept.filter(is_better).map(|kept| kept.distribution);
        let start = self.start.map(|start| growth.transfer(&start, 0.0));
        let (model, first) = (next.settings.covariance, next.settings.step_size);
        let limits = [REVIVED * first, next.settings.greatest_deviation()];
        let remapped = |old: Distribution| old.remapped(growth, model, first, limits).unless_degenerate(model);
        let distribution = left.or(self.distribution).map(remapped);
        let mut restarts = next.restarts.clone();
        if distribution.is_some() {
            // It has begun: there is nothing to choose from.
            restarts.starts = next.settings.starts;
            restarts.carried = true;
        }
        Ok(Self { start, is_guess: self.is_guess, restarts, distribution, ..next })
    }

    /// The settings.
    pub fn settings(&self) -> &CmaEsSettings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The mean of the distribution, in the order of the genes; none before the first generation and right after the
    /// end of a search that begins anew.
    pub fn mean(&self) -> Option<&[f64]> {
        self.distribution.as_ref().map(|distribution| distribution.mean.as_slice())
    }

    /// Whether a restart, or the next of several starts, has left what the first search had found.
    pub fn has_begun_anew(&self) -> bool {
        self.restarts.count > 0 || (self.is_starting() && self.restarts.starts > 0)
    }

    /// The population of the first search.
    pub(super) fn first_population(settings: &CmaEsSettings, topology: &Topology) -> usize {
        settings.population.unwrap_or_else(|| Parameters::default_population(topology.weight_count()))
    }

    /// The distribution a search begins with.
    fn first_distribution(&self, seed: Seed) -> Distribution {
        let mean = match &self.start {
            Some(start) if self.restarts.count == 0 => start.clone(),
            _ => {
                let mut individual = WeightVector::zero(self.topology.clone());
                self.settings.initial_mean.draw(&mut individual, &mut seed.stream(MEAN));
                individual.weights().to_vec()
            }
        };
        let covariance = Covariance::identity(self.settings.covariance, mean.len(), 1.0);
        // What is good already is not thrown away by the first generation.
        let is_good = self.start.is_some() && !self.is_guess && self.restarts.count == 0;
        let near = if is_good { REVIVED } else { 1.0 };
        Distribution::new(mean.into_iter().map(f64::from).collect(), near * self.restarts.step_size, covariance)
    }

    /// Whether the present search has nothing more to give.
    fn has_ended(&self, distribution: &Distribution) -> bool {
        let deviation = distribution.greatest_deviation();
        deviation <= self.settings.least_deviation
            || deviation >= CmaEsSettings::MOST_GROWTH * self.restarts.step_size
            || distribution.covariance.is_degenerate()
            || self.history.stagnates(self.topology.weight_count(), self.restarts.population)
            || self.restarts.failed_generations >= equal_length(self.topology.weight_count(), self.restarts.population)
            || self.restarts.is_over()
    }

    /// Whether, and how, a search that has ended begins anew.
    fn restart(&self) -> Restart {
        match self.settings.restart {
            Restart::Anew if self.start.is_some() || self.restarts.carried => Restart::None,
            Restart::Anew => Restart::Returning,
            restart => restart,
        }
    }

    /// Whether several starts are tried, and the one that goes on is not known yet.
    fn is_starting(&self) -> bool {
        self.start.is_none() && self.restarts.starts < self.settings.starts && self.settings.starts > 1
    }

    /// Remembers the present search, unless the one remembered had got farther.
    fn keep(&mut self, distribution: Distribution) {
        let history = std::mem::take(&mut self.history);
        if distribution.covariance.is_degenerate() {
            return;
        }
        if self.kept.as_ref().is_none_or(|kept| history.level() > kept.history.level()) {
            self.kept = Some(Kept { distribution, history, population: self.restarts.population });
        }
    }

    /// Ends one of several starts. After the last, the best goes on.
    fn end_start(&mut self, distribution: Distribution) {
        self.keep(distribution);
        self.restarts.starts += 1;
        self.restarts.failed_generations = 0;
        if self.is_starting() {
            self.restarts.evaluations = 0;
        } else if let Some(kept) = self.kept.take() {
            self.history = kept.history;
            self.distribution = Some(kept.distribution);
        }
    }

    /// Ends a search: the next begins anew, or where the best had ended.
    fn end_search(&mut self, distribution: Distribution, seed: Seed) {
        let returning = self.restart() == Restart::Returning;
        if returning {
            self.keep(distribution);
            // Where it goes on, its history begins anew.
            self.kept.iter_mut().for_each(|kept| kept.history.shorten());
        }
        let best = self.kept.as_ref().filter(|_| returning && self.restarts.is_elsewhere());
        if let Some(kept) = best {
            self.restarts.back(kept.population, self.settings.step_size);
            let mut distribution = kept.distribution.clone();
            let greatest = self.settings.greatest_growth.min(GREATEST_RETURN);
            distribution.limit_deviation([REVIVED, greatest].map(|growth| growth * self.settings.step_size));
            self.distribution = Some(distribution);
        } else {
            let first = Self::first_population(&self.settings, &self.topology);
            let weights = self.topology.weight_count();
            self.restarts.next(&self.settings, first, weights, &mut seed.stream(RESTART));
        }
        self.history = History::default();
    }

    /// Keeps a search alive that would have ended.
    fn revive(&self, distribution: Distribution) -> Distribution {
        let mut distribution = distribution.unless_degenerate(self.settings.covariance);
        distribution.limit_deviation([self.settings.least_deviation, self.settings.greatest_deviation()]);
        distribution
    }
}

impl Strategy for CmaEs {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "cma-es"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let distribution = self.distribution.take().unwrap_or_else(|| self.first_distribution(seed));
        let normal = Normal::new();
        let draw = |index: usize| {
            let mut stream = seed.individual(index as u64).stream(SAMPLES);
            (0..distribution.mean.len()).map(|_| f64::from(normal.next(&mut stream))).collect()
        };
        let mut samples: Vec<Vec<f64>> = (0..self.restarts.population).map(draw).collect();
        distribution.sample(&mut samples);
        self.population.resize_with(samples.len(), || WeightVector::zero(self.topology.clone()));
        for (individual, sample) in self.population.iter_mut().zip(&samples) {
            let (genes, _) = individual.genes_mut();
            genes.iter_mut().zip(sample).for_each(|(gene, &x)| *gene = finite(x));
        }
        self.distribution = Some(distribution);
        self.asked = true;
        &self.population
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.population.len());
        self.asked = false;
        self.restarts.evaluations += evaluations.len() as u64;
        let scores: Vec<_> = evaluations.iter().map(Evaluation::fitness).collect();
        let order = best_first(&scores);
        let Some(mut distribution) = self.distribution.take() else { return };
        if scores[order[0]].is_none() {
            self.restarts.failed_generations += 1;
        } else {
            self.restarts.failed_generations = 0;
            let ranked = order.iter().map(|&index| self.population[index].weights());
            let ranked = ranked.map(|genes| genes.iter().map(|&gene| gene.into()).collect()).collect();
            let n = self.topology.weight_count();
            let parameters = Parameters::new(n, order.len(), self.settings.covariance);
            distribution.update(ranked, &parameters);
            if scores[order[0]] == scores[order[(order.len() * 7).div_ceil(10) - 1]] {
                // Flat fitness, appendix B.3: the answer is farther away.
                distribution.step_size *= libm::exp(0.2 + parameters.step_size_rate / parameters.step_size_damping);
            }
            if self.settings.mean_decay > 0.0 {
                distribution.decay(self.settings.mean_decay);
            }
            if self.settings.greatest_growth < CmaEsSettings::MOST_GROWTH {
                distribution.limit_deviation([0.0, self.settings.greatest_deviation()]);
            }
            let ranked: Vec<_> = order.iter().map(|&index| scores[index]).collect();
            self.history.push(&ranked, n, distribution.updates);
            if self.restart() == Restart::None {
                // It is never asked whether this search stagnates.
                self.history.shorten();
            }
        }
        let share = self.settings.start_generations.saturating_mul(self.restarts.population as u64);
        if self.is_starting() && self.restarts.evaluations >= share {
            self.end_start(distribution);
        } else if self.restart() != Restart::None && !self.is_starting() && self.has_ended(&distribution) {
            self.end_search(distribution, seed);
        } else {
            self.distribution = Some(self.revive(distribution));
        }
    }

    fn recommendation(&self) -> Option<WeightVector> {
        self.mean().map(|mean| WeightVector::rounded(&self.topology, mean))
    }

    fn statistics(&self) -> Vec<Statistic> {
        let (step_size, deviation, condition) = self.distribution.as_ref().map_or(
            (self.restarts.step_size, self.restarts.step_size, 1.0),
            |distribution| {
                let condition = distribution.covariance.condition();
                (distribution.step_size, distribution.greatest_deviation(), condition)
            },
        );
        vec![
            Statistic::new("step_size", step_size),
            Statistic::new("greatest_deviation", deviation),
            Statistic::new("condition_number", condition),
            Statistic::new("population", self.restarts.population as f64),
            Statistic::new("restarts", self.restarts.count as f64),
            Statistic::new("evaluations_since_restart", self.restarts.evaluations as f64),
        ]
    }
}
