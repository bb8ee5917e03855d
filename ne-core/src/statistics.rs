use crate::{Evaluation, Fitness, SpeciesReport, Statistic, champion_selection::ReEvaluationReport};
use serde::{Deserialize, Serialize};
use std::{cmp::Reverse, collections::BTreeMap};

/// What happened in one generation: plain data, a line of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GenerationReport {
    /// Which generation, counted from 1.
    pub generation: u64,
    /// Evaluations since the run began, this generation included.
    pub evaluations: u64,
    /// Steps of work since the run began.
    pub steps: u64,
    /// The best fitness since the run began, with a champion selection the best at a re-evaluation; `None` while there was none.
    pub best_so_far: Option<Fitness>,
    /// The champion's [tier](crate::champion_selection::ReEvaluation::tiers).
    #[serde(default, skip_serializing_if = "is_zero")]
    pub tier: u8,
    /// The fitnesses of this generation; `None` if all failed.
    pub fitness: Option<Quantiles>,
    /// How many evaluations failed.
    pub failures: u64,
    /// Where all failed, the commonest reason; of equally common ones the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
    /// How many members the population had.
    pub population: u64,
    /// What the strategy says of itself.
    pub strategy: Vec<Statistic>,
    /// The species, if the strategy has species.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub species: Vec<SpeciesReport>,
    /// What came of the re-evaluation, if there is a champion selection and a re-evaluation took place after this generation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub re_evaluation: Option<ReEvaluationReport>,
}

/// The commonest reason why these evaluations failed, of equally common ones the first; `None` if one did not, or there are none.
pub(crate) fn commonest_failure(evaluations: &[Evaluation]) -> Option<String> {
    // How often, and first where.
    let mut reasons: BTreeMap<String, (usize, Reverse<usize>)> = BTreeMap::new();
    for (index, evaluation) in evaluations.iter().enumerate() {
        let reason = evaluation.outcome.as_ref().err()?.to_string();
        reasons.entry(reason).or_insert((0, Reverse(index))).0 += 1;
    }
    reasons.into_iter().max_by_key(|&(_, often)| often).map(|(reason, _)| reason)
}

/// The distribution of a generation's fitnesses, failures left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantiles {
    /// The highest.
    pub best: f64,
    /// The arithmetic mean.
    pub mean: f64,
    /// The middle one (with an even number the mean of the two in the middle).
    pub median: f64,
    /// The lowest.
    pub worst: f64,
    /// A tenth are at most this (linear interpolation between neighbours).
    pub q10: f64,
    /// A quarter are at most this.
    pub q25: f64,
    /// Three quarters are at most this.
    pub q75: f64,
    /// Nine tenths are at most this.
    pub q90: f64,
}

impl Quantiles {
    /// The distribution of these evaluations' fitnesses, or `None` if all failed.
    pub fn of(evaluations: &[Evaluation]) -> Option<Self> {
        let mut values: Vec<f64> = evaluations.iter().filter_map(Evaluation::fitness).map(Fitness::get).collect();
        values.sort_by(f64::total_cmp);
        let (&worst, &best) = (values.first()?, values.last()?);
        let count = values.len() as f64;
        let at = |share: f64| {
            let position = share * (count - 1.0);
            let (low, high) = (values[position.floor() as usize], values[position.ceil() as usize]);
            let share = position.fract();
            // The difference of huge fitnesses overflows; then each is weighed first.
            if (high - low).is_finite() { low + (high - low) * share } else { low * (1.0 - share) + high * share }
        };
        // Divided before summing, so that huge fitnesses do not overflow.
        let mean = values.iter().map(|value| value / count).sum();
        Some(Self { best, mean, median: at(0.5), worst, q10: at(0.1), q25: at(0.25), q75: at(0.75), q90: at(0.9) })
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_zero(tier: &u8) -> bool {
    *tier == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Failure;

    #[test]
    fn the_commonest_reason_is_told_where_all_failed() {
        let failed = |what: &str| Evaluation::failed(Failure::Other { what: what.into() });
        let told = |reasons: &[&str]| commonest_failure(&reasons.iter().map(|what| failed(what)).collect::<Vec<_>>());
        assert_eq!(told(&["b", "a", "c", "a", "b"]).as_deref(), Some("b"));
        assert_eq!(told(&["b", "a", "c", "a"]).as_deref(), Some("a"));
        assert_eq!(told(&[]), None);
        assert_eq!(commonest_failure(&[failed("a"), Evaluation::new(1.0)]), None);
    }

    #[test]
    fn quantiles_interpolate_and_skip_failures() {
        let evaluations: Vec<_> = [4.0, 1.0, f64::NAN, 3.0, 2.0, 5.0].into_iter().map(Evaluation::new).collect();
        let quantiles = Quantiles::of(&evaluations).expect("five of six survived");
        assert_eq!(
            (quantiles.worst, quantiles.q25, quantiles.median, quantiles.q75, quantiles.best),
            (1.0, 2.0, 3.0, 4.0, 5.0)
        );
        assert_eq!((quantiles.mean, quantiles.q10, quantiles.q90), (3.0, 1.4, 4.6));
        assert_eq!(Quantiles::of(&evaluations[2..3]), None);
    }

    #[test]
    fn quantiles_of_huge_fitnesses_are_finite() {
        let evaluations: Vec<_> = [f64::MIN, f64::MAX].into_iter().map(Evaluation::new).collect();
        let quantiles = Quantiles::of(&evaluations).expect("both survived");
        assert_eq!((quantiles.median, quantiles.mean), (0.0, 0.0));
        assert!(quantiles.q10.is_finite() && quantiles.q90.is_finite());
    }
}
