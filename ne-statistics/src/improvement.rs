use crate::{Comparison, vargha_delaney::superiority};

/// The probability that a run of x scores more than a run of y on a task drawn at random: P(X > Y), from 0 to 1
/// (Agarwal et al. 2021, section 4.3).
///
/// The mean over the tasks of the Mann–Whitney statistic U / (N · M), for N runs of x and M of y: the share of all N · M
/// pairs in which x scores more, ties counting half. Every run of a task is compared with every run, pairs or not.
///
/// It says how likely an improvement is, not how large. For its interval give it to
/// [`Bootstrap::comparison`](crate::Bootstrap::comparison).
pub fn probability_of_improvement(comparison: &Comparison) -> f64 {
    let (x, y) = (comparison.x(), comparison.y());
    x.rows().zip(y.rows()).map(|(x, y)| superiority(x, y)).sum::<f64>() / x.tasks() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Bootstrap, Scores,
        scores::testing::{any_scores, mapped, scores},
    };
    use ne_core::Seed;
    use proptest::prelude::*;

    fn of(x: Scores, y: Scores) -> f64 {
        probability_of_improvement(&Comparison::unpaired(x, y).expect("the same tasks"))
    }

    /// The first task as in the test of A12; on the second x always wins.
    #[test]
    fn is_the_mean_over_tasks() {
        let x = scores(&[&[3.1, 2.2, 4.7, 4.7, 5.0], &[9.0, 9.0, 9.0, 9.0, 9.0]]);
        let y = scores(&[&[2.2, 2.9, 4.7, 1.0], &[1.0, 2.0, 3.0, 4.0]]);
        assert_eq!(of(x, y), (0.775 + 1.0) / 2.0);
    }

    #[test]
    fn interval_lies_within_0_and_1() {
        let (x, y) = (scores(&[&[1.0, 2.0, 3.0, 4.0]]), scores(&[&[0.0, 2.5, 2.0, 3.5]]));
        let comparison = Comparison::paired(x, y).expect("the same shape");
        let interval = Bootstrap::default().comparison(&comparison, probability_of_improvement, Seed::of_run(1));
        assert_eq!(interval.estimate, 0.59375);
        assert!(0.0 <= interval.low && interval.low < 0.5 && 0.7 < interval.high && interval.high <= 1.0);
    }

    proptest! {
        #[test]
        fn is_antisymmetric(x in any_scores(3, 4), y in any_scores(3, 6)) {
            prop_assert!((of(x.clone(), y.clone()) + of(y, x) - 1.0).abs() < 1e-12);
        }

        #[test]
        fn of_a_method_with_itself_is_a_half(x in any_scores(3, 5)) {
            prop_assert_eq!(of(x.clone(), x), 0.5);
        }

        /// Only the order counts: any rising function of the scores leaves it as it is.
        #[test]
        fn depends_on_order_alone(x in any_scores(2, 4), y in any_scores(2, 4)) {
            let rising = |score: f64| score * score * score + 2.0 * score - 7.0;
            prop_assert_eq!(of(mapped(&x, rising), mapped(&y, rising)), of(x, y));
        }
    }
}
