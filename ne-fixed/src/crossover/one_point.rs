use super::Crossover;
use crate::Setting;
use ne_core::RandomStream;
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// One-point crossover: the genes up to a random point from the first parent, the rest from the second.
///
/// The point lies between two genes, each of these places with equal chance, so that both parents give at least one
/// gene. A single gene comes from the first parent.
///
/// Source: Holland, *Adaptation in Natural and Artificial Systems*, 1975.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OnePoint {}

impl Setting for OnePoint {}

impl Crossover for OnePoint {
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream) {
        let count = child.len();
        let point = if count > 1 { stream.random_range(1..count) } else { count };
        child[..point].copy_from_slice(&first[..point]);
        child[point..].copy_from_slice(&second[point..]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{changes, child, origins, parents};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_origin_changes_once(count in 2..200usize, seed: u64) {
            let origins = origins(&OnePoint {}, count, seed);
            prop_assert_eq!(changes(&origins), 1);
            prop_assert!(!origins[0]);
        }

        #[test]
        fn genes_keep_their_place((first, second) in parents(), seed: u64) {
            for (index, gene) in child(&OnePoint {}, &first, &second, seed).into_iter().enumerate() {
                prop_assert!(gene == first[index] || gene == second[index]);
            }
        }
    }

    #[test]
    fn every_point_is_chosen_equally_often() {
        let mut counts = [0; 5];
        (0..5000).for_each(|seed| {
            let point = origins(&OnePoint {}, 5, seed).iter().position(|&second| second).expect("a change");
            counts[point] += 1;
        });
        assert_eq!(counts[0], 0);
        assert!(counts[1..].iter().all(|count| (1100..1400).contains(count)), "{counts:?}");
    }
}
