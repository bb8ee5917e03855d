use super::{
    standings::Standings,
    trace::{Axis, Trace, Traces},
};
use ne_statistics::{Curve, median_to_threshold};
use serde::Serialize;

/// The shares of the best median score that are asked for.
const SHARES: [f64; 2] = [0.5, 0.9];

/// A score, and how long each method took to reach it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Threshold {
    /// The share of the best median score over the methods.
    pub share: f64,
    /// The score that is.
    pub score: f64,
    /// Each method.
    pub methods: Vec<TimeToThreshold>,
}

/// How long a method took. Medians count runs that ended below the threshold as censored
/// ([`median_to_threshold`](ne_statistics::median_to_threshold)); `None` if fewer than half of the runs reached it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TimeToThreshold {
    /// How many runs reached it until their end.
    pub reached: usize,
    /// Median of the evaluations.
    pub evaluations: Option<f64>,
    /// Median of the physics steps.
    pub steps: Option<f64>,
    /// Median of the seconds of wall clock.
    pub seconds: Option<f64>,
}

impl Threshold {
    /// The thresholds of a scenario; none if no method's median score is above 0, as a share of it would mean nothing, and
    /// none if a fitness has terms.
    pub(super) fn of_scenario(traces: &Traces, scenario: usize, standings: &Standings) -> Vec<Self> {
        // Scores without terms are known of the end alone, not of the way there.
        if traces.methods(scenario).iter().flatten().any(Trace::is_shaped) {
            return Vec::new();
        }
        let medians = standings.scenarios[scenario].methods.iter().filter_map(|method| Some(method.summary?.median));
        let Some(best) = medians.reduce(f64::max).filter(|&best| best > 0.0) else { return Vec::new() };
        let threshold = |share| {
            let score = share * best;
            let time = |method| TimeToThreshold::new(traces, scenario, method, score);
            Self { share, score, methods: (0..traces.methods(scenario).len()).map(time).collect() }
        };
        SHARES.map(threshold).into()
    }
}

impl TimeToThreshold {
    fn new(traces: &Traces, scenario: usize, method: usize, score: f64) -> Self {
        let curves = |axis| -> Vec<Curve> {
            traces.runs(scenario, method).iter().filter_map(|run| run.curve(axis).cloned()).collect()
        };
        let median = |axis| median_to_threshold(&curves(axis), score);
        Self {
            reached: curves(Axis::Evaluations).iter().filter(|curve| curve.first_reaching(score).is_some()).count(),
            evaluations: median(Axis::Evaluations),
            steps: median(Axis::Steps),
            seconds: median(Axis::Seconds),
        }
    }
}
