use super::CovarianceModel;

/// The recombination weights and learning rates of a generation.
///
/// Source: Hansen, *The CMA Evolution Strategy: A Tutorial*, arXiv 1604.00772, table 1; equations by its numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parameters {
    /// wᵢ, best first: the positive ones sum to 1, the others are negative.
    pub(super) weights: Vec<f64>,
    /// μ, the number of positive weights.
    pub(super) parents: usize,
    /// μ_eff, how many parents of equal weight would average as much.
    pub(super) effective_parents: f64,
    /// c_σ
    pub(super) step_size_rate: f64,
    /// d_σ
    pub(super) step_size_damping: f64,
    /// c_c
    pub(super) path_rate: f64,
    /// c₁
    pub(super) rank_one_rate: f64,
    /// c_μ
    pub(super) rank_mu_rate: f64,
}

impl Parameters {
    /// λ, equation 48.
    pub(super) fn default_population(weights: usize) -> usize {
        4 + (3.0 * libm::log(weights as f64)) as usize
    }

    /// The parameters for `n` weights and a population of at least 2.
    pub(super) fn new(n: usize, population: usize, model: CovarianceModel) -> Self {
        let n = n as f64;
        // Equation 49.
        let middle = libm::log((population as f64 + 1.0) / 2.0);
        let mut weights: Vec<f64> = (1..=population).map(|rank| middle - libm::log(rank as f64)).collect();
        let parents = population / 2;
        let (positive, negative) = weights.split_at(parents);
        let effective = |weights: &[f64]| {
            let (sum, squares) =
                (weights.iter().sum::<f64>(), weights.iter().map(|weight| weight * weight).sum::<f64>());
            sum * sum / squares
        };
        let (effective_parents, effective_others) = (effective(positive), effective(negative));

        // Equations 57 and 58, with α_cov = 2.
        let mut rank_one_rate = 2.0 / ((n + 1.3) * (n + 1.3) + effective_parents);
        let information = 0.25 + effective_parents + 1.0 / effective_parents - 2.0;
        let mut rank_mu_rate = 2.0 * information / ((n + 2.0) * (n + 2.0) + effective_parents);
        if model == CovarianceModel::Separable {
            // Fewer numbers are to be learned: Ros & Hansen 2008, section 3.
            let faster = (n + 2.0) / 3.0;
            (rank_one_rate, rank_mu_rate) = ((faster * rank_one_rate).min(1.0), faster * rank_mu_rate);
        }
        let rank_mu_rate = rank_mu_rate.min(1.0 - rank_one_rate);

        // Equations 50 to 53. Without a rank-μ update, the negative weights have no effect.
        let negative_sum = (1.0 + rank_one_rate / rank_mu_rate)
            .min(1.0 + 2.0 * effective_others / (effective_parents + 2.0))
            .min((1.0 - rank_one_rate - rank_mu_rate) / (n * rank_mu_rate))
            .max(0.0);
        let sums = (positive.iter().sum::<f64>(), -negative.iter().sum::<f64>());
        let (positive, negative) = weights.split_at_mut(parents);
        positive.iter_mut().for_each(|weight| *weight /= sums.0);
        negative.iter_mut().for_each(|weight| *weight *= negative_sum / sums.1);

        // Equations 55 and 56.
        let step_size_rate = (effective_parents + 2.0) / (n + effective_parents + 5.0);
        let excess = ((effective_parents - 1.0) / (n + 1.0)).sqrt() - 1.0;
        Self {
            weights,
            parents,
            effective_parents,
            step_size_rate,
            step_size_damping: 1.0 + 2.0 * excess.max(0.0) + step_size_rate,
            path_rate: (4.0 + effective_parents / n) / (n + 4.0 + 2.0 * effective_parents / n),
            rank_one_rate,
            rank_mu_rate,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn are_those_of_the_table() {
        let parameters = Parameters::new(10, 10, CovarianceModel::Full);
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-4, "{found}, expected {expected}");
        // ln 5.5 − ln i for i from 1 to 5, over their sum.
        let expected = [0.4563, 0.2707, 0.1622, 0.0852, 0.0255];
        parameters.weights.iter().zip(expected).for_each(|(&weight, expected)| near(weight, expected));
        near(parameters.effective_parents, 3.1673);
        near(parameters.step_size_rate, 5.1673 / 18.1673);
        near(parameters.step_size_damping, 1.0 + 5.1673 / 18.1673);
        near(parameters.path_rate, 4.31673 / 14.63346);
        near(parameters.rank_one_rate, 2.0 / (11.3 * 11.3 + 3.1673));
        near(parameters.rank_mu_rate, 2.0 * (3.1673 - 1.75 + 1.0 / 3.1673) / (144.0 + 3.1673));
        // The negative weights sum to the least of three bounds: here 1 + c₁ / c_μ.
        let negative: f64 = parameters.weights[5..].iter().sum();
        near(negative, -(1.0 + parameters.rank_one_rate / parameters.rank_mu_rate));
    }

    #[test]
    fn rates_are_shares_for_all_sizes() {
        for model in [CovarianceModel::Full, CovarianceModel::Separable] {
            for n in [1, 2, 3, 10, 200, 5000] {
                for population in [2, 3, 5, 20, 3000] {
                    let parameters = Parameters::new(n, population, model);
                    let Parameters { rank_one_rate, rank_mu_rate, .. } = parameters;
                    assert!(rank_one_rate > 0.0 && rank_mu_rate >= 0.0 && rank_one_rate + rank_mu_rate <= 1.0 + 1e-12);
                    assert!((parameters.weights[..population / 2].iter().sum::<f64>() - 1.0).abs() < 1e-9);
                    let negative = -parameters.weights[population / 2..].iter().sum::<f64>();
                    // What may be lost along one axis is less than what is kept of it.
                    assert!(n as f64 * rank_mu_rate * negative <= 1.0 - rank_one_rate - rank_mu_rate + 1e-9);
                    assert!(parameters.weights.iter().all(|weight| weight.is_finite()));
                }
            }
        }
    }
}
