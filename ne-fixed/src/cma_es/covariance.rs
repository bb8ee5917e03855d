use super::triangle::Triangle;
use ne_net::TopologyMap;
use serde::{Deserialize, Serialize};

/// Which covariance matrices [`CmaEs`](crate::CmaEs) adapts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum CovarianceModel {
    /// Every symmetric matrix: weights that must change together do. It has n²/2 numbers for n weights, and takes of the
    /// order of n² evaluations to learn them. Memory and time of a sample grow with the square of n, time of a generation
    /// with its third power: fit for up to a thousand weights. For nets of few weights, and for long searches.
    Full,
    /// Diagonal matrices: each weight has a deviation of its own, and no weight knows of another. Linear in memory and
    /// time, and learnt by the factor n faster. The default: searches for the weights of a body are over before a full
    /// matrix is learnt. With a net 6-8-1 for two poles, a separable one needed 1,050 evaluations and a full one 1,640
    /// (means of 12 seeds).
    ///
    /// Source: Ros & Hansen, *A Simple Modification in CMA-ES Achieving Linear Time and Space Complexity*, PPSN 2008.
    #[default]
    Separable,
}

/// A covariance matrix C, and of a full one the triangle U with C = UᵀU.
///
/// Uᵀ stands where the tutorial has the symmetric root C^½ from an eigendecomposition: Uᵀz is distributed as C^½z is,
/// and ‖U⁻ᵀy‖ = ‖C^-½y‖. It costs so much less that it is made anew in every generation, and it needs only sums,
/// products, quotients and square roots, which are the same everywhere. The path of the step size alone differs, by rotations that hardly change
/// from one generation to the next.
///
/// Source: Krause, Arbonès & Igel, *CMA-ES with Optimal Covariance Update and Storage Complexity*, NIPS 2016.
#[derive(Clone, Debug)]
pub(super) enum Covariance {
    Full { matrix: Triangle, factor: Triangle },
    Separable { variances: Vec<f64> },
}

/// With a larger condition number, sums of doubles say nothing of the small axes.
const GREATEST_CONDITION: f64 = 1e14;

impl Covariance {
    /// `variance` times the identity.
    pub(super) fn identity(model: CovarianceModel, size: usize, variance: f64) -> Self {
        match model {
            CovarianceModel::Full => Self::full(Triangle::diagonal(size, variance)),
            CovarianceModel::Separable => Self::Separable { variances: vec![variance; size] },
        }
    }

    /// The full covariance with this matrix.
    pub(super) fn full(matrix: Triangle) -> Self {
        let mut covariance = Self::Full { factor: matrix.clone(), matrix };
        covariance.factorize();
        covariance
    }

    /// The covariance of the weights of a grown net; new ones have this variance and vary with no other. Into a separable
    /// one go the variances alone.
    pub(super) fn remapped(&self, growth: &TopologyMap, model: CovarianceModel, variance: f64) -> Self {
        match (model, self) {
            (CovarianceModel::Separable, _) => {
                Self::Separable { variances: growth.transfer(&self.variances(), variance) }
            }
            (CovarianceModel::Full, Self::Separable { variances }) => {
                Self::full(Triangle::of(growth.weight_count(), &growth.transfer(variances, variance), |_, _| 0.0))
            }
            (CovarianceModel::Full, Self::Full { matrix, .. }) => {
                let origins = growth.origins();
                let element = |row: usize, column: usize| match (origins[row], origins[column]) {
                    (Some(row), Some(column)) => matrix.element(row, column),
                    _ => 0.0,
                };
                let diagonal = growth.transfer(&self.variances(), variance);
                Self::full(Triangle::of(growth.weight_count(), &diagonal, element))
            }
        }
    }

    fn factorize(&mut self) {
        if let Self::Full { matrix, factor } = self {
            let largest = matrix.diagonal_elements().fold(0.0, f64::max);
            matrix.factorize(largest * (0.1 / GREATEST_CONDITION), factor);
        }
    }

    /// Each vector z becomes one with the covariance C, if its elements are independent and have variance 1.
    pub(super) fn colour(&self, vectors: &mut [Vec<f64>]) {
        match self {
            Self::Full { factor, .. } => factor.multiply_transposed(vectors),
            Self::Separable { variances } => {
                let deviations: Vec<f64> = variances.iter().map(|variance| variance.sqrt()).collect();
                for vector in vectors {
                    vector.iter_mut().zip(&deviations).for_each(|(element, deviation)| *element *= deviation);
                }
            }
        }
    }

    /// Undoes [`colour`](Self::colour).
    pub(super) fn whiten(&self, vectors: &mut [Vec<f64>]) {
        match self {
            Self::Full { factor, .. } => factor.solve_transposed(vectors),
            Self::Separable { variances } => {
                let deviations: Vec<f64> = variances.iter().map(|variance| variance.sqrt()).collect();
                for vector in vectors {
                    vector.iter_mut().zip(&deviations).for_each(|(element, deviation)| *element /= deviation);
                }
            }
        }
    }

    /// C ← factor · C + Σ weightᵢ · vectorᵢ vectorᵢᵀ, of which a separable one keeps the diagonal.
    pub(super) fn update(&mut self, factor: f64, vectors: &[(f64, &[f64])]) {
        match self {
            Self::Full { matrix, .. } => matrix.add_squares(factor, vectors),
            Self::Separable { variances } => {
                variances.iter_mut().for_each(|variance| *variance *= factor);
                for (weight, vector) in vectors {
                    variances.iter_mut().zip(*vector).for_each(|(variance, y)| *variance += weight * y * y);
                }
            }
        }
        self.factorize();
    }

    /// The variance of each weight: the diagonal of C.
    fn variances(&self) -> Vec<f64> {
        match self {
            Self::Full { matrix, .. } => matrix.diagonal_elements().collect(),
            Self::Separable { variances } => variances.clone(),
        }
    }

    /// The mean variance of a weight.
    pub(super) fn mean_variance(&self) -> f64 {
        let variances = self.variances();
        variances.iter().sum::<f64>() / variances.len() as f64
    }

    /// The greatest deviation of a weight.
    pub(super) fn greatest_deviation(&self) -> f64 {
        self.variances().into_iter().fold(0.0, f64::max).sqrt()
    }

    /// The greatest deviation of a weight that goes on; `None` if none does.
    pub(super) fn greatest_deviation_kept(&self, growth: &TopologyMap) -> Option<f64> {
        let variances = self.variances();
        growth.origins().iter().flatten().map(|&old| variances[old]).reduce(f64::max).map(f64::sqrt)
    }

    /// The condition number of C; of a full one a lower bound, since its eigenvalues are not known: the greatest
    /// eigenvalue is at least as great as any element of the diagonal, the least at most as great as any pivot.
    pub(super) fn condition(&self) -> f64 {
        let variances = self.variances();
        let greatest = variances.iter().copied().fold(0.0, f64::max);
        let least = match self {
            Self::Full { factor, .. } => factor.diagonal_elements().map(|root| root * root).fold(greatest, f64::min),
            Self::Separable { .. } => variances.into_iter().fold(greatest, f64::min),
        };
        greatest / least
    }

    /// Whether C has lost its small axes to rounding.
    pub(super) fn is_degenerate(&self) -> bool {
        let condition = self.condition();
        // A negation, so that NaN counts.
        !(condition <= GREATEST_CONDITION && condition > 0.0)
    }
}
