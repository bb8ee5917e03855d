use crate::{Comparison, quantile::sorted, rank_sum::doubled_ranks};
use ne_core::{Purpose, RandomStream, Seed};
use rand::RngExt;

const PERMUTATION: Purpose = Purpose::new("permutation test");

/// How often the runs are dealt anew: p is a multiple of 1 / 10,000.
const DEALS: u32 = 9_999;

/// Whether one of two methods scores more over all tasks, or could it be chance: the two-sided p value of the permutation test
/// of the [probability of improvement](crate::probability_of_improvement) (Good, *Permutation, Parametric and Bootstrap Tests
/// of Hypotheses*, 2005, chapter 3).
///
/// If the methods do not differ, a run could be of the one as well as of the other. So the runs of each task are dealt anew to
/// the two, 9,999 times; pairs stay together, and their two runs change places or not. p is the share of deals, the one at
/// hand among them, whose probability of improvement is at least as far from ½ (Phipson & Smyth, *Permutation P-values Should
/// Never Be Zero*, Statistical Applications in Genetics and Molecular Biology 9, 2010). It is from 0.0001 to 1.
///
/// Of several pairs of methods correct all of them with [`holm`](crate::holm). The result depends on the arguments alone.
///
/// ```
/// use ne_core::Seed;
/// use ne_statistics::{Comparison, Scores, improvement_test};
///
/// let ours = Scores::new(&[vec![5.0, 6.0, 7.0, 8.0], vec![0.5, 0.6, 0.7, 0.8]])?;
/// let theirs = Scores::new(&[vec![1.0, 2.0, 3.0, 4.0], vec![0.1, 0.2, 0.3, 0.4]])?;
/// // All of ours score more: 2 of 70² deals are as far from a half.
/// let p = improvement_test(&Comparison::unpaired(ours, theirs)?, Seed::of_run(1));
/// assert!(p < 0.002);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn improvement_test(comparison: &Comparison, seed: Seed) -> f64 {
    let mut tasks: Vec<Task> = comparison.x().rows().zip(comparison.y().rows()).map(|(x, y)| Task::new(x, y)).collect();
    let mut stream = seed.stream(PERMUTATION);
    // Twice the rank sums of x, less their mean: in whole numbers, so that what is equal is found equal.
    let found: i64 = tasks.iter().map(Task::deviation).sum();
    let is_as_far = |_: &u32| {
        let dealt: i64 = tasks.iter_mut().map(|task| task.dealt_anew(comparison.is_paired(), &mut stream)).sum();
        dealt.abs() >= found.abs()
    };
    let as_far = (0..DEALS).filter(is_as_far).count();
    (as_far + 1) as f64 / f64::from(DEALS + 1)
}

/// The runs of both methods on a task.
struct Task {
    /// Twice the rank of each run among all; those of x first.
    ranks: Vec<i64>,
    /// How many are of x.
    of_x: usize,
}

impl Task {
    fn new(x: &[f64], y: &[f64]) -> Self {
        let scores = [x, y].concat();
        let ascending = sorted(&scores);
        let doubled = doubled_ranks(&ascending);
        let rank = |score: &f64| doubled[ascending.partition_point(|other| other < score)] as i64;
        Self { ranks: scores.iter().map(rank).collect(), of_x: x.len() }
    }

    /// By how much twice the rank sum of x is more than its mean over all deals.
    fn deviation(&self) -> i64 {
        let (sum, of_x) = (self.ranks[..self.of_x].iter().sum::<i64>(), self.of_x as i64);
        sum - of_x * (self.ranks.len() as i64 + 1)
    }

    /// The same after the runs were dealt anew.
    fn dealt_anew(&mut self, is_paired: bool, stream: &mut RandomStream) -> i64 {
        for place in 0..self.of_x {
            let other = match is_paired {
                true if stream.random() => self.of_x + place,
                true => place,
                false => stream.random_range(place..self.ranks.len()),
            };
            self.ranks.swap(place, other);
        }
        self.deviation()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        probability_of_improvement, rank_sum,
        scores::testing::{any_scores, mapped, scores},
        wilcoxon_signed_rank,
    };
    use proptest::prelude::*;

    fn p(comparison: &Comparison) -> f64 {
        improvement_test(comparison, Seed::of_run(1))
    }

    const X: [f64; 7] = [3.0, 9.0, 4.5, 8.0, 7.0, 5.5, 6.0];
    const Y: [f64; 7] = [1.0, 4.0, 2.0, 5.0, 6.5, 3.5, 2.5];

    /// On one task the statistic is that of the rank-sum test, whose p is exact.
    #[test]
    fn of_one_task_it_is_the_rank_sum_test() {
        let found = p(&Comparison::unpaired(scores(&[&X]), scores(&[&Y])).expect("the same tasks"));
        let exact = rank_sum(&X, &Y).expect("valid samples").p;
        assert!((found - exact).abs() < 0.004, "{found}, {exact}");
    }

    /// Where every pair differs the same way, 2 of 2⁷ ways to turn pairs round are as far from a half.
    #[test]
    fn pairs_stay_together() {
        let found = p(&Comparison::paired(scores(&[&X]), scores(&[&Y])).expect("the same shape"));
        let least = wilcoxon_signed_rank(&X, &Y).expect("valid samples").p;
        assert_eq!(least, 2.0 / 128.0);
        assert!((least - 0.004..least + 0.03).contains(&found), "{found}");
        // Apart they are compared with many more deals.
        let apart = p(&Comparison::unpaired(scores(&[&X]), scores(&[&Y])).expect("the same tasks"));
        assert_ne!(found, apart);
    }

    #[test]
    fn opposite_differences_cancel() {
        let (x, y) = (scores(&[&X, &Y]), scores(&[&Y, &X]));
        let comparison = Comparison::unpaired(x, y).expect("the same tasks");
        assert_eq!((probability_of_improvement(&comparison), p(&comparison)), (0.5, 1.0));
        let nothing = Comparison::unpaired(scores(&[&[2.0; 5]]), scores(&[&[2.0; 6]])).expect("the same tasks");
        assert_eq!(p(&nothing), 1.0);
    }

    /// Of methods that do not differ a share of 5 % of tests finds p ≤ 0.05.
    #[test]
    fn keeps_its_level() {
        let mut stream = Seed::of_run(5).stream(Purpose::new("level"));
        let mut drawn = || -> Vec<Vec<f64>> { (0..3).map(|_| (0..6).map(|_| stream.random()).collect()).collect() };
        for is_paired in [false, true] {
            let claims = (0..200).filter(|_| {
                let [x, y] = [(); 2].map(|()| crate::Scores::new(&drawn()).expect("numbers"));
                let pair = if is_paired { Comparison::paired(x, y) } else { Comparison::unpaired(x, y) };
                p(&pair.expect("the same shape")) <= 0.05
            });
            // 10 expected; by the binomial distribution from 2 to 21 in all but 1 of 1,000 cases.
            let claims = claims.count();
            assert!((2..=21).contains(&claims), "{claims} of 200");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn sees_order_alone(x in any_scores(2, 4), y in any_scores(2, 4)) {
            let rising = |score: f64| score * score * score + 2.0 * score - 7.0;
            let there = Comparison::unpaired(x.clone(), y.clone()).expect("the same tasks");
            let moved = Comparison::unpaired(mapped(&x, rising), mapped(&y, rising)).expect("the same tasks");
            prop_assert_eq!(p(&there), p(&moved));
            prop_assert!(0.0 < p(&there) && p(&there) <= 1.0);
        }
    }
}
