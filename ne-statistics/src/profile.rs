use crate::{Bootstrap, Interval, Scores};
use ne_core::Seed;

/// The performance profile (score distribution) of a method (Agarwal et al. 2021, section 4.2): for each of `thresholds`
/// the share of runs, over all tasks, whose score is *above* it.
///
/// From 0 to 1, and falling as the threshold rises. A method whose profile lies above another's everywhere is better in
/// every quantile. Tasks of different units must be [normalised](crate::normalize) first.
pub fn performance_profile(scores: &Scores, thresholds: &[f64]) -> Vec<f64> {
    thresholds.iter().map(|&threshold| share_above(scores, threshold)).collect()
}

/// The performance profile with the bootstrap interval of each of its points.
///
/// The band is pointwise: each interval holds its point's truth with the bootstrap's confidence, the whole band with
/// less. All points see the same resamples.
pub fn performance_profile_band(
    scores: &Scores,
    thresholds: &[f64],
    bootstrap: &Bootstrap,
    seed: Seed,
) -> Vec<Interval> {
    bootstrap.intervals(scores, |scores| performance_profile(scores, thresholds), seed)
}

fn share_above(scores: &Scores, threshold: f64) -> f64 {
    let values = scores.values();
    values.iter().filter(|&&score| score > threshold).count() as f64 / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scores::testing::{any_scores, scores};
    use proptest::{collection::vec, prelude::*};

    #[test]
    fn is_the_share_strictly_above() {
        let table = scores(&[&[0.0, 0.5], &[0.5, 1.0]]);
        assert_eq!(performance_profile(&table, &[-1.0, 0.0, 0.4, 0.5, 1.0]), [1.0, 0.75, 0.75, 0.25, 0.0]);
        assert_eq!(performance_profile(&table, &[]), [0.0; 0]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn falls_from_1_to_0_within_its_band(scores in any_scores(3, 5), thresholds in vec(-10.0..10.0f64, 1..10)) {
            let mut thresholds = thresholds;
            thresholds.sort_by(f64::total_cmp);
            let profile = performance_profile(&scores, &thresholds);
            prop_assert!(profile.is_sorted_by(|left, right| left >= right));
            let bootstrap = Bootstrap::new(200, 0.95).expect("valid settings");
            let band = performance_profile_band(&scores, &thresholds, &bootstrap, Seed::of_run(1));
            // The same resamples everywhere, so the ends of the band fall too.
            prop_assert!(band.is_sorted_by(|left, right| left.low >= right.low && left.high >= right.high));
            let alone = |&threshold| bootstrap.interval(&scores, |scores| share_above(scores, threshold), Seed::of_run(1));
            prop_assert_eq!(&band, &thresholds.iter().map(alone).collect::<Vec<_>>());
            for (point, interval) in profile.iter().zip(&band) {
                prop_assert_eq!(*point, interval.estimate);
                prop_assert!(0.0 <= interval.low && interval.low <= *point && *point <= interval.high);
                prop_assert!(interval.high <= 1.0);
            }
        }
    }
}
