use crate::{
    quantile::{quantile_of_sorted, sorted},
    sample::{SampleError, check_samples},
    vargha_delaney::superiority,
};
use serde::{Deserialize, Serialize};

/// Up to so many values in both samples the p value is exact: C(50, 25) is counted without rounding, as f64 is exact to
/// 2⁵³.
const LARGEST_EXACT: usize = 50;

/// The result of [`rank_sum`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RankSumTest {
    /// U of x: in how many of all pairs the value of x is larger, ties counting half.
    pub u: f64,
    /// The two-sided p value: how likely a U at least as far from its mean is if x and y do not differ.
    pub p: f64,
    /// Whether `p` is exact (at most 50 values) or a normal approximation.
    pub exact: bool,
    /// The effect size, from −1 (every x below every y) to 1: the rank-biserial correlation, 2 A₁₂ − 1.
    pub rank_biserial: f64,
}

/// The rank-sum test of independent samples, two-sided (Wilcoxon, *Individual Comparisons by Ranking Methods*, Biometrics
/// Bulletin 1, 1945; Mann & Whitney, *On a Test of Whether one of Two Random Variables is Stochastically Larger than the
/// Other*, Annals of Mathematical Statistics 18, 1947).
///
/// - With at most 50 values p is exact, ties or not: twice the smaller tail (at most 1) of the distribution of the rank
///   sum over all ways to deal the ranks at hand to the two samples.
/// - With more it is the normal approximation with corrections for ties and continuity.
///
/// Samples of three cannot give p < 0.05, samples of four can (2/70).
///
/// # Errors
/// [`SampleError`] if a sample is empty or has a value that is not finite or too large.
///
/// ```
/// let (x, y) = ([8.0, 7.5, 9.0, 8.5], [6.0, 7.0, 6.5, 5.5, 7.25]);
/// let test = ne_statistics::rank_sum(&x, &y)?;
/// assert_eq!((test.u, test.p, test.rank_biserial), (20.0, 2.0 / 126.0, 1.0));
/// # Ok::<(), ne_statistics::SampleError>(())
/// ```
pub fn rank_sum(x: &[f64], y: &[f64]) -> Result<RankSumTest, SampleError> {
    check_samples(x, y)?;
    let superiority = superiority(x, y);
    let u = superiority * (x.len() * y.len()) as f64;
    let ranks = doubled_ranks(&sorted(&[x, y].concat()));
    let exact = ranks.len() <= LARGEST_EXACT;
    // U is the rank sum less the least that it can be.
    let doubled_sum = (2.0 * u).round() as usize + x.len() * (x.len() + 1);
    let p = if exact { exact_p(&ranks, x.len(), doubled_sum) } else { approximate_p(&ranks, u, x.len(), y.len()) };
    Ok(RankSumTest { u, p, exact, rank_biserial: 2.0 * superiority - 1.0 })
}

/// The Hodges–Lehmann estimate of the shift between independent samples (Hodges & Lehmann, *Estimates of Location Based on
/// Rank Tests*, Annals of Mathematical Statistics 34, 1963): the median of all differences of a value of `x` and one of `y`.
///
/// It belongs to the [rank-sum test](rank_sum), as [`hodges_lehmann`](crate::hodges_lehmann) to that of pairs.
///
/// # Errors
/// [`SampleError`] if a sample is empty or has a value that is not finite or too large.
pub fn shift_between(x: &[f64], y: &[f64]) -> Result<f64, SampleError> {
    check_samples(x, y)?;
    let differences: Vec<f64> = x.iter().flat_map(|one| y.iter().map(move |other| one - other)).collect();
    Ok(quantile_of_sorted(&sorted(&differences), 0.5))
}

/// Twice the rank of each of sorted values, so that the mean of tied ranks is a whole number.
pub(crate) fn doubled_ranks(values: &[f64]) -> Vec<usize> {
    let mut ranks = Vec::with_capacity(values.len());
    for tied in values.chunk_by(|one, other| one == other) {
        let lower = ranks.len();
        ranks.resize(lower + tied.len(), 2 * lower + 1 + tied.len());
    }
    ranks
}

/// Twice the smaller tail at `sum` when `count` of `ranks` are dealt to the first sample; at most 1.
fn exact_p(ranks: &[usize], count: usize, sum: usize) -> f64 {
    let total: usize = ranks.iter().sum();
    // How many ways there are to choose so many ranks with each sum.
    let mut ways = vec![vec![0.0_f64; total + 1]; count + 1];
    ways[0][0] = 1.0;
    for &rank in ranks {
        for chosen in (1..=count).rev() {
            let (fewer, more) = ways.split_at_mut(chosen);
            for sum in rank..=total {
                more[0][sum] += fewer[chosen - 1][sum - rank];
            }
        }
    }
    let ways = &ways[count];
    let (below, above): (f64, f64) = (ways[..=sum].iter().sum(), ways[sum..].iter().sum());
    (2.0 * below.min(above) / ways.iter().sum::<f64>()).min(1.0)
}

/// The two-sided p value of U from the normal distribution, with its variance under ties and a continuity correction of ½
/// (Hollander, Wolfe & Chicken, *Nonparametric Statistical Methods*, 3rd edition, 2014, section 4.1).
fn approximate_p(ranks: &[usize], u: f64, x: usize, y: usize) -> f64 {
    let (x, y) = (x as f64, y as f64);
    let all = x + y;
    let tied = |group: &[usize]| {
        let count = group.len() as f64;
        count * count * count - count
    };
    let ties: f64 = ranks.chunk_by(|one, other| one == other).map(tied).sum();
    let variance = x * y / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
    if variance <= 0.0 {
        return 1.0;
    }
    let deviation = ((u - x * y / 2.0).abs() - 0.5).max(0.0) / variance.sqrt();
    libm::erfc(deviation / std::f64::consts::SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    fn numbers(values: &[i32]) -> Vec<f64> {
        values.iter().map(|&value| f64::from(value)).collect()
    }

    /// The critical values of U at 5 %, two-sided, in the tables of textbooks.
    #[test]
    fn critical_values_of_the_tables() {
        for (x, y, critical) in [(4, 4, 0), (5, 5, 2), (6, 6, 5), (8, 8, 13), (10, 10, 23), (12, 12, 37), (5, 8, 6)] {
            let p = |u: usize| {
                let ranks: Vec<usize> = (1..=x + y).map(|rank| 2 * rank).collect();
                exact_p(&ranks, x, 2 * u + x * (x + 1))
            };
            assert!(p(critical) <= 0.05 && p(critical + 1) > 0.05, "{x}, {y}: {}, {}", p(critical), p(critical + 1));
        }
    }

    /// By hand: of the 20 ways to deal the ranks 1, 2.5, 2.5, 4, 5, 6 one has a sum of 6 and two one of 7.5.
    #[test]
    fn ties_share_ranks() {
        let test = rank_sum(&[1.0, 2.0, 2.0], &[3.0, 4.0, 5.0]).expect("valid samples");
        assert_eq!((test.u, test.p, test.exact), (0.0, 0.1, true));
        let test = rank_sum(&[1.0, 2.0, 3.0], &[2.0, 4.0, 5.0]).expect("valid samples");
        assert_eq!((test.u, test.p), (1.5, 2.0 * 3.0 / 20.0));
        assert_eq!(rank_sum(&[2.0; 4], &[2.0; 5]).map(|test| (test.p, test.rank_biserial)), Ok((1.0, 0.0)));
        assert_eq!(rank_sum(&[2.0; 40], &[2.0; 50]).map(|test| test.p), Ok(1.0));
    }

    #[test]
    fn the_shift_is_the_median_of_all_differences() {
        // Differences 3, 1, 6, 4 and 8, 6.
        assert_eq!(shift_between(&[4.0, 7.0, 9.0], &[1.0, 3.0]), Ok(5.0));
    }

    #[test]
    fn the_approximation_meets_the_exact_value() {
        let ranks: Vec<usize> = (1..=50).map(|rank| 2 * rank).collect();
        for u in [150, 200, 220, 260, 300] {
            let exact = exact_p(&ranks, 25, 2 * u + 25 * 26);
            let approximate = approximate_p(&ranks, u as f64, 25, 25);
            assert!((exact - approximate).abs() < 0.003, "{u}: {exact}, {approximate}");
        }
    }

    #[test]
    fn errors_name_the_sample() {
        let error = rank_sum(&[1.0], &[]).expect_err("y is empty");
        assert_eq!(error.to_string(), "y is empty: it must have at least one value");
        assert!(shift_between(&[f64::NAN], &[1.0]).is_err());
    }

    proptest! {
        /// Against all ways to choose the first sample.
        #[test]
        fn exact_p_is_that_of_all_deals(x in vec(-4..5i32, 1..6), y in vec(-4..5i32, 1..6)) {
            let test = rank_sum(&numbers(&x), &numbers(&y)).expect("valid samples");
            let all = [x.clone(), y].concat();
            let u = |chosen: usize| -> f64 {
                let (mut first, mut second) = (Vec::new(), Vec::new());
                for (place, &value) in all.iter().enumerate() {
                    if chosen >> place & 1 == 1 { first.push(f64::from(value)) } else { second.push(f64::from(value)) }
                }
                superiority(&first, &second) * (first.len() * second.len()) as f64
            };
            let deals: Vec<f64> =
                (0..1_usize << all.len()).filter(|deal| deal.count_ones() as usize == x.len()).map(u).collect();
            let tail = |is_in: &dyn Fn(f64) -> bool| deals.iter().filter(|&&u| is_in(u)).count() as f64;
            let smaller = tail(&|u| u <= test.u + 1e-9).min(tail(&|u| u >= test.u - 1e-9));
            prop_assert!((test.p - (2.0 * smaller / deals.len() as f64).min(1.0)).abs() < 1e-12);
        }

        #[test]
        fn is_symmetric_and_sees_order_alone(x in vec(-50..50i32, 1..40), y in vec(-50..50i32, 1..40)) {
            let there = rank_sum(&numbers(&x), &numbers(&y)).expect("valid samples");
            let back = rank_sum(&numbers(&y), &numbers(&x)).expect("valid samples");
            prop_assert!(0.0 < there.p && there.p <= 1.0);
            prop_assert!((there.p - back.p).abs() < 1e-12);
            prop_assert!((there.rank_biserial + back.rank_biserial).abs() < 1e-12);
            let moved = |sample: &[i32]| -> Vec<f64> { sample.iter().map(|&value| f64::from(value).powi(3) + 7.0).collect() };
            prop_assert_eq!(rank_sum(&moved(&x), &moved(&y)).expect("valid samples"), there);
        }
    }
}
