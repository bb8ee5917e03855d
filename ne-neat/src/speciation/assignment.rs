use super::Species;
use crate::{Compatibility, NeatGenome};
use ne_core::RandomStream;
use rand::RngExt;

/// Divides a generation into species; those that get no members die out.
///
/// Each species is represented by a random member of the generation before. A genome joins the oldest species whose
/// representative is nearer than the threshold; if there is none, it founds one and represents it.
///
/// Source: Stanley & Miikkulainen, 2002, section 3.3.
pub(crate) fn assign(
    species: &mut Vec<Species>,
    next_id: &mut u64,
    previous: &[NeatGenome],
    generation: &[NeatGenome],
    (compatibility, threshold): (&Compatibility, f64),
    stream: &mut RandomStream,
) {
    let represent = |species: &Species| &previous[species.members[stream.random_range(0..species.members.len())]];
    let mut representatives: Vec<&NeatGenome> = species.iter().map(represent).collect();
    species.iter_mut().for_each(|species| species.members.clear());
    for (index, genome) in generation.iter().enumerate() {
        let is_near = |representative: &&NeatGenome| compatibility.is_near(genome, representative, threshold);
        let home = representatives.iter().position(is_near).unwrap_or_else(|| {
            representatives.push(genome);
            species.push(Species::new(*next_id));
            *next_id += 1;
            species.len() - 1
        });
        species[home].members.push(index);
    }
    species.retain(|species| !species.members.is_empty());
}
