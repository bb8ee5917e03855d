use crate::{
    Comparison, Scores,
    quantile::{quantile_of_sorted, sorted},
};
use ne_core::{Purpose, RandomStream, Seed, SettingError};
use serde::{Deserialize, Serialize};

const BOOTSTRAP: Purpose = Purpose::new("bootstrap");

/// Percentile intervals by the stratified bootstrap (Agarwal et al. 2021, section 4.1; Efron & Tibshirani, *An
/// Introduction to the Bootstrap*, 1993, chapter 13).
///
/// The tasks are the strata: a resample draws, for each task anew, as many of its runs as it has, with replacement. The
/// interval spans the middle `confidence` of the statistic's values on the resamples. It says how far the statistic
/// would move with other runs on the *same* tasks, not on other tasks.
///
/// With few runs it is too narrow, and more tasks do not help much. Of uniformly distributed scores an interval of 95 %
/// holds the true mean in 84 % of cases (1 task, 5 runs), 91 % (10 tasks, 5 runs; or 1 task, 10 runs) or 94 % (3 tasks,
/// 20 runs); this file's tests check that to within 2 %.
///
/// Runs of different tasks are drawn independently, even if they share a seed.
/// The result depends on the arguments alone. The same seed draws the same runs from tables of the same shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bootstrap {
    resamples: usize,
    confidence: f64,
}

/// A statistic of the scores with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Interval {
    /// The statistic of the scores themselves.
    pub estimate: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// The upper end of the interval. A biased statistic's estimate can lie outside.
    pub high: f64,
}

impl Default for Bootstrap {
    /// 2,000 resamples, 95 %. By the binomial distribution 2.5 % ± 0.35 % (one standard deviation) of the statistic's
    /// distribution then lies beyond each end. For figures in a paper take 50,000, as the authors' library does.
    fn default() -> Self {
        Self { resamples: 2000, confidence: 0.95 }
    }
}

impl Bootstrap {
    /// Intervals from `resamples` resamples, at least 100, that span `confidence`, from 0.5 to 0.999.
    ///
    /// # Errors
    /// The error names the setting and its range.
    pub fn new(resamples: usize, confidence: f64) -> Result<Self, SettingError> {
        SettingError::check_at_least("resamples", resamples, 100)?;
        SettingError::check_range("confidence", confidence, 0.5, 0.999)?;
        Ok(Self { resamples, confidence })
    }

    /// The interval of a statistic of one method's scores.
    ///
    /// `statistic` must be finite for all scores of this shape.
    pub fn interval(&self, scores: &Scores, statistic: impl Fn(&Scores) -> f64, seed: Seed) -> Interval {
        self.percentile(scores, statistic, Scores::resample, seed)
    }

    /// The intervals of several statistics of one method's scores, all of the same resamples: as [`interval`](Self::interval) gives
    /// each, but each resample is drawn once.
    pub(crate) fn intervals(
        &self,
        scores: &Scores,
        statistics: impl Fn(&Scores) -> Vec<f64>,
        seed: Seed,
    ) -> Vec<Interval> {
        self.percentiles(scores, statistics, Scores::resample, seed)
    }

    /// The interval of a statistic of two methods' scores, such as a difference or
    /// [`probability_of_improvement`](crate::probability_of_improvement).
    ///
    /// Pairs of runs are drawn together, others independently; see [`Comparison`]. `statistic` must be finite for all
    /// comparisons of this shape.
    ///
    /// ```
    /// # use ne_statistics::*;
    /// # use ne_core::Seed;
    /// # let x = Scores::new(&[vec![3.0, 5.0, 4.0, 6.0]])?;
    /// # let y = Scores::new(&[vec![2.0, 4.5, 3.5, 4.0]])?;
    /// let comparison = Comparison::paired(x, y)?;
    /// let difference = |both: &Comparison| interquartile_mean(both.x()) - interquartile_mean(both.y());
    /// let interval = Bootstrap::default().comparison(&comparison, difference, Seed::of_run(1));
    /// assert_eq!(interval.estimate, 0.75);
    /// assert!(interval.low > 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn comparison(&self, comparison: &Comparison, statistic: impl Fn(&Comparison) -> f64, seed: Seed) -> Interval {
        self.percentile(comparison, statistic, Comparison::resample, seed)
    }

    fn percentile<Data: Clone>(
        &self,
        data: &Data,
        statistic: impl Fn(&Data) -> f64,
        draw: impl Fn(&Data, &mut Data, &mut RandomStream),
        seed: Seed,
    ) -> Interval {
        let [interval] = self.percentiles(data, |data| [statistic(data)], draw, seed)[..] else {
            unreachable!("one statistic has one interval")
        };
        interval
    }

    fn percentiles<Data: Clone, Values: AsRef<[f64]>>(
        &self,
        data: &Data,
        statistics: impl Fn(&Data) -> Values,
        draw: impl Fn(&Data, &mut Data, &mut RandomStream),
        seed: Seed,
    ) -> Vec<Interval> {
        let mut stream = seed.stream(BOOTSTRAP);
        let mut resample = data.clone();
        let mut statistics_of_next = || {
            draw(data, &mut resample, &mut stream);
            statistics(&resample)
        };
        let resamples: Vec<Values> = (0..self.resamples).map(|_| statistics_of_next()).collect();
        let beyond = (1.0 - self.confidence) / 2.0;
        let interval = |(index, &estimate): (usize, &f64)| {
            let values: Vec<f64> = resamples.iter().map(|values| values.as_ref()[index]).collect();
            let values = sorted(&values);
            let [low, high] = [beyond, 1.0 - beyond].map(|share| quantile_of_sorted(&values, share));
            Interval { estimate, low, high }
        };
        statistics(data).as_ref().iter().enumerate().map(interval).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        interquartile_mean, mean, probability_of_improvement,
        scores::testing::{any_scores, mapped, scores},
    };
    use proptest::prelude::*;
    use rand::RngExt;

    fn difference(both: &Comparison) -> f64 {
        mean(both.x()) - mean(both.y())
    }

    /// Scores from 0 to 1, uniformly distributed, so that their mean is 0.5 and their variance 1/12.
    fn uniform(tasks: usize, runs: usize, seed: Seed) -> Scores {
        let mut stream = seed.stream(Purpose::new("test"));
        let rows: Vec<Vec<f64>> = (0..tasks).map(|_| (0..runs).map(|_| stream.random()).collect()).collect();
        Scores::new(&rows).expect("valid scores")
    }

    /// Of the mean of uniformly distributed scores, with 1000 tables each (standard deviation of a share: 1 %).
    #[test]
    fn covers_the_truth_as_often_as_documented() {
        let bootstrap = Bootstrap::new(400, 0.95).expect("valid settings");
        for (tasks, runs, documented) in [(1, 5, 84.0), (10, 5, 91.0), (1, 10, 91.0), (3, 20, 94.0)] {
            let covering = (0..1000).map(|index| Seed::of_run(1).individual(index)).filter(|&seed| {
                let interval = bootstrap.interval(&uniform(tasks, runs, seed), mean, seed);
                interval.low <= 0.5 && 0.5 <= interval.high
            });
            let share = covering.count() as f64 / 10.0;
            assert!((share - documented).abs() <= 2.0, "{tasks} tasks, {runs} runs: {share} %");
        }
    }

    /// The standard error of a mean is known; a percentile interval of it reaches 1.96 standard errors to each side.
    #[test]
    fn width_is_that_of_the_normal_approximation() {
        let scores = uniform(2, 200, Seed::of_run(1));
        let interval = Bootstrap::default().interval(&scores, mean, Seed::of_run(2));
        let expected = 2.0 * 1.96 * (1.0_f64 / 12.0 / 400.0).sqrt();
        assert!(((interval.high - interval.low) / expected - 1.0).abs() < 0.1, "{interval:?}");
    }

    /// Tasks differ by 100, runs hardly: without strata the interval would be wide.
    #[test]
    fn differences_between_tasks_do_not_count() {
        let scores = scores(&[&[0.0, 1.0, 0.0, 1.0], &[100.0, 101.0, 100.0, 101.0]]);
        let interval = Bootstrap::default().interval(&scores, mean, Seed::of_run(1));
        assert!(50.0 <= interval.low && interval.high <= 51.0, "{interval:?}");
    }

    #[test]
    fn pairs_narrow_the_interval_of_a_difference() {
        let x = uniform(2, 20, Seed::of_run(1));
        let y = mapped(&x, |score| score - 0.1);
        let [paired, unpaired] = [Comparison::paired, Comparison::unpaired].map(|compare| {
            let comparison = compare(x.clone(), y.clone()).expect("the same shape");
            Bootstrap::default().comparison(&comparison, difference, Seed::of_run(1))
        });
        assert!(paired.high - paired.low < 1e-9, "{paired:?}");
        assert!(unpaired.high - unpaired.low > 0.2, "{unpaired:?}");
    }

    #[test]
    fn depends_on_the_seed_alone() {
        let scores = uniform(2, 10, Seed::of_run(1));
        let interval = |seed| Bootstrap::default().interval(&scores, mean, Seed::of_run(seed));
        assert_eq!(interval(1), interval(1));
        assert_ne!(interval(1), interval(2));
    }

    /// Golden: a change of these numbers changes every interval ever published.
    #[test]
    fn intervals_are_the_same_for_ever() {
        let x = scores(&[&[1.0, 2.0, 4.0, 8.0, 16.0], &[3.0, 9.0, 27.0, 81.0, 243.0]]);
        let y = scores(&[&[1.0, 3.0, 3.0, 7.0, 18.0], &[2.0, 10.0, 20.0, 90.0, 200.0]]);
        let interval = Bootstrap::default().interval(&x, mean, Seed::of_run(1));
        assert_eq!(interval, Interval { estimate: 39.4, low: 8.2, high: 86.30249999999998 });
        let unpaired = Comparison::unpaired(x.clone(), y.clone()).expect("the same shape");
        let interval = Bootstrap::default().comparison(&unpaired, probability_of_improvement, Seed::of_run(1));
        assert_eq!(interval, Interval { estimate: 0.51, low: 0.24, high: 0.78 });
        let paired = Comparison::paired(x, y).expect("the same shape");
        let interval = Bootstrap::default().comparison(&paired, difference, Seed::of_run(1));
        assert_eq!(interval, Interval { estimate: 4.0, low: -2.299999999999997, high: 13.302499999999997 });
    }

    #[test]
    fn errors_name_the_setting() {
        let message =
            |resamples, confidence| Bootstrap::new(resamples, confidence).expect_err("out of range").to_string();
        assert_eq!(message(99, 0.95), "resamples = 99: must be at least 100");
        assert_eq!(message(100, 0.4), "confidence = 0.4: must be from 0.5 to 0.999");
        assert_eq!(message(100, f64::NAN), "confidence = NaN: must be from 0.5 to 0.999");
        assert_eq!(Bootstrap::new(2000, 0.95), Ok(Bootstrap::default()));
    }

    #[test]
    fn an_interval_survives_a_file() {
        let interval = Interval { estimate: 0.5, low: 0.25, high: 0.75 };
        let text = serde_json::to_string(&interval).expect("serialises");
        assert_eq!(text, r#"{"estimate":0.5,"low":0.25,"high":0.75}"#);
        assert_eq!(serde_json::from_str::<Interval>(&text).expect("deserialises"), interval);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn moves_and_stretches_with_the_scores(scores in any_scores(2, 6), shift in -9..9i32, seed: u64) {
            let (bootstrap, seed) = (Bootstrap::new(100, 0.9).expect("valid settings"), Seed::of_run(seed));
            let interval = bootstrap.interval(&scores, interquartile_mean, seed);
            let moved = mapped(&scores, |score| f64::from(shift) + 3.0 * score);
            let moved = bootstrap.interval(&moved, interquartile_mean, seed);
            for (before, after) in [(interval.low, moved.low), (interval.high, moved.high)] {
                prop_assert!((after - (f64::from(shift) + 3.0 * before)).abs() < 1e-9);
            }
            prop_assert!(interval.low <= interval.high);
        }

        #[test]
        fn more_confidence_is_wider(scores in any_scores(2, 6), seed: u64) {
            let interval = |confidence| {
                let bootstrap = Bootstrap::new(200, confidence).expect("valid settings");
                bootstrap.interval(&scores, mean, Seed::of_run(seed))
            };
            let (narrow, wide) = (interval(0.5), interval(0.95));
            prop_assert!(wide.low <= narrow.low && narrow.high <= wide.high);
        }
    }
}
