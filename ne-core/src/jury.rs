use crate::{Champion, Evaluation, Fitness, Genome, Seed, SettingError};
use serde::{Deserialize, Serialize};
use std::{cmp::Reverse, collections::BTreeSet, fmt};

/// Judges individuals, all of them in one and the same world.
///
/// Where each generation is evaluated in a world of its own, the best fitness ever is that of the luckiest world. With a
/// jury ([`Evolution::with_jury`](crate::Evolution::with_jury)) the best of each generation become [`Finalist`]s
/// instead, and at every [hearing](Hearings) the best of them before the jury takes on the champion.
///
/// An implementor owes: one evaluation for each finalist, in order, and the same ones whenever it is asked again. What a
/// jury spends counts towards no budget: it changes nothing in what is searched.
pub trait Jury<G: Genome>: Send + Sync {
    /// The seed of the jury's world: with it a champion's fitness can be had again.
    fn seed(&self) -> Seed;

    /// Evaluates the finalists. Only one that stands above the `standing` champion can become champion.
    fn judge(&self, finalists: &[G], standing: Option<Standing>) -> Judgement;
}

/// Where an individual stands before a jury: by its grade, and among those of one grade by its fitness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Standing {
    /// See [`Judgement::grades`].
    pub grade: u8,
    /// The fitness before the jury.
    pub fitness: Fitness,
}

/// What a jury found.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// An evaluation for each finalist, in order.
    pub evaluations: Vec<Evaluation>,
    /// For each finalist a grade, for a jury that asks for more than fitness: whoever has the higher grade stands above
    /// all with a lower one, whatever their fitness. Empty: all have grade 0.
    pub grades: Vec<u8>,
    /// Whether two ways of evaluating that should agree did not, for a jury that has two. The evaluations are then those
    /// of the one that is to be trusted.
    pub parted: bool,
}

/// How often a jury sits, and how many it hears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hearings {
    /// After every so many generations at first; at least 1. From 8 times as many on half as often, from 16 times on a
    /// quarter, from 32 times on an eighth: after 10, 20, ... 80, 100, ... 160, 200, ... 320, 400, 480, ... The older a run,
    /// the less changes from one generation to the next; but hearings do not die out, lest an old run keep the champion of
    /// its youth.
    pub every: u64,
    /// So many of the best of the generation just evaluated are heard, with the best of each generation since the last
    /// hearing; at least 1.
    pub finalists: usize,
}

/// So many times the distance between hearings doubles.
const RAREST: u32 = 3;

impl Hearings {
    /// The generations between the last hearing up to this generation, from 1, and the one before; `None` if this
    /// generation has no hearing.
    pub(crate) fn span(&self, generation: u64) -> Option<u64> {
        let every = self.every.max(1);
        // The hearing at 8, 16, 32 times `every` is the last of the closer ones.
        let age = (generation - 1) / every / 8;
        let span = every << age.checked_ilog2().map_or(0, |doublings| (doublings + 1).min(RAREST));
        generation.is_multiple_of(span).then_some(span)
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        if self.every == 0 {
            return Err(SettingError::new("every", 0, "at least 1"));
        }
        SettingError::check_at_least("finalists", self.finalists, 1)
    }
}

/// An individual that waits for the next hearing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Finalist<G> {
    /// The genome.
    pub genome: G,
    /// The fitness it had in its generation.
    pub fitness: Fitness,
    /// The generation it was evaluated in, from 1.
    pub generation: u64,
}

impl<G> Finalist<G> {
    /// The same finalist with its genome as another type.
    pub fn map<H>(self, convert: impl FnOnce(G) -> H) -> Finalist<H> {
        let Self { genome, fitness, generation } = self;
        Finalist { genome: convert(genome), fitness, generation }
    }
}

/// What came of a hearing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HearingReport {
    /// How many were judged; an individual that was a finalist twice counts once.
    pub finalists: u64,
    /// The fitness before the jury of the one who stood highest; `None` if all failed. If it stands above the champion, it
    /// is champion.
    pub judged: Option<Fitness>,
    /// The fitness that the same individual had in its generation.
    pub trained: Option<Fitness>,
    /// Whether the jury's two ways of evaluating [parted](Judgement::parted).
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub parted: bool,
}

/// A jury with its rules.
pub(crate) struct Court<G> {
    pub(crate) hearings: Hearings,
    pub(crate) jury: Box<dyn Jury<G>>,
}

impl<G> fmt::Debug for Court<G> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Court").field("hearings", &self.hearings).finish_non_exhaustive()
    }
}

impl<G: Genome> Court<G> {
    /// Hears each finalist once; gives the best as the champion it would make, if it beats the standing one.
    pub(crate) fn hear(
        &self,
        finalists: &[Finalist<G>],
        standing: Option<Standing>,
    ) -> (HearingReport, Option<Champion<G>>) {
        let finalists = distinct(finalists);
        let genomes: Vec<G> = finalists.iter().map(|finalist| finalist.genome.clone()).collect();
        let Judgement { evaluations, grades, parted } = self.jury.judge(&genomes, standing);
        if evaluations.len() != genomes.len() {
            // Nobody can say which belongs to whom.
            tracing::error!("the jury gave {} evaluations for {} finalists", evaluations.len(), genomes.len());
        }
        let grade_of = |index: usize| grades.get(index).copied().unwrap_or(0);
        // Of equals the first: the ranking has them in their order, and only a higher grade comes before it.
        let best = ranking(&evaluations).into_iter().min_by_key(|&(index, _)| Reverse(grade_of(index)));
        let best = best.filter(|_| evaluations.len() == genomes.len());
        let champion = best.map(|(index, fitness)| Champion {
            genome: finalists[index].genome.clone(),
            fitness,
            generation: finalists[index].generation,
            seed: self.jury.seed(),
            trained: Some(finalists[index].fitness),
            grade: grade_of(index),
            parted,
        });
        let (judged, trained) = (best.map(|(_, fitness)| fitness), champion.as_ref().and_then(|best| best.trained));
        (HearingReport { finalists: genomes.len() as u64, judged, trained, parted }, champion)
    }
}

/// The finalists without those whose genome is the same, to the byte, as that of an earlier one.
fn distinct<G: Genome>(finalists: &[Finalist<G>]) -> Vec<&Finalist<G>> {
    let mut seen = BTreeSet::new();
    let is_new = |finalist: &&Finalist<G>| serde_json::to_vec(&finalist.genome).is_ok_and(|bytes| seen.insert(bytes));
    finalists.iter().filter(is_new).collect()
}

/// Index and fitness of those that did not fail, the best first, of equals the first.
pub(crate) fn ranking(evaluations: &[Evaluation]) -> Vec<(usize, Fitness)> {
    let fitnesses = evaluations.iter().enumerate();
    let mut ranking: Vec<_> =
        fitnesses.filter_map(|(index, evaluation)| Some((index, evaluation.fitness()?))).collect();
    // A stable sort leaves equals in their order.
    ranking.sort_by_key(|&(_, fitness)| std::cmp::Reverse(fitness));
    ranking
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hearings_become_rarer_as_the_run_gets_older() {
        let heard = |every, generations| {
            let hearings = Hearings { every, finalists: 1 };
            (1..=generations).filter(|&generation| hearings.span(generation).is_some()).collect::<Vec<_>>()
        };
        let first = [10, 20, 30, 40, 50, 60, 70, 80, 100, 120, 140, 160, 200, 240, 280, 320, 400, 480, 560, 640];
        assert_eq!(heard(10, 719), first);
        assert_eq!(heard(1, 24), [1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24]);
        // Every generation lies in one span, and in no two.
        let spans = |generation| Hearings { every: 3, finalists: 1 }.span(generation);
        assert_eq!((1..=3 * 64).filter_map(spans).sum::<u64>(), 3 * 64);
        assert_eq!((10_000..20_000).filter_map(spans).max(), Some(24), "they do not die out");
    }
}
