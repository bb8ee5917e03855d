use super::{FEWEST_SEEDS, SIGNIFICANCE, standings::ScenarioStandings};
use ne_core::Seed;
use ne_statistics::{
    Bootstrap, Comparison, Interval, Reference, Scores, holm, improvement_test, interquartile_mean, normalize,
    performance_profile_band, probability_of_improvement,
};
use serde::Serialize;

/// The bootstrap's seed, so that equal results give equal intervals.
const SEED: u64 = 1;
/// The performance profiles have a point at each fiftieth.
const PROFILE_STEPS: u32 = 50;

/// All scenarios together (Agarwal et al., *Deep Reinforcement Learning at the Edge of the Statistical Precipice*,
/// NeurIPS 2021), with scores brought to 0 for the worst and 1 for the best run of each scenario.
///
/// Those ends come from the runs that are compared, as no other scale is known for a creature and a movement. So another
/// method can move all of these numbers, and the intervals take the ends as given.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Overall {
    /// The places of the scenarios in it: those on which not all scores are the same.
    pub scenarios: Vec<usize>,
    /// The interquartile mean of each method.
    pub methods: Vec<Estimate>,
    /// Each pair of methods.
    pub pairs: Vec<Improvement>,
    /// The normalised scores at which the profiles have a point.
    pub thresholds: Vec<f64>,
    /// The performance profile of each method: the share of runs above each threshold.
    pub profiles: Vec<Vec<Estimate>>,
}

/// A number with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// The ends of its 95 % interval, by the stratified bootstrap with 2,000 resamples; `None` with a single seed.
    pub interval: Option<[f64; 2]>,
}

/// How probably one method improves on another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Improvement {
    /// The place of the one method.
    pub first: usize,
    /// The place of the other.
    pub second: usize,
    /// The probability that a run of the first scores more than a run of the second on a scenario drawn at random.
    pub probability: Estimate,
    /// How likely a probability at least as far from ½ is if the two do not differ: by a permutation test.
    pub p: f64,
    /// The same after Holm's correction for all pairs of methods.
    pub p_corrected: f64,
    /// The method that does better, if that can be claimed: with at least 6 seeds, if the corrected p value is at most 0.05 and
    /// the interquartile mean is higher too.
    pub better: Option<usize>,
}

impl Estimate {
    fn new(interval: Interval, seeds: usize) -> Self {
        let Interval { estimate, low, high } = interval;
        Self { value: estimate, interval: (seeds > 1).then_some([low, high]) }
    }
}

impl Overall {
    pub(super) fn new(standings: &[ScenarioStandings]) -> Option<Self> {
        let reference = |scenario: &ScenarioStandings| Some(Reference { low: scenario.worst?, high: scenario.best? });
        let (mut scenarios, mut references) = (Vec::new(), Vec::new());
        for (place, scenario) in standings.iter().enumerate() {
            if let Some(reference) = reference(scenario).filter(|reference| reference.low < reference.high) {
                scenarios.push(place);
                references.push(reference);
            }
        }
        let normalised = |method: usize| {
            let rows: Vec<Vec<f64>> =
                scenarios.iter().map(|&scenario| standings[scenario].methods[method].scores.clone()).collect();
            normalize(&Scores::new(&rows).ok()?, &references).ok()
        };
        let count = standings.first()?.methods.len();
        let methods: Vec<Scores> = (0..count).map(normalised).collect::<Option<_>>()?;
        let seeds = methods.first()?.runs();
        let paired = standings.iter().all(|scenario| scenario.paired);
        let (bootstrap, seed) = (Bootstrap::default(), Seed::of_run(SEED));
        let thresholds: Vec<f64> = (0..=PROFILE_STEPS).map(|step| f64::from(step) / f64::from(PROFILE_STEPS)).collect();
        let mean = |scores| Estimate::new(bootstrap.interval(scores, interquartile_mean, seed), seeds);
        let profile = |scores| {
            let band = performance_profile_band(scores, &thresholds, &bootstrap, seed);
            band.into_iter().map(|interval| Estimate::new(interval, seeds)).collect()
        };
        let means: Vec<Estimate> = methods.iter().map(mean).collect();
        let improvement = |first: usize, second: usize| {
            let (x, y) = (methods[first].clone(), methods[second].clone());
            let pair = if paired { Comparison::paired(x, y) } else { Comparison::unpaired(x, y) }.ok()?;
            let interval = bootstrap.comparison(&pair, probability_of_improvement, seed);
            let (probability, p) = (Estimate::new(interval, seeds), improvement_test(&pair, seed));
            Some(Improvement { first, second, probability, p, p_corrected: p, better: None })
        };
        let seconds = |first| (first + 1..count).map(move |second| (first, second));
        let pairs = (0..count).flat_map(seconds).filter_map(|(first, second)| improvement(first, second));
        let mut pairs: Vec<Improvement> = pairs.collect();
        correct(&mut pairs);
        if seeds >= FEWEST_SEEDS {
            pairs.iter_mut().for_each(|pair| pair.claim(&means));
        }
        Some(Self { pairs, profiles: methods.iter().map(profile).collect(), methods: means, scenarios, thresholds })
    }
}

impl Improvement {
    /// Says which method does better, if that can be claimed.
    fn claim(&mut self, means: &[Estimate]) {
        let (better, worse) =
            if self.probability.value > 0.5 { (self.first, self.second) } else { (self.second, self.first) };
        let is_claimed = self.p_corrected <= SIGNIFICANCE && means[better].value > means[worse].value;
        self.better = is_claimed.then_some(better);
    }
}

/// Corrects the tests of all pairs together.
fn correct(pairs: &mut [Improvement]) {
    let p_values: Vec<f64> = pairs.iter().map(|pair| pair.p).collect();
    // p values of tests are from 0 to 1, so this cannot fail; without a correction nothing would be claimed.
    let corrected = holm(&p_values).unwrap_or_else(|_| vec![1.0; p_values.len()]);
    for (pair, p_corrected) in pairs.iter_mut().zip(corrected) {
        pair.p_corrected = p_corrected;
    }
}
