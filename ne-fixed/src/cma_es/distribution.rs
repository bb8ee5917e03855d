use super::{covariance::Covariance, covariance::CovarianceModel, parameters::Parameters};
use ne_net::TopologyMap;

/// The least square of a length that is divided by: n / this × the square of a weight's step stays a number.
const SHORTEST: f64 = 1e-250;

/// The normal distribution N(m, σ²C) that individuals are drawn from, and the paths it has taken.
///
/// Source: Hansen, *The CMA Evolution Strategy: A Tutorial*, arXiv 1604.00772, figure 6; equations by its numbers.
#[derive(Clone, Debug)]
pub(super) struct Distribution {
    /// m
    pub(super) mean: Vec<f64>,
    /// σ
    pub(super) step_size: f64,
    /// C
    pub(super) covariance: Covariance,
    /// p_σ
    pub(super) step_size_path: Vec<f64>,
    /// p_c
    pub(super) covariance_path: Vec<f64>,
    /// How often it was updated.
    pub(super) updates: u64,
}

impl Distribution {
    /// A distribution that has not moved.
    pub(super) fn new(mean: Vec<f64>, step_size: f64, covariance: Covariance) -> Self {
        let path = vec![0.0; mean.len()];
        Self { step_size, covariance, step_size_path: path.clone(), covariance_path: path, updates: 0, mean }
    }

    /// The distribution over the weights of a grown net; new ones have a mean of 0 and this deviation. The greatest of the others
    /// is kept within these limits.
    pub(super) fn remapped(
        mut self,
        growth: &TopologyMap,
        model: CovarianceModel,
        deviation: f64,
        limits: [f64; 2],
    ) -> Self {
        if let Some(greatest) = self.covariance.greatest_deviation_kept(growth) {
            self.limit(greatest, limits);
        }
        let relative = deviation / self.step_size;
        Self {
            mean: growth.transfer(&self.mean, 0.0),
            step_size: self.step_size,
            covariance: self.covariance.remapped(growth, model, relative * relative),
            step_size_path: growth.transfer(&self.step_size_path, 0.0),
            covariance_path: growth.transfer(&self.covariance_path, 0.0),
            updates: self.updates,
        }
    }

    /// Each z, drawn from N(0, I), becomes x = m + σy with y ~ N(0, C). Equations 38 to 40.
    pub(super) fn sample(&self, vectors: &mut [Vec<f64>]) {
        self.covariance.colour(vectors);
        for vector in vectors {
            vector.iter_mut().zip(&self.mean).for_each(|(y, mean)| *y = mean + self.step_size * *y);
        }
    }

    /// Moves towards the better individuals; `ranked` are their x, best first.
    pub(super) fn update(&mut self, mut ranked: Vec<Vec<f64>>, parameters: &Parameters) {
        let n = self.mean.len() as f64;
        let expected_length = n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
        let (step_size_rate, path_rate) = (parameters.step_size_rate, parameters.path_rate);
        for vector in &mut ranked {
            vector.iter_mut().zip(&self.mean).for_each(|(x, mean)| *x = (*x - mean) / self.step_size);
        }
        let steps = ranked;

        // Selection and recombination, equations 41 and 42, with a learning rate of 1.
        let mut step = vec![0.0; self.mean.len()];
        for (weight, y) in parameters.weights[..parameters.parents].iter().zip(&steps) {
            step.iter_mut().zip(y).for_each(|(step, y)| *step += weight * y);
        }
        self.mean.iter_mut().zip(&step).for_each(|(mean, step)| *mean += self.step_size * step);

        // Of the mean step and of those with negative weights, what they are before they are coloured.
        let mut white = vec![step.clone()];
        white.extend_from_slice(&steps[parameters.parents..]);
        self.covariance.whiten(&mut white);

        // Control of the step size, equations 43 and 44.
        let scale = (step_size_rate * (2.0 - step_size_rate) * parameters.effective_parents).sqrt();
        for (path, white) in self.step_size_path.iter_mut().zip(&white[0]) {
            *path = (1.0 - step_size_rate) * *path + scale * white;
        }
        self.updates += 1;
        let length = square(&self.step_size_path).sqrt();
        let surprise = step_size_rate / parameters.step_size_damping * (length / expected_length - 1.0);
        self.step_size *= libm::exp(surprise);

        // Adaptation of the covariance, equations 45 to 47. The path halts while the step size grows fast.
        let settled = (1.0 - libm::pow(1.0 - step_size_rate, 2.0 * self.updates as f64)).sqrt();
        let halts = length / settled >= (1.4 + 2.0 / (n + 1.0)) * expected_length;
        let scale = if halts { 0.0 } else { (path_rate * (2.0 - path_rate) * parameters.effective_parents).sqrt() };
        for (path, step) in self.covariance_path.iter_mut().zip(&step) {
            *path = (1.0 - path_rate) * *path + scale * step;
        }
        let (rank_one, rank_mu) = (parameters.rank_one_rate, parameters.rank_mu_rate);
        let lost = if halts { path_rate * (2.0 - path_rate) } else { 0.0 };
        let kept = 1.0 + rank_one * lost - rank_one - rank_mu * parameters.weights.iter().sum::<f64>();
        let mut terms = vec![(rank_one, self.covariance_path.as_slice())];
        for (rank, (&weight, y)) in parameters.weights.iter().zip(&steps).enumerate() {
            let bounded = match rank.checked_sub(parameters.parents) {
                // A negative weight must not count for more the longer the step is, lest C lose its positive axes.
                Some(other) => weight * n / square(&white[1 + other]).max(SHORTEST),
                None => weight,
            };
            terms.push((rank_mu * bounded, y));
        }
        self.covariance.update(kept, &terms);
    }

    /// The greatest deviation of a weight.
    pub(super) fn greatest_deviation(&self) -> f64 {
        self.step_size * self.covariance.greatest_deviation()
    }

    /// Draws the mean to 0, by this share of itself.
    pub(super) fn decay(&mut self, share: f64) {
        self.mean.iter_mut().for_each(|mean| *mean *= 1.0 - share);
    }

    /// Keeps the greatest deviation of a weight within these limits.
    pub(super) fn limit_deviation(&mut self, limits: [f64; 2]) {
        self.limit(self.covariance.greatest_deviation(), limits);
    }

    /// Changes the step size so that a deviation, in units of it, is within these limits.
    fn limit(&mut self, deviation: f64, [least, greatest]: [f64; 2]) {
        self.step_size = self.step_size.max(least / deviation).min(greatest / deviation);
    }

    /// The same without a direction that it prefers, if its covariance has lost its small axes.
    pub(super) fn unless_degenerate(self, model: CovarianceModel) -> Self {
        if !self.covariance.is_degenerate() {
            return self;
        }
        let variance = self.covariance.mean_variance().clamp(1e-100, 1e100);
        let covariance = Covariance::identity(model, self.mean.len(), variance);
        Self { updates: self.updates, ..Self::new(self.mean, self.step_size, covariance) }
    }
}

fn square(vector: &[f64]) -> f64 {
    vector.iter().map(|element| element * element).sum()
}
