//! A generation, as it is kept to be shown.

use crate::{
    Entrant,
    descent::{Descent, Families, Group, Member, best_first, ranks},
};
use gambol_runs::{
    config::RunConfig,
    run_folder::{GalleryKind, RunFolder},
    strategies::{AnyGenome, AnyStrategy},
};
use ne_core::{Evaluation, Fitness, Generation, Genome, Origin, Seed, Strategy};
use std::sync::Arc;

/// A larger generation is dropped once the next is there: its parents cannot be shown.
const MOST_WITH_PARENTS: usize = 10_000;

/// A generation as it was told to the strategy.
pub(crate) struct Told {
    number: u64,
    seed: Seed,
    individuals: Arc<Individuals>,
    /// Empty: they have none.
    species: Vec<u64>,
    families: Families,
    origins: Vec<Origin>,
    before: Option<Arc<Individuals>>,
}

struct Individuals {
    genomes: Vec<AnyGenome>,
    fitness: Vec<Option<Fitness>>,
}

/// Those of a generation, the best first.
pub(crate) struct Population {
    pub(crate) generation: u64,
    pub(crate) seed: Seed,
    pub(crate) entrants: Vec<Entrant>,
    /// The run, or the stage that they are of.
    pub(crate) config: RunConfig,
    /// What the entrants were made of; `None` where they are from a file.
    told: Option<Arc<Told>>,
}

impl Told {
    /// `before`: the generation that was told before it in the same stage, if there was one.
    pub(crate) fn new(generation: &Generation<'_, AnyStrategy>, before: Option<&Self>) -> Self {
        let number = generation.report.generation;
        let before = before.filter(|before| before.number + 1 == number);
        let origins = generation.strategy.origins().to_vec();
        let mut families = before.map(|before| before.families.clone()).unwrap_or_default();
        families.next(&origins);
        let individuals = Individuals {
            genomes: generation.genomes.to_vec(),
            fitness: generation.evaluations.iter().map(Evaluation::fitness).collect(),
        };
        let is_kept = |before: &&Self| before.individuals.genomes.len() <= MOST_WITH_PARENTS;
        Self {
            number,
            seed: generation.seed.generation(number),
            species: generation.strategy.memberships(),
            before: before.filter(is_kept).map(|before| Arc::clone(&before.individuals)),
            individuals: Arc::new(individuals),
            families,
            origins,
        }
    }

    /// The ranks of the generation before; empty if it is not known.
    fn ranks_before(&self) -> Vec<usize> {
        self.before.as_ref().map(|before| ranks(&before.fitness)).unwrap_or_default()
    }

    fn entrant(&self, place: usize, ranks_before: &[usize]) -> Entrant {
        let network = self.individuals.genomes[place].express();
        Entrant { network, member: self.member(place, ranks_before) }
    }

    fn member(&self, place: usize, ranks_before: &[usize]) -> Member {
        let species = self.species.get(place).copied().map(Group::Species);
        let descent = match (self.origins.get(place), &self.before) {
            (Some(&origin), Some(before)) => Descent::new(origin, ranks_before, &before.fitness),
            (Some(&origin), None) => Descent::new(origin, &[], &[]),
            (None, _) => None,
        };
        Member { fitness: self.individuals.fitness[place], group: species.or_else(|| self.families.of(place)), descent }
    }
}

impl Population {
    /// Of a generation that was told here.
    pub(crate) fn of(told: Arc<Told>, config: RunConfig) -> Self {
        let ranks = told.ranks_before();
        let order = best_first(&told.individuals.fitness);
        let entrants = order.into_iter().map(|place| told.entrant(place, &ranks)).collect();
        Self { generation: told.number, seed: told.seed, entrants, config, told: Some(told) }
    }

    /// The latest that is kept in a run's gallery.
    pub(crate) fn read(folder: &RunFolder, config: RunConfig) -> Option<Self> {
        let gallery = folder.read_gallery().ok()?;
        let entry = gallery.into_iter().rev().find(|entry| entry.kind == GalleryKind::Population)?;
        let fitness: Vec<Option<Fitness>> = entry.members.iter().map(|member| member.fitness).collect();
        let entrant = |place: usize| {
            let member = Member { fitness: fitness[place], ..Member::default() };
            Entrant { network: entry.members[place].network.clone(), member }
        };
        let entrants = best_first(&fitness).into_iter().map(entrant).collect();
        let seed = Seed::of_run(config.seed).generation(entry.generation);
        Some(Self { generation: entry.generation, seed, entrants, config, told: None })
    }

    /// The one at this place, and its parents; none of one whose parents are not known.
    pub(crate) fn family(&self, place: usize) -> Option<Vec<Entrant>> {
        let told = self.told.as_ref()?;
        let before = told.before.as_ref()?;
        let place = *best_first(&told.individuals.fitness).get(place)?;
        let mut family = vec![told.entrant(place, &told.ranks_before())];
        let parent = |place: usize| {
            let member = Member { fitness: *before.fitness.get(place)?, ..Member::default() };
            Some(Entrant { network: before.genomes.get(place)?.express(), member })
        };
        family.extend(told.origins.get(place)?.parents().filter_map(parent));
        Some(family)
    }
}
