use crate::{Evaluation, Fitness, Genome, Seed};
use serde::{Deserialize, Serialize};

/// A search: asks for the evaluation of genomes, is told the results, and asks again.
///
/// Conventional neuroevolution, NEAT and evolution strategies all stand behind this contract. The strategy *is* its
/// state: what it serialises to, settings included, is everything it needs to go on after a restart. One that can be
/// deserialised, with its genomes, can be [resumed](crate::Checkpoint::read).
///
/// An implementor owes:
/// - `ask` and `tell` take turns, `ask` first; `tell` gets one evaluation for each genome asked, in the same order;
/// - chance comes only from the seed handed in, which differs from generation to generation, so that the state holds no
///   generator and `ask` after a save and a load gives the same genomes, also where it was asked for them before the save;
/// - a failed evaluation ranks below every fitness;
/// - no clock, no thread count, no iteration over a hash map: the same evaluations give the same bits.
///
/// Check yours with `check_strategy` of the [conformance kit](crate::conformance).
pub trait Strategy: Serialize + Send {
    /// What the strategy varies.
    type Genome: Genome;

    /// The name users choose it by: lower case, hyphens.
    fn name(&self) -> &str;

    /// The genomes of the next generation.
    fn ask(&mut self, seed: Seed) -> &[Self::Genome];

    /// The results of the genomes last asked. `seed` is the one `ask` had.
    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed);

    /// What the strategy can say of its own state after `tell` (mutation strength, number of species), for logs and
    /// reports. Same names in the same order each time.
    fn statistics(&self) -> Vec<Statistic> {
        Vec::new()
    }

    /// The species of the generation last told, in order of their ids, for strategies that have species.
    fn species(&self) -> Vec<SpeciesReport> {
        Vec::new()
    }

    /// The species of each individual of the generation last told, in the order asked, for strategies that have species.
    fn memberships(&self) -> Vec<u64> {
        Vec::new()
    }

    /// Where each individual of the generation last told comes from, in the order asked, for strategies that breed. Empty also where it
    /// is not known: no state keeps it, so that it is lost where a run is resumed between ask and tell.
    fn origins(&self) -> &[Origin] {
        &[]
    }

    /// The genome that the search would give as its answer now: of a search by a distribution its mean, in which the luck of single
    /// individuals averages out. `None`, the default: it has none, or none at the moment. It is a candidate where a champion
    /// selection [asks for it](crate::champion_selection::ChampionSelection::takes_recommendation).
    fn recommendation(&self) -> Option<Self::Genome> {
        None
    }

    /// The best compromises between several objectives after `tell`, for strategies that look for them: none
    /// [dominates](crate::pareto::dominates) another, and no two are equal in all objectives. From the best in the
    /// first objective to the worst. `None`, the default: the strategy knows no front.
    fn front(&self) -> Option<Vec<FrontPoint<'_, Self::Genome>>> {
        None
    }
}

/// A compromise between objectives that a [`Strategy`] has found.
#[derive(Debug, PartialEq)]
pub struct FrontPoint<'a, G> {
    /// The genome.
    pub genome: &'a G,
    /// Its fitness.
    pub fitness: Fitness,
    /// What it came to in each objective, all maximised.
    pub objectives: &'a [Fitness],
    /// The generation it was evaluated in, from 1: with its seed the task gives fitness and objectives again.
    pub generation: u64,
}

// By hand, since derived they ask that genomes can be copied, too.
impl<G> Clone for FrontPoint<'_, G> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<G> Copy for FrontPoint<'_, G> {}

/// Where an individual comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// It was drawn, or taken over from another search.
    New,
    /// It is a copy of the one at this place of the generation before.
    Copy(u32),
    /// It was bred from those at these places of the generation before: the same twice if it has one parent.
    Child([u32; 2]),
}

impl Origin {
    /// The places of its parents in the generation before, the one it is most like first.
    pub fn parents(self) -> impl Iterator<Item = usize> {
        let (first, second) = match self {
            Self::New => (None, None),
            Self::Copy(place) => (Some(place), None),
            Self::Child([first, second]) => (Some(first), Some(second).filter(|_| second != first)),
        };
        first.into_iter().chain(second).map(|place| place as usize)
    }
}

/// One species of a generation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpeciesReport {
    /// Its id, the same over all generations; ids are not used again.
    pub id: u64,
    /// How many individuals it has.
    pub size: u64,
    /// Its best fitness in this generation; `None` if all its evaluations failed.
    pub best: Option<Fitness>,
}

/// A named number a [`Strategy`] reports.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistic {
    /// Lower case, underscores, unit last: `mutation_deviation`.
    pub name: String,
    /// The value in this generation; finite.
    pub value: f64,
}

impl Statistic {
    /// A statistic.
    pub fn new(name: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), value }
    }
}
