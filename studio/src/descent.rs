//! Where the members of a generation come from: species, families, parents.

use ne_core::{Fitness, Origin};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// What is known of one of a generation, besides its controller.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Member {
    /// Its fitness in training; `None` if it failed there.
    pub fitness: Option<Fitness>,
    /// Its species, or its family where there are none; `None` where nothing is known of either.
    pub group: Option<Group>,
    /// Its parents, the one it is most like first; `None` where nothing is known of them.
    pub descent: Option<Descent>,
}

/// What members have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Group {
    /// Their species.
    Species(u64),
    /// The founder that they are descended from.
    Family(u64),
}

/// Where a member comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Descent {
    /// How it came about.
    pub how: How,
    /// None of one that is new.
    pub parents: Vec<Parent>,
}

/// How a member came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum How {
    /// It was drawn, or taken over from another search.
    New,
    /// As a copy.
    Copy,
    /// It was bred.
    Bred,
}

/// A parent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parent {
    /// Its place in the generation before, the best first, from 1.
    pub rank: usize,
    /// Its fitness; `None` if it failed.
    pub fitness: Option<Fitness>,
}

impl Descent {
    /// `ranks` and `fitness`: of the generation before, in its order.
    pub(crate) fn new(origin: Origin, ranks: &[usize], fitness: &[Option<Fitness>]) -> Option<Self> {
        let how = match origin {
            Origin::New => How::New,
            Origin::Copy(_) => How::Copy,
            Origin::Child(_) => How::Bred,
        };
        let parent = |place: usize| Some(Parent { rank: *ranks.get(place)?, fitness: *fitness.get(place)? });
        Some(Self { how, parents: origin.parents().map(parent).collect::<Option<_>>()? })
    }
}

/// The places of a generation from its best to its worst: of equals the first.
pub(crate) fn best_first(fitness: &[Option<Fitness>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..fitness.len()).collect();
    order.sort_by_key(|&place| std::cmp::Reverse(fitness[place]));
    order
}

/// The rank of each place, from 1.
pub(crate) fn ranks(fitness: &[Option<Fitness>]) -> Vec<usize> {
    let mut ranks = vec![0; fitness.len()];
    for (rank, place) in (1..).zip(best_first(fitness)) {
        ranks[place] = rank;
    }
    ranks
}

/// Descent from a founder along first parents. Soon all are descended from one; then all found families anew, so that there is always
/// something to tell apart.
#[derive(Clone, Debug, Default)]
pub(crate) struct Families {
    of: Vec<u64>,
    founded: u64,
}

impl Families {
    /// The generation that follows; one without origins forgets them.
    pub(crate) fn next(&mut self, origins: &[Origin]) {
        let before = std::mem::take(&mut self.of);
        let inherited = |origin: &Origin| origin.parents().next().and_then(|parent| before.get(parent).copied());
        let inherited: Vec<Option<u64>> = origins.iter().map(inherited).collect();
        let different: BTreeSet<Option<u64>> = inherited.iter().copied().collect();
        let is_one_family = different.len() == 1;
        for family in inherited {
            let family = family.filter(|_| !is_one_family).unwrap_or_else(|| {
                self.founded += 1;
                self.founded
            });
            self.of.push(family);
        }
    }

    /// The family of the one at this place.
    pub(crate) fn of(&self, place: usize) -> Option<Group> {
        self.of.get(place).copied().map(Group::Family)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fitness(values: &[f64]) -> Vec<Option<Fitness>> {
        values.iter().map(|&value| Fitness::new(value).ok()).collect()
    }

    #[test]
    fn families_are_inherited_until_there_is_one_left() {
        let mut families = Families::default();
        families.next(&[Origin::New; 3]);
        assert_eq!(families.of, [1, 2, 3]);
        families.next(&[Origin::Copy(1), Origin::Child([1, 0]), Origin::New]);
        assert_eq!(families.of, [2, 2, 4]);
        families.next(&[Origin::Copy(1), Origin::Child([1, 2]), Origin::Child([0, 0])]);
        assert_eq!(families.of, [5, 6, 7], "all of family 2 would be of one colour");
        families.next(&[]);
        assert_eq!(families.of(0), None);
    }

    #[test]
    fn parents_are_told_by_their_ranks() {
        let before = fitness(&[1.0, 3.0, 2.0]);
        let ranks = ranks(&before);
        assert_eq!(ranks, [3, 1, 2]);
        let descent = |origin| {
            Descent::new(origin, &ranks, &before)
                .map(|descent| descent.parents.into_iter().map(|parent| parent.rank).collect::<Vec<_>>())
        };
        assert_eq!(descent(Origin::New), Some(vec![]));
        assert_eq!(descent(Origin::Copy(1)), Some(vec![1]));
        assert_eq!(descent(Origin::Child([0, 2])), Some(vec![3, 2]));
        assert_eq!(descent(Origin::Child([2, 2])), Some(vec![2]));
        assert_eq!(descent(Origin::Child([0, 3])), None, "nothing is known of the generation before");
    }
}
