use crate::{
    Scores,
    quantile::{quantile_of_sorted, sorted},
};

/// The mean of all scores: of all runs on all tasks.
///
/// One outlier can move it anywhere: report it beside a robust aggregate, not alone.
pub fn mean(scores: &Scores) -> f64 {
    mean_of(scores.values())
}

/// The median over the tasks of each task's mean over its runs: what Agarwal et al. 2021 (section 4.3) call *median*.
///
/// Scores of nearly half of the tasks could be zero without a change. With a single task it is that task's mean; the
/// median over runs is [`quantile`](crate::quantile)`(scores.values(), 0.5)`.
pub fn median_of_task_means(scores: &Scores) -> f64 {
    let means: Vec<f64> = scores.rows().map(mean_of).collect();
    quantile_of_sorted(&sorted(&means), 0.5)
}

/// The interquartile mean (Agarwal et al. 2021, section 4.3): the mean of the middle half of all scores, runs of all
/// tasks together.
///
/// Of *n* scores the ⌊n/4⌋ lowest and the ⌊n/4⌋ highest are left out and the others weigh the same, exactly as in the
/// authors' library, which takes the trimmed mean of SciPy (`scipy.stats.trim_mean` with 0.25). There are no fractional
/// weights: with fewer than four scores it is the mean.
///
/// As robust to outliers as a quartile, with less variance than the median: the aggregate to prefer.
pub fn interquartile_mean(scores: &Scores) -> f64 {
    let sorted = sorted(scores.values());
    let left_out = sorted.len() / 4;
    mean_of(&sorted[left_out..sorted.len() - left_out])
}

/// The optimality gap (Agarwal et al. 2021, section 4.3): by how much the scores fall short of `target` on average,
/// where a score above it counts as `target`. At least 0; smaller is better.
///
/// `target` is the score from which more is not worth more: 1 for scores normalised to a reference.
pub fn optimality_gap(scores: &Scores, target: f64) -> f64 {
    let gaps: Vec<f64> = scores.values().iter().map(|score| target - score.min(target)).collect();
    mean_of(&gaps)
}

/// The arithmetic mean of at least one value.
fn mean_of(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scores::testing::{any_scores, mapped, scores};
    use proptest::prelude::*;

    /// By hand, and the same as `scipy.stats.trim_mean(..., 0.25)`.
    #[test]
    fn interquartile_mean_leaves_out_whole_scores() {
        let twelve = scores(&[&[12.0, 1.0, 7.0, 6.0, 11.0, 10.0], &[4.0, 9.0, 2.0, 8.0, 3.0, 5.0]]);
        assert_eq!(interquartile_mean(&twelve), 6.5);
        assert_eq!(interquartile_mean(&scores(&[&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 70.0]])), 4.0);
        assert_eq!(interquartile_mean(&scores(&[&[1.0, 2.0, 300.0]])), 101.0);
        assert_eq!(interquartile_mean(&scores(&[&[1.0, 2.0, 4.0, 300.0]])), 3.0);
    }

    #[test]
    fn aggregates_of_a_small_table() {
        let table = scores(&[&[0.0, 2.0], &[5.0, 7.0], &[1.0, 3.0]]);
        assert_eq!(mean(&table), 3.0);
        assert_eq!(median_of_task_means(&table), 2.0);
        assert_eq!(optimality_gap(&table, 2.0), 0.5);
        assert_eq!(optimality_gap(&table, 0.0), 0.0);
    }

    #[test]
    fn of_the_largest_scores_are_finite() {
        let table = scores(&[&[1e300; 100]]);
        assert!([mean(&table), interquartile_mean(&table), median_of_task_means(&table)].iter().all(|x| x.is_finite()));
    }

    proptest! {
        #[test]
        fn move_and_stretch_with_the_scores(scores in any_scores(3, 5), shift in -9..9i32, scale in 1..9i32) {
            let (shift, scale) = (f64::from(shift), f64::from(scale));
            let moved = mapped(&scores, |score| shift + scale * score);
            for statistic in [mean, median_of_task_means, interquartile_mean] {
                prop_assert!((statistic(&moved) - (shift + scale * statistic(&scores))).abs() < 1e-9);
            }
            let gap = optimality_gap(&moved, shift + scale);
            prop_assert!((gap - scale * optimality_gap(&scores, 1.0)).abs() < 1e-9);
            prop_assert!(gap >= 0.0);
        }

        #[test]
        fn lie_within_the_scores_and_do_not_depend_on_order(scores in any_scores(4, 3)) {
            let reversed: Vec<Vec<f64>> = scores.rows().rev().map(|row| row.iter().rev().copied().collect()).collect();
            let reversed = Scores::new(&reversed).expect("valid scores");
            let all = sorted(scores.values());
            for statistic in [mean, median_of_task_means, interquartile_mean] {
                let value = statistic(&scores);
                prop_assert!(all[0] <= value && value <= all[all.len() - 1]);
                prop_assert_eq!(value, statistic(&reversed));
            }
        }
    }
}
