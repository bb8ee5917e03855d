use super::{
    SIGNIFICANCE,
    overall::Overall,
    trace::{Axis, Trace, Traces},
};
use ne_statistics::{
    Scores, hodges_lehmann, holm, mean, quantile, rank_sum, shift_between, vargha_delaney, wilcoxon_signed_rank,
};
use serde::Serialize;

/// The scores of all runs when equally much was spent, and what they say.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Standings {
    /// What was spent.
    pub axis: Axis,
    /// Each scenario.
    pub scenarios: Vec<ScenarioStandings>,
    /// How many tests were made and corrected together.
    pub tests: usize,
    /// All scenarios together; `None` if scores differ on none of them.
    pub overall: Option<Overall>,
}

/// The scores on a scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenarioStandings {
    /// How much every run may have spent: the plan's budget, or less if a run ended earlier. `None` without runs, and of a
    /// fitness with terms where the plan has no budget of this kind: scores are those of the ends of runs, equal in nothing else.
    pub limit: Option<f64>,
    /// The worst score of all runs, which those without a score count with; `None` if no run has one.
    pub worst: Option<f64>,
    /// The best score of all runs.
    pub best: Option<f64>,
    /// Whether runs with the same seed are pairs: they are where they share worlds.
    pub paired: bool,
    /// The scores of each method.
    pub methods: Vec<MethodScores>,
    /// Each pair of methods; none if no run has a score, or with a single seed.
    pub pairs: Vec<PairTest>,
}

/// The scores of a method on a scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodScores {
    /// A score for each seed; empty if no run of any method has one.
    pub scores: Vec<f64>,
    /// The places of the seeds without a score, whose runs count with the worst of the scenario: every evaluation had
    /// failed by then, or the first generation was not over; where the fitness has terms, the champion fails without them.
    pub unscored: Vec<usize>,
    /// The scores in short.
    pub summary: Option<Summary>,
    /// The median of the fitnesses of the champions whose scores these are, terms included; `None` if the fitness has none.
    pub with_terms: Option<f64>,
}

/// Scores in short.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Half of the runs are at most this.
    pub median: f64,
    /// A quarter of the runs are at most this.
    pub lower: f64,
    /// Three quarters of the runs are at most this.
    pub upper: f64,
    /// The mean.
    pub mean: f64,
    /// The highest.
    pub best: f64,
    /// The lowest.
    pub worst: f64,
}

/// Two methods on a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PairTest {
    /// The place of the one method.
    pub first: usize,
    /// The place of the other.
    pub second: usize,
    /// By how much the first scores more: the Hodges–Lehmann estimate, of pairs or of independent runs.
    pub shift: f64,
    /// The two-sided p value: of the signed-rank test of pairs, of the rank-sum test of independent runs.
    pub p: f64,
    /// The same after Holm's correction for all tests of these [`Standings`].
    pub p_corrected: f64,
    /// Of pairs: seeds at which the two differ; others do not count in the test.
    pub differing: Option<usize>,
    /// The rank-biserial correlation, from −1 to 1; of pairs that of matched pairs.
    pub rank_biserial: f64,
    /// Vargha & Delaney's A₁₂: how probably a run of the first scores more than one of the second.
    pub superiority: f64,
    /// A word for it.
    pub effect: Effect,
    /// The method that scores more, if that can be claimed: the corrected p value is at most 0.05.
    pub better: Option<usize>,
}

/// The size of an effect, as Vargha & Delaney 2000 call it: A₁₂, or one less it, from 0.56 on is small, from 0.64 medium,
/// from 0.71 large.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effect {
    /// Less than small.
    Negligible,
    /// Small.
    Small,
    /// Medium.
    Medium,
    /// Large.
    Large,
}

impl Effect {
    /// The word for an A₁₂.
    pub fn of(superiority: f64) -> Self {
        match superiority.max(1.0 - superiority) {
            size if size < 0.56 => Self::Negligible,
            size if size < 0.64 => Self::Small,
            size if size < 0.71 => Self::Medium,
            _ => Self::Large,
        }
    }

    /// The word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Negligible => "negligible",
            Self::Small => "small",
            Self::Medium => "medium",
            Self::Large => "large",
        }
    }
}

impl Standings {
    /// `paired`: of which scenarios runs with the same seed are pairs.
    pub(super) fn new(traces: &Traces, axis: Axis, budget: Option<u64>, paired: &[bool]) -> Self {
        let of_scenario =
            |scenario: usize| ScenarioStandings::new(traces.methods(scenario), axis, budget, paired[scenario]);
        let mut scenarios: Vec<ScenarioStandings> = (0..traces.scenarios()).map(of_scenario).collect();
        let tests = correct(&mut scenarios);
        let overall = Overall::new(&scenarios);
        Self { axis, scenarios, tests, overall }
    }
}

impl ScenarioStandings {
    fn new(methods: &[Vec<Trace>], axis: Axis, budget: Option<u64>, paired: bool) -> Self {
        let ends = methods.iter().flatten().filter_map(|run| Some(run.curve(axis)?.end()));
        let has_limit = budget.is_some() || !methods.iter().flatten().any(Trace::is_shaped);
        let least = ends.reduce(f64::min).filter(|_| has_limit);
        let limit = least.map(|least| budget.map_or(least, |budget| least.min(budget as f64)));
        let score = |run: &Trace| run.score(axis, limit?);
        let found: Vec<f64> = methods.iter().flatten().filter_map(score).collect();
        let (worst, best) = (found.iter().copied().reduce(f64::min), found.iter().copied().reduce(f64::max));
        let fitness = |run: &Trace| run.last()?.best.filter(|_| run.is_shaped());
        let scores = |runs: &Vec<Trace>| {
            let fitnesses: Vec<f64> = runs.iter().filter_map(fitness).collect();
            MethodScores { with_terms: quantile(&fitnesses, 0.5), ..method_scores(runs, score, worst) }
        };
        let methods: Vec<MethodScores> = methods.iter().map(scores).collect();
        Self { limit, worst, best, paired, pairs: pairs(&methods, paired), methods }
    }
}

fn method_scores(runs: &[Trace], score: impl Fn(&Trace) -> Option<f64>, worst: Option<f64>) -> MethodScores {
    let found: Vec<Option<f64>> = runs.iter().map(score).collect();
    let scores: Vec<f64> = found.iter().filter_map(|score| score.or(worst)).collect();
    let unscored = (0..found.len()).filter(|&seed| found[seed].is_none()).collect();
    MethodScores { summary: Summary::of(&scores), scores, unscored, with_terms: None }
}

impl Summary {
    fn of(scores: &[f64]) -> Option<Self> {
        let share = |share| quantile(scores, share);
        Some(Self {
            median: share(0.5)?,
            lower: share(0.25)?,
            upper: share(0.75)?,
            mean: mean(&Scores::new(&[scores.to_vec()]).ok()?),
            best: share(1.0)?,
            worst: share(0.0)?,
        })
    }
}

fn pairs(methods: &[MethodScores], paired: bool) -> Vec<PairTest> {
    let seconds = |first| (first + 1..methods.len()).map(move |second| (first, second));
    let places = (0..methods.len()).flat_map(seconds);
    places.filter_map(|(first, second)| pair(methods, first, second, paired)).collect()
}

/// The test of a pair, not corrected yet. `None` without scores, and with a single run, which says nothing of a method.
fn pair(methods: &[MethodScores], first: usize, second: usize, paired: bool) -> Option<PairTest> {
    let (x, y) = (&methods[first].scores, &methods[second].scores);
    if x.len() == 1 {
        return None;
    }
    let superiority = vargha_delaney(x, y).ok()?;
    let (p, rank_biserial, differing, shift) = if paired {
        let test = wilcoxon_signed_rank(x, y).ok()?;
        (test.p, test.rank_biserial, Some(test.pairs), hodges_lehmann(x, y).ok()?)
    } else {
        let test = rank_sum(x, y).ok()?;
        (test.p, test.rank_biserial, None, shift_between(x, y).ok()?)
    };
    Some(PairTest {
        first,
        second,
        shift,
        p,
        p_corrected: p,
        differing,
        rank_biserial,
        superiority,
        effect: Effect::of(superiority),
        better: None,
    })
}

/// Corrects all tests together; gives how many there are.
fn correct(scenarios: &mut [ScenarioStandings]) -> usize {
    let tests = || scenarios.iter().flat_map(|scenario| &scenario.pairs);
    let p_values: Vec<f64> = tests().map(|test| test.p).collect();
    // p values of tests are from 0 to 1, so this cannot fail; without a correction nothing would be claimed.
    let corrected = holm(&p_values).unwrap_or_else(|_| vec![1.0; p_values.len()]);
    let tests = scenarios.iter_mut().flat_map(|scenario| &mut scenario.pairs);
    for (test, p_corrected) in tests.zip(corrected) {
        test.p_corrected = p_corrected;
        let better = if test.rank_biserial > 0.0 { test.first } else { test.second };
        test.better = (p_corrected <= SIGNIFICANCE).then_some(better);
    }
    p_values.len()
}
