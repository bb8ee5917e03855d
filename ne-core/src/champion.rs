use crate::{Evaluation, Fitness, Seed};
use serde::{Deserialize, Serialize};

/// The best individual of a run: the one with the highest fitness, of equals the first. With a
/// [champion selection](crate::champion_selection) the fitness that counts is that of its re-evaluation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Champion<G> {
    /// The genome.
    pub genome: G,
    /// Its fitness.
    pub fitness: Fitness,
    /// The generation it was evaluated in, or recommended after, from 1; 0 for one from before the run.
    pub generation: u64,
    /// The seed it was evaluated with: with it the task, or the champion selection, gives the fitness again.
    pub seed: Seed,
    /// The fitness it had in its generation, if a champion selection has judged it since.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trained: Option<Fitness>,
    /// Whether the champion selection's two ways of evaluating [diverged](crate::champion_selection::ReEvaluation::diverged) at its re-evaluation.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub diverged: bool,
    /// The [tier](crate::champion_selection::ReEvaluation::tiers) the champion selection gave it; 0 without a champion selection.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub tier: u8,
}

impl<G> Champion<G> {
    /// Its fitness with the tier, by which champions are compared.
    pub fn standing(&self) -> TieredFitness {
        TieredFitness { tier: self.tier, fitness: self.fitness }
    }

    /// The same champion with its genome as another type.
    pub fn map<H>(self, convert: impl FnOnce(G) -> H) -> Champion<H> {
        let Self { genome, fitness, generation, seed, trained, diverged, tier } = self;
        Champion { genome: convert(genome), fitness, generation, seed, trained, diverged, tier }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_zero(tier: &u8) -> bool {
    *tier == 0
}

/// Fitness for a champion selection: the tier counts first, and within a tier the fitness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TieredFitness {
    /// See [`ReEvaluation::tiers`](crate::champion_selection::ReEvaluation::tiers).
    pub tier: u8,
    /// The fitness at the re-evaluation.
    pub fitness: Fitness,
}

/// An individual that waits for the next re-evaluation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Candidate<G> {
    /// The genome.
    pub genome: G,
    /// The fitness it had in its generation; `None` for one that was not evaluated there.
    pub fitness: Option<Fitness>,
    /// The generation it was evaluated in, or recommended after, from 1; 0 for [one from before the
    /// run](crate::Evolution::with_candidate).
    pub generation: u64,
}

impl<G> Candidate<G> {
    /// The same candidate with its genome as another type.
    pub fn map<H>(self, convert: impl FnOnce(G) -> H) -> Candidate<H> {
        let Self { genome, fitness, generation } = self;
        Candidate { genome: convert(genome), fitness, generation }
    }
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
