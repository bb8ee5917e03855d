//! Explicit fitness sharing: how many children each species may have.

use super::{FitnessBaseline, SpeciationSettings, Species};
use ne_core::Fitness;
use std::cmp::Reverse;

/// The indices of the species that breed, best first.
///
/// Those that stagnate do not, unless they are among the protected. When the whole population stagnates, only the best
/// few do.
pub(crate) fn breeders(
    species: &[Species],
    scores: &[Option<Fitness>],
    population_stagnation: u64,
    settings: &SpeciationSettings,
) -> Vec<usize> {
    let mut order: Vec<usize> = (0..species.len()).collect();
    order.sort_by_key(|&index| Reverse(species[index].champion_score(scores)));
    let most = match settings.population_stagnation {
        Some(limit) if population_stagnation > 0 && population_stagnation.is_multiple_of(limit.generations) => {
            limit.species
        }
        _ => species.len(),
    };
    let may_breed = |(rank, &index): (usize, &usize)| {
        let breeds = rank < settings.protected || species[index].stagnation < settings.stagnation;
        breeds.then_some(index)
    };
    order.iter().enumerate().filter_map(may_breed).take(most).collect()
}

/// The number of children of each breeding species, `population` in all.
///
/// The fitness of an individual is divided by the size of its species, so a species' share is the mean fitness of its
/// members. Fractions go to the largest remainders, of equals to the better species. Of the protected species each has
/// at least one child, at the expense of the species with most.
///
/// Source: Stanley & Miikkulainen, 2002, equation 2; Goldberg & Richardson, *Genetic Algorithms with Sharing for
/// Multimodal Function Optimization*, ICGA 1987.
pub(crate) fn offspring(
    breeders: &[usize],
    species: &[Species],
    scores: &[Option<Fitness>],
    population: usize,
    settings: &SpeciationSettings,
) -> Vec<usize> {
    let shares = shares(breeders, species, scores, settings.baseline);
    let mut children: Vec<usize> = shares.iter().map(|share| (share * population as f64) as usize).collect();
    let missing = population.saturating_sub(children.iter().sum());
    let mut by_remainder: Vec<usize> = (0..breeders.len()).collect();
    let remainder = |index: usize| shares[index] * population as f64 - children[index] as f64;
    by_remainder.sort_by(|&a, &b| remainder(b).total_cmp(&remainder(a)));
    by_remainder.iter().cycle().take(missing).for_each(|&index| children[index] += 1);
    for protected in 0..settings.protected.min(children.len()) {
        if children[protected] == 0 {
            let most = (0..children.len()).rev().max_by_key(|&index| children[index]).unwrap_or(protected);
            children[most] -= 1;
            children[protected] = 1;
        }
    }
    children
}

/// The share of each breeding species in the next generation; 1 in all, up to rounding.
fn shares(breeders: &[usize], species: &[Species], scores: &[Option<Fitness>], baseline: FitnessBaseline) -> Vec<f64> {
    let fitnesses = || scores.iter().flatten().map(|fitness| fitness.get());
    let lowest = fitnesses().fold(f64::INFINITY, f64::min);
    let floor = match baseline {
        FitnessBaseline::Zero => lowest.min(0.0),
        FitnessBaseline::Worst => lowest,
    };
    // As a fraction of the greatest, halved, so that neither differences nor sums overflow.
    let scale = fitnesses().fold(0.0, |greatest: f64, fitness| greatest.max(fitness.abs()));
    let above = |fitness: Fitness| 0.5 * (fitness.get() / scale) - 0.5 * (floor / scale);
    let mean = |&index: &usize| {
        let members = &species[index].members;
        let sum: f64 = members.iter().filter_map(|&member| scores[member]).map(above).sum();
        sum / members.len() as f64
    };
    let means: Vec<f64> = breeders.iter().map(mean).collect();
    let total: f64 = means.iter().sum();
    // No individual is better than the worst: all species have the same share.
    let equal = 1.0 / breeders.len() as f64;
    means.iter().map(|mean| if total > 0.0 { mean / total } else { equal }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NeatSettings, PopulationStagnation};
    use proptest::prelude::*;

    fn settings(baseline: FitnessBaseline) -> SpeciationSettings {
        SpeciationSettings { baseline, protected: 1, ..NeatSettings::stanley_2002().speciation }
    }

    fn score(fitness: f64) -> Option<Fitness> {
        Fitness::new(fitness).ok()
    }

    /// Species of these fitnesses; NaN is a failed evaluation.
    fn species(fitnesses: &[&[f64]]) -> (Vec<Species>, Vec<Option<Fitness>>) {
        let scores: Vec<_> = fitnesses.concat().into_iter().map(score).collect();
        let (mut all, mut next) = (Vec::new(), 0);
        for (id, members) in (1..).zip(fitnesses) {
            let members = next..next + members.len();
            next = members.end;
            let mut species = Species { members: members.collect(), ..Species::new(id) };
            species.tell(&scores);
            all.push(species);
        }
        (all, scores)
    }

    fn children(fitnesses: &[&[f64]], population: usize, baseline: FitnessBaseline) -> Vec<usize> {
        let (species, scores) = species(fitnesses);
        let everyone: Vec<usize> = (0..species.len()).collect();
        offspring(&everyone, &species, &scores, population, &settings(baseline))
    }

    #[test]
    fn species_share_by_the_mean_fitness_of_their_members() {
        use FitnessBaseline::{Worst, Zero};
        assert_eq!(children(&[&[3.0, 5.0], &[2.0], &[1.0, 2.0, 3.0]], 16, Zero), [8, 4, 4]);
        assert_eq!(children(&[&[3.0, 5.0], &[2.0], &[1.0, 2.0, 3.0]], 10, Worst), [6, 2, 2]);
        // Negative: counted from the lowest, -2, either way.
        assert_eq!(children(&[&[4.0], &[-2.0, 2.0]], 8, Zero), [6, 2]);
        // A failed evaluation counts as 0.
        assert_eq!(children(&[&[4.0, f64::NAN], &[2.0]], 8, Zero), [4, 4]);
        // Largest remainders, 10 · (5, 3, 2)/10 of 7: 3.5, 2.1, 1.4.
        assert_eq!(children(&[&[5.0], &[3.0], &[2.0]], 7, Zero), [4, 2, 1]);
        // No individual is better than another.
        assert_eq!(children(&[&[f64::NAN], &[f64::NAN; 3]], 4, Zero), [2, 2]);
        assert_eq!(children(&[&[7.0; 2], &[7.0; 4]], 4, Worst), [2, 2]);
    }

    #[test]
    fn the_best_species_has_a_child_even_without_a_share() {
        assert_eq!(children(&[&[1.0, -9.0, -9.0, -9.0, -9.0], &[0.9]], 3, FitnessBaseline::Zero), [1, 2]);
    }

    #[test]
    fn stagnant_species_do_not_breed_unless_they_are_the_best() {
        let (mut all, scores) = species(&[&[1.0], &[3.0], &[2.0]]);
        let settings = settings(FitnessBaseline::Zero);
        assert_eq!(breeders(&all, &scores, 0, &settings), [1, 2, 0]);
        all.iter_mut().for_each(|species| species.stagnation = 15);
        assert_eq!(breeders(&all, &scores, 0, &settings), [1]);
        all[0].stagnation = 14;
        assert_eq!(breeders(&all, &scores, 0, &settings), [1, 0]);
    }

    #[test]
    fn only_the_best_species_breed_when_the_population_stagnates() {
        let (all, scores) = species(&[&[1.0], &[3.0], &[2.0]]);
        let population_stagnation = Some(PopulationStagnation { generations: 20, species: 2 });
        let settings = SpeciationSettings { population_stagnation, ..settings(FitnessBaseline::Zero) };
        for (stagnation, expected) in [(0, 3), (19, 3), (20, 2), (21, 3), (40, 2)] {
            assert_eq!(breeders(&all, &scores, stagnation, &settings).len(), expected, "{stagnation}");
        }
    }

    proptest! {
        #[test]
        fn there_are_exactly_as_many_children_as_individuals(
            fitnesses in proptest::collection::vec(proptest::collection::vec(proptest::num::f64::ANY, 1..6), 1..9),
            population in 9..200usize, protected in 1..9usize, worst in proptest::bool::ANY,
        ) {
            let slices: Vec<&[f64]> = fitnesses.iter().map(Vec::as_slice).collect();
            let (all, scores) = species(&slices);
            let baseline = if worst { FitnessBaseline::Worst } else { FitnessBaseline::Zero };
            let settings = SpeciationSettings { protected, ..settings(baseline) };
            let breeders = breeders(&all, &scores, 0, &settings);
            let children = offspring(&breeders, &all, &scores, population, &settings);
            prop_assert_eq!(children.iter().sum::<usize>(), population);
            prop_assert!(children.iter().take(protected).all(|&children| children > 0), "{:?}", children);
        }
    }
}
