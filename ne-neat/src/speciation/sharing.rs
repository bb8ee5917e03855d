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
    // Nobody is better than the worst: all species alike.
    let equal = 1.0 / breeders.len() as f64;
    means.iter().map(|mean| if total > 0.0 { mean / total } else { equal }).collect()
}
