//! Choosing a run's champion by a second evaluation, where the worlds of the search vary.

use crate::{Candidate, Champion, Evaluation, Fitness, Genome, Seed, SettingError, TieredFitness, champion::ranking};
use serde::{Deserialize, Serialize};
use std::{cmp::Reverse, collections::BTreeSet, fmt};

/// Judges individuals, all of them in one and the same world.
///
/// Where each generation is evaluated in a world of its own, the best fitness ever is that of the luckiest world. With a
/// champion selection ([`Evolution::with_champion_selection`](crate::Evolution::with_champion_selection)) the best of each
/// generation, or of a [group](ReEvaluations::group) of them, become [`Candidate`]s. A [re-evaluation](ReEvaluations) compares them
/// with each other and with the champion.
///
/// An implementor owes: one evaluation for each candidate, in order, and the same ones whenever it is asked again. What a
/// champion selection spends counts towards no budget: it changes nothing in what is searched.
pub trait ChampionSelection<G: Genome>: Send + Sync {
    /// The seed of the champion selection's world: with it a champion's fitness can be had again.
    fn seed(&self) -> Seed;

    /// Whether what the strategy [recommends](crate::Strategy::recommendation) is a candidate, too; no by default. It is worth its
    /// evaluation where what single individuals earn is largely luck.
    fn takes_recommendation(&self) -> bool {
        false
    }

    /// Evaluates the candidates. Only one that is better than the present champion, whose fitness is given, can take its place.
    fn judge(&self, candidates: &[G], champion: Option<TieredFitness>) -> ReEvaluation;
}

/// What a champion selection found.
#[derive(Clone, Debug, PartialEq)]
pub struct ReEvaluation {
    /// An evaluation for each candidate, in order.
    pub evaluations: Vec<Evaluation>,
    /// For each candidate a tier, for a champion selection that asks for more than fitness: a candidate with a higher tier is
    /// better than any with a lower one, whatever their fitness. Empty: all have tier 0.
    pub tiers: Vec<u8>,
    /// Whether two ways of evaluating that should agree did not, for a champion selection that has two. The evaluations are
    /// then those of the one that is to be trusted.
    pub diverged: bool,
}

/// How often candidates are re-evaluated, and how many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReEvaluations {
    /// After every so many generations at first; at least 1. From 8 times as many on half as often, from 16 times on a
    /// quarter, from 32 times on an eighth: after 10, 20, ... 80, 100, ... 160, 200, ... 320, 400, 480, ... The older a run,
    /// the less changes from one generation to the next; but re-evaluations do not die out, lest an old run keep the champion of
    /// its youth.
    pub every: u64,
    /// The best of each so many generations since the last re-evaluation is a candidate, too; from 16 times `every` on of each twice as
    /// many, from 32 times on of each four times as many. So no more than 2 × `every` / `group` of them ever wait, where
    /// `group` divides `every`. At least 1.
    pub group: u64,
    /// So many of the best of the generation just evaluated; at least 1.
    pub candidates: usize,
}

/// So many times the distance between re-evaluations doubles.
const RAREST: u32 = 3;

impl ReEvaluations {
    /// The generations between the last re-evaluation up to this generation, from 1, and the one before; `None` if this
    /// generation has no re-evaluation.
    pub(crate) fn span(&self, generation: u64) -> Option<u64> {
        let span = self.every.max(1) << self.doublings(generation);
        generation.is_multiple_of(span).then_some(span)
    }

    /// How often the distance between re-evaluations has doubled.
    fn doublings(&self, generation: u64) -> u32 {
        // The re-evaluation at 8, 16, 32 times `every` is the last of the closer ones.
        let age = (generation - 1) / self.every.max(1) / 8;
        age.checked_ilog2().map_or(0, |doublings| (doublings + 1).min(RAREST))
    }

    /// Keeps the best of a generation without a re-evaluation as a candidate, or of a [group](Self::group) of them.
    pub(crate) fn keep<G>(&self, waiting: &mut Vec<Candidate<G>>, candidate: Candidate<G>) {
        let group = self.group.max(1) << self.doublings(candidate.generation).saturating_sub(1);
        let group_of = |generation: u64| generation.div_ceil(group);
        match waiting.last_mut().filter(|last| group_of(last.generation) == group_of(candidate.generation)) {
            None => waiting.push(candidate),
            // Of equals the first.
            Some(last) if candidate.fitness > last.fitness => *last = candidate,
            Some(_) => {}
        }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        if self.every == 0 {
            return Err(SettingError::new("every", 0, "at least 1"));
        }
        if self.group == 0 {
            return Err(SettingError::new("group", 0, "at least 1"));
        }
        SettingError::check_at_least("candidates", self.candidates, 1)
    }
}

/// What came of a re-evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReEvaluationReport {
    /// How many were judged; an individual that was a candidate twice counts once.
    pub candidates: u64,
    /// The fitness, at the re-evaluation, of the best candidate; `None` if all failed. If it is better than the champion, it
    /// becomes champion.
    pub judged: Option<Fitness>,
    /// The fitness that the same individual had in its generation.
    pub trained: Option<Fitness>,
    /// Whether the champion selection's two ways of evaluating [diverged](ReEvaluation::diverged).
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub diverged: bool,
}

/// What came of a re-evaluation, and the best candidate as the champion it would make.
pub(crate) type ReEvaluated<G> = Result<(ReEvaluationReport, Option<Champion<G>>), WrongCount>;

/// A champion selection gave too many or too few evaluations, so that none can be told whose it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WrongCount {
    pub(crate) found: usize,
    pub(crate) expected: usize,
}

/// A champion selection with its rules.
pub(crate) struct ScheduledSelection<G> {
    pub(crate) re_evaluations: ReEvaluations,
    pub(crate) champion_selection: Box<dyn ChampionSelection<G>>,
}

impl<G> fmt::Debug for ScheduledSelection<G> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ScheduledSelection").field("re_evaluations", &self.re_evaluations).finish_non_exhaustive()
    }
}

impl<G: Genome> ScheduledSelection<G> {
    /// Evaluates each candidate once; gives the best as the champion it would make.
    pub(crate) fn re_evaluate(&self, candidates: &[Candidate<G>], champion: Option<TieredFitness>) -> ReEvaluated<G> {
        let _span = tracing::debug_span!("re-evaluation", candidates = candidates.len()).entered();
        let candidates = distinct(candidates);
        let genomes: Vec<G> = candidates.iter().map(|candidate| candidate.genome.clone()).collect();
        let ReEvaluation { evaluations, tiers, diverged } = self.champion_selection.judge(&genomes, champion);
        if evaluations.len() != genomes.len() {
            return Err(WrongCount { found: evaluations.len(), expected: genomes.len() });
        }
        let tier_of = |index: usize| tiers.get(index).copied().unwrap_or(0);
        // Of equals the first: the ranking has them in their order, and only a higher tier comes before it.
        let best = ranking(&evaluations).into_iter().min_by_key(|&(index, _)| Reverse(tier_of(index)));
        let champion = best.map(|(index, fitness)| Champion {
            genome: candidates[index].genome.clone(),
            fitness,
            generation: candidates[index].generation,
            seed: self.champion_selection.seed(),
            trained: candidates[index].fitness,
            tier: tier_of(index),
            diverged,
        });
        let (judged, trained) = (best.map(|(_, fitness)| fitness), champion.as_ref().and_then(|best| best.trained));
        Ok((ReEvaluationReport { candidates: genomes.len() as u64, judged, trained, diverged }, champion))
    }
}

/// The candidates without those whose genome is the same, to the byte, as that of an earlier one.
fn distinct<G: Genome>(candidates: &[Candidate<G>]) -> Vec<&Candidate<G>> {
    let mut seen = BTreeSet::new();
    let is_new =
        |candidate: &&Candidate<G>| serde_json::to_vec(&candidate.genome).is_ok_and(|bytes| seen.insert(bytes));
    candidates.iter().filter(is_new).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn re_evaluations_become_rarer_as_the_run_gets_older() {
        let re_evaluated = |every, generations| {
            let re_evaluations = ReEvaluations { every, group: 1, candidates: 1 };
            (1..=generations).filter(|&generation| re_evaluations.span(generation).is_some()).collect::<Vec<_>>()
        };
        let first = [10, 20, 30, 40, 50, 60, 70, 80, 100, 120, 140, 160, 200, 240, 280, 320, 400, 480, 560, 640];
        assert_eq!(re_evaluated(10, 719), first);
        assert_eq!(re_evaluated(1, 24), [1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24]);
        // Every generation lies in one span, and in no two.
        let spans = |generation| ReEvaluations { every: 3, group: 1, candidates: 1 }.span(generation);
        assert_eq!((1..=3 * 64).filter_map(spans).sum::<u64>(), 3 * 64);
        assert_eq!((10_000..20_000).filter_map(spans).max(), Some(24), "they do not die out");
    }
}
