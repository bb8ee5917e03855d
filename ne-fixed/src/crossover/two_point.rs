use super::Crossover;
use crate::Setting;
use ne_core::RandomStream;
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Two-point crossover: the genes between two random points from the second parent, the rest from the first.
///
/// Both points are drawn uniformly from the places before, between and after the genes; if they fall together the child
/// is a copy of the first parent. Unlike with one point, first and last genes are not torn apart more than neighbours
/// in a ring are.
///
/// Source: De Jong, *An Analysis of the Behavior of a Class of Genetic Adaptive Systems*, 1975.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TwoPoint {}

impl Setting for TwoPoint {}

impl Crossover for TwoPoint {
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream) {
        let count = child.len();
        let (one, other) = (stream.random_range(0..=count), stream.random_range(0..=count));
        let between = one.min(other)..one.max(other);
        child.copy_from_slice(first);
        child[between.clone()].copy_from_slice(&second[between]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{changes, child, origins, parents};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_origin_changes_at_most_twice(count in 1..200usize, seed: u64) {
            let origins = origins(&TwoPoint {}, count, seed);
            prop_assert!(changes(&origins) <= 2);
            prop_assert!(origins.iter().filter(|&&second| second).count() == 0 || changes(&origins) > 0
                || origins.iter().all(|&second| second));
        }

        #[test]
        fn genes_keep_their_place((first, second) in parents(), seed: u64) {
            for (index, gene) in child(&TwoPoint {}, &first, &second, seed).into_iter().enumerate() {
                prop_assert!(gene == first[index] || gene == second[index]);
            }
        }
    }

    #[test]
    fn a_third_comes_from_the_second_parent() {
        let genes: usize =
            (0..2000).map(|seed| origins(&TwoPoint {}, 100, seed).iter().filter(|&&second| second).count()).sum();
        assert!((genes as f64 / 2000.0 - 100.0 / 3.0).abs() < 2.0, "{genes}");
    }
}
