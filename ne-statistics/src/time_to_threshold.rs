use crate::Curve;

/// How much is spent until half of all runs reach `threshold`: the median of
/// [`first_reaching`](Curve::first_reaching), in the unit of the curves' x.
///
/// A run that ends without reaching the threshold is *censored*: it would have taken longer than its end by an unknown
/// amount. Leaving it out, or counting its end, would flatter the method. The median is that of the Kaplan–Meier
/// estimate (Kaplan & Meier, *Nonparametric Estimation from Incomplete Observations*, Journal of the American
/// Statistical Association 53, 1958): the least x at which the estimated share of runs still below the threshold is at
/// most a half. When all runs are observed equally long that is plainly the least x by which half of them have reached
/// it (with an even number of runs the lower of the two in the middle).
///
/// `None` if it never comes to a half: with runs observed equally long, when more than half never reach the threshold.
/// Also `None` without curves. Runs that end at different x must not have been ended *because* of their scores.
pub fn median_to_threshold(curves: &[Curve], threshold: f64) -> Option<f64> {
    let outcome = |curve: &Curve| match curve.first_reaching(threshold) {
        Some(x) => (x, true),
        None => (curve.end(), false),
    };
    let mut outcomes: Vec<(f64, bool)> = curves.iter().map(outcome).collect();
    // At the same x those that reach the threshold come before those that end, which were still observed then.
    outcomes.sort_by(|one, other| one.0.total_cmp(&other.0).then(other.1.cmp(&one.1)));
    let mut share_below = 1.0;
    for (index, &(x, is_reached)) in outcomes.iter().enumerate() {
        if is_reached {
            let observed = (outcomes.len() - index) as f64;
            share_below *= (observed - 1.0) / observed;
            // The product of fractions that make a half is a half but for rounding.
            if share_below <= 0.5 + 1e-9 {
                return Some(x);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    /// A run that reaches 1 at `reaches`, if at all, and ends at `end`.
    fn run(reaches: Option<f64>, end: f64) -> Curve {
        let points = [Some((0.0, 0.0)), reaches.map(|x| (x, 1.0))].into_iter().flatten().collect();
        Curve::new(points, end).expect("a valid curve")
    }

    fn median(runs: &[(Option<f64>, f64)]) -> Option<f64> {
        let curves: Vec<Curve> = runs.iter().map(|&(reaches, end)| run(reaches, end)).collect();
        median_to_threshold(&curves, 1.0)
    }

    #[test]
    fn with_equal_budgets_is_when_half_have_reached_it() {
        let of = |reaching: &[Option<f64>]| median(&reaching.iter().map(|&x| (x, 100.0)).collect::<Vec<_>>());
        assert_eq!(of(&[Some(30.0), Some(10.0), Some(20.0)]), Some(20.0));
        assert_eq!(of(&[Some(30.0), None, Some(10.0)]), Some(30.0));
        assert_eq!(of(&[None, Some(10.0), Some(40.0), None]), Some(40.0));
        assert_eq!(of(&[None, Some(10.0), None]), None);
        assert_eq!(of(&[None]), None);
        assert_eq!(of(&[]), None);
    }

    /// By hand: below are 4/5 after 10; one run ends at 15 and leaves three; 4/5 · 2/3 = 8/15 after 20, 4/15 after 30.
    #[test]
    fn a_run_that_ends_early_counts_until_its_end() {
        let runs = [(Some(10.0), 100.0), (None, 15.0), (Some(20.0), 100.0), (Some(30.0), 100.0), (None, 100.0)];
        assert_eq!(median(&runs), Some(30.0));
        // Had it ended before 10, three fourths, a half.
        assert_eq!(median(&[runs[0], (None, 5.0), runs[2], runs[3], runs[4]]), Some(20.0));
    }

    proptest! {
        #[test]
        fn with_equal_budgets_is_an_order_statistic(reaching in vec(proptest::option::of(1..90i32), 1..30)) {
            let reaching: Vec<Option<f64>> = reaching.into_iter().map(|x| x.map(f64::from)).collect();
            let mut times: Vec<f64> = reaching.iter().map(|x| x.unwrap_or(f64::INFINITY)).collect();
            times.sort_by(f64::total_cmp);
            let middle = times[times.len().div_ceil(2) - 1];
            let runs: Vec<_> = reaching.into_iter().map(|x| (x, 100.0)).collect();
            prop_assert_eq!(median(&runs), Some(middle).filter(|x| x.is_finite()));
        }

        /// A higher threshold is never reached earlier.
        #[test]
        fn rises_with_the_threshold(rises in vec((1..50i32, 51..99i32), 1..20)) {
            let curve = |&(one, two): &(i32, i32)| Curve::new(vec![(f64::from(one), 1.0), (f64::from(two), 2.0)], 100.0);
            let curves: Vec<Curve> = rises.iter().map(|rise| curve(rise).expect("a valid curve")).collect();
            prop_assert!(median_to_threshold(&curves, 1.0) < median_to_threshold(&curves, 2.0));
        }
    }
}
