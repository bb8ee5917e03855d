use crate::{
    rank_sum::doubled_ranks,
    sample::{SampleError, paired_differences},
};
use serde::{Deserialize, Serialize};

/// Up to so many pairs the p value is exact. The 2⁵⁰ signings are counted without rounding, as f64 is exact to 2⁵³.
const LARGEST_EXACT: usize = 50;

/// The result of [`wilcoxon_signed_rank`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WilcoxonTest {
    /// W⁺: the sum of the ranks of the pairs with x above y.
    pub rank_sum_above: f64,
    /// W⁻: the sum of the ranks of the pairs with x below y.
    pub rank_sum_below: f64,
    /// How many pairs were ranked: those whose difference is not zero.
    pub pairs: usize,
    /// The two-sided p value: how likely rank sums at least as unequal are if x and y do not differ.
    pub p: f64,
    /// Whether `p` is exact (at most 50 pairs ranked) or a normal approximation.
    pub exact: bool,
    /// The effect size, from -1 (every x below its y) to 1: the matched-pairs rank-biserial correlation
    /// (W⁺ − W⁻) / (W⁺ + W⁻) (Kerby, *The Simple Difference Formula*, Comprehensive Psychology 3, 2014). 0 if no pair
    /// was ranked.
    pub rank_biserial: f64,
}

/// The Wilcoxon signed-rank test of paired samples, two-sided (Wilcoxon, *Individual Comparisons by Ranking Methods*,
/// Biometrics Bulletin 1, 1945).
///
/// The pairs' differences x − y are ranked by size; ties get the mean of their ranks. Zero differences are left out
/// (Wilcoxon's way, not Pratt's). Under the null hypothesis, that differences are symmetric about 0, each rank is as
/// likely above as below.
///
/// - With at most 50 ranked pairs p is exact, ties or not: twice the smaller tail (at most 1) of the distribution of W⁺
///   over all signs of the ranks at hand.
/// - With more it is the normal approximation with corrections for ties and continuity.
///
/// If no pair was ranked p is 1. Fewer than six pairs cannot give p < 0.05. Ties are found by comparing differences
/// exactly: round the samples first if they are coarser than the rounding errors of a subtraction.
///
/// # Errors
/// [`SampleError`] if the samples are empty or differ in length, or have a value that is not finite or too large.
///
/// ```
/// let (x, y) = ([8.0, 7.5, 9.0, 8.5, 7.0, 9.5], [6.0, 7.0, 6.0, 7.5, 5.5, 6.5]);
/// let test = ne_statistics::wilcoxon_signed_rank(&x, &y)?;
/// assert_eq!((test.pairs, test.p, test.rank_biserial), (6, 0.03125, 1.0));
/// # Ok::<(), ne_statistics::SampleError>(())
/// ```
pub fn wilcoxon_signed_rank(x: &[f64], y: &[f64]) -> Result<WilcoxonTest, SampleError> {
    let mut differences = paired_differences(x, y)?;
    differences.retain(|&difference| difference != 0.0);
    differences.sort_by(|one, other| one.abs().total_cmp(&other.abs()));
    let sizes: Vec<f64> = differences.iter().map(|difference| difference.abs()).collect();
    let ranks = doubled_ranks(&sizes);
    let total: usize = ranks.iter().sum();
    let signed = ranks.iter().zip(&differences);
    let above: usize = signed.filter(|(_, difference)| **difference > 0.0).map(|(rank, _)| rank).sum();
    let below = total - above;
    let exact = differences.len() <= LARGEST_EXACT;
    Ok(WilcoxonTest {
        rank_sum_above: above as f64 / 2.0,
        rank_sum_below: below as f64 / 2.0,
        pairs: differences.len(),
        p: if exact { exact_p(&ranks, above.min(below)) } else { approximate_p(&ranks, above) },
        exact,
        rank_biserial: if total == 0 { 0.0 } else { (above as f64 - below as f64) / total as f64 },
    })
}

/// Twice the probability of a sum of at most `smaller` when each of `ranks` counts with probability ½; at most 1.
///
/// The distribution is symmetric, so the other tail is as large.
fn exact_p(ranks: &[usize], smaller: usize) -> f64 {
    // How many of the signings so far have each sum, adding rank by rank; sums above `smaller` are not needed.
    let mut signings = vec![0_u64; smaller + 1];
    signings[0] = 1;
    for &rank in ranks {
        for sum in (rank..=smaller).rev() {
            signings[sum] += signings[sum - rank];
        }
    }
    let tail: u64 = signings.iter().sum();
    let all = 1_u64 << ranks.len();
    (2.0 * tail as f64 / all as f64).min(1.0)
}

/// The two-sided p value of W⁺ from the normal distribution, with its variance under ties and a continuity correction
/// of ½ (Hollander, Wolfe & Chicken, *Nonparametric Statistical Methods*, 3rd edition, 2014, section 3.1).
fn approximate_p(ranks: &[usize], above: usize) -> f64 {
    let mean = ranks.iter().sum::<usize>() as f64 / 4.0;
    // The variance of a sum of independent signs: the sum of the squared ranks, a quarter of each. Ties are in it.
    let variance = ranks.iter().map(|&rank| (rank as f64 / 2.0) * (rank as f64 / 2.0)).sum::<f64>() / 4.0;
    let deviation = ((above as f64 / 2.0 - mean).abs() - 0.5).max(0.0) / variance.sqrt();
    libm::erfc(deviation / std::f64::consts::SQRT_2)
}

/// Samples from textbooks.
#[cfg(test)]
pub(crate) mod testing {
    /// Darwin's maize (Fisher, *The Design of Experiments*, 1935): cross- minus self-fertilised heights, in ⅛ inch.
    pub(crate) const DARWIN: [f64; 15] =
        [49.0, -67.0, 8.0, 16.0, 6.0, 23.0, 28.0, 41.0, 14.0, 29.0, 56.0, 24.0, 75.0, 60.0, -48.0];

    /// Hamilton depression scores before and after a treatment (Hollander & Wolfe 1973, p. 29).
    #[expect(clippy::approx_constant, reason = "a score of 3.14, not a circle")]
    pub(crate) const DEPRESSION: ([f64; 9], [f64; 9]) = (
        [1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30],
        [0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29],
    );
}

#[cfg(test)]
mod tests {
    use super::{testing::*, *};
    use proptest::{collection::vec, prelude::*};

    /// The test of differences, given as whole numbers.
    fn of(differences: &[i32]) -> WilcoxonTest {
        let x: Vec<f64> = differences.iter().map(|&difference| f64::from(difference)).collect();
        wilcoxon_signed_rank(&x, &vec![0.0; x.len()]).expect("valid samples")
    }

    /// p of ranks 1 to `pairs` by the exact distribution, when the smaller rank sum is `smaller`.
    fn p_without_ties(pairs: usize, smaller: usize) -> f64 {
        exact_p(&(1..=pairs).map(|rank| 2 * rank).collect::<Vec<_>>(), 2 * smaller)
    }

    #[test]
    fn textbook_examples() {
        let darwin = wilcoxon_signed_rank(&DARWIN, &[0.0; 15]).expect("valid samples");
        assert_eq!((darwin.rank_sum_above, darwin.rank_sum_below, darwin.pairs), (96.0, 24.0, 15));
        assert_eq!((darwin.p, darwin.exact, darwin.rank_biserial), (0.041259765625, true, 0.6));
        let text = serde_json::to_string(&darwin).expect("serialises");
        assert_eq!(serde_json::from_str::<WilcoxonTest>(&text).expect("deserialises"), darwin);
        let depression = wilcoxon_signed_rank(&DEPRESSION.0, &DEPRESSION.1).expect("valid samples");
        assert_eq!((depression.rank_sum_above, depression.rank_sum_below), (40.0, 5.0));
        assert_eq!(depression.p, 0.0390625);
    }

    /// The critical values of W at 5 %, two-sided, in the tables of textbooks.
    #[test]
    fn critical_values_of_the_tables() {
        for (pairs, critical) in [(6, 0), (7, 2), (8, 3), (9, 5), (10, 8), (15, 25), (20, 52), (25, 89), (30, 137)] {
            let (p, next) = (p_without_ties(pairs, critical), p_without_ties(pairs, critical + 1));
            assert!(p <= 0.05 && next > 0.05, "{pairs} pairs: {p}, {next}");
        }
        assert_eq!(p_without_ties(5, 0), 0.0625);
        assert_eq!((p_without_ties(10, 8), p_without_ties(10, 9)), (0.048828125, 0.064453125));
        // With SciPy's exact distribution.
        assert!((p_without_ties(50, 434) - 0.049_446_406_800_601_79).abs() < 1e-15);
    }

    /// Nine ranked pairs with ties; p by listing all 512 signings.
    #[test]
    fn ties_share_ranks_and_zeros_are_left_out() {
        let test = of(&[1, 1, -2, 3, 3, 3, -3, 4, 0, 5]);
        assert_eq!((test.rank_sum_above, test.rank_sum_below, test.pairs), (36.5, 8.5, 9));
        assert_eq!(test.p, 0.11328125);
    }

    /// With `scipy.stats.wilcoxon(..., correction=True, method="asymptotic")`.
    #[test]
    fn many_pairs_are_approximated() {
        let without_ties: Vec<i32> = (0..60).map(|index| (index * 37) % 61 - 22).collect();
        let test = of(&without_ties);
        assert_eq!((test.pairs, test.rank_sum_below, test.exact), (59, 474.5, false));
        assert!((test.p - 0.001_968_782_136_114_518).abs() < 1e-12, "{}", test.p);
        let with_ties: Vec<i32> = (0..70).map(|index| ((index * 37) % 61 - 22_i32).div_euclid(4)).collect();
        let test = of(&with_ties);
        assert_eq!((test.pairs, test.rank_sum_above, test.rank_sum_below), (66, 1511.5, 699.5));
        assert!((test.p - 0.009_449_843_167_867_1).abs() < 1e-12, "{}", test.p);
    }

    #[test]
    fn the_approximation_meets_the_exact_value() {
        let ranks: Vec<usize> = (1..=50).map(|rank| 2 * rank).collect();
        for smaller in [300, 434, 500, 600, 637] {
            let (exact, approximate) = (exact_p(&ranks, 2 * smaller), approximate_p(&ranks, 2 * smaller));
            assert!((exact - approximate).abs() < 0.003, "{smaller}: {exact}, {approximate}");
        }
    }

    #[test]
    fn without_differences_nothing_is_found() {
        let test = of(&[0, 0, 0]);
        assert_eq!((test.pairs, test.p, test.rank_biserial), (0, 1.0, 0.0));
    }

    #[test]
    fn errors_are_those_of_pairs() {
        let error = wilcoxon_signed_rank(&[1.0, f64::INFINITY], &[1.0, 2.0]).expect_err("infinite");
        assert_eq!(error.to_string(), "x[1] = inf: must be a finite number, at most 1e300 in size");
    }

    proptest! {
        #[test]
        fn exact_p_is_that_of_all_signings(differences in vec(-6..7i32, 1..11)) {
            let test = of(&differences);
            let mut sizes: Vec<f64> = differences.iter().filter(|&&d| d != 0).map(|&d| f64::from(d.abs())).collect();
            sizes.sort_by(f64::total_cmp);
            let ranks = doubled_ranks(&sizes);
            let smaller = test.rank_sum_above.min(test.rank_sum_below) * 2.0;
            let sum = |signing: usize| -> usize {
                ranks.iter().enumerate().filter(|(bit, _)| signing >> bit & 1 == 1).map(|(_, rank)| rank).sum()
            };
            let all = 1_usize << ranks.len();
            let tail = (0..all).filter(|&signing| sum(signing) as f64 <= smaller).count();
            prop_assert_eq!(test.p, (2.0 * tail as f64 / all as f64).min(1.0));
        }

        #[test]
        fn is_symmetric_and_sees_order_and_scale_of_differences_alone(differences in vec(-90..91i32, 1..80)) {
            let test = of(&differences);
            prop_assert!(0.0 < test.p && test.p <= 1.0);
            prop_assert!((-1.0..=1.0).contains(&test.rank_biserial));
            let pairs = test.pairs as f64;
            prop_assert_eq!(test.rank_sum_above + test.rank_sum_below, pairs * (pairs + 1.0) / 2.0);
            let mirrored = of(&differences.iter().map(|difference| -difference).collect::<Vec<_>>());
            prop_assert_eq!(mirrored.p, test.p);
            prop_assert_eq!(mirrored.rank_biserial, -test.rank_biserial);
            let reversed: Vec<i32> = differences.iter().rev().copied().collect();
            prop_assert_eq!(of(&reversed), test);
            prop_assert_eq!(of(&differences.iter().map(|difference| 3 * difference).collect::<Vec<_>>()), test);
        }

        #[test]
        fn a_shift_of_both_samples_does_not_count(pairs in vec((-50..50i32, -50..50i32), 1..30), shift in -50..50i32) {
            let samples = |shift| -> (Vec<f64>, Vec<f64>) {
                pairs.iter().map(|&(x, y)| (f64::from(x + shift), f64::from(y + shift))).unzip()
            };
            let ((x, y), (moved_x, moved_y)) = (samples(0), samples(shift));
            prop_assert_eq!(wilcoxon_signed_rank(&x, &y), wilcoxon_signed_rank(&moved_x, &moved_y));
        }
    }
}
