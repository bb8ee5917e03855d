use super::Crossover;
use crate::Setting;
use ne_core::RandomStream;
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Whole arithmetic crossover: the child lies at a random point of the line between its parents, the same share of the
/// second parent in each gene.
///
/// It averages, so a population that uses nothing else contracts.
///
/// Source: Michalewicz, *Genetic Algorithms + Data Structures = Evolution Programs*, 1992.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Arithmetic {}

impl Setting for Arithmetic {}

impl Crossover for Arithmetic {
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream) {
        let share: f32 = stream.random();
        for ((gene, &one), &other) in child.iter_mut().zip(first).zip(second) {
            // Limited, since rounding may leave the line.
            *gene = (one + share * (other - one)).max(one.min(other)).min(one.max(other));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{child, parents};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn genes_lie_between_the_parents((first, second) in parents(), seed: u64) {
            for (index, gene) in child(&Arithmetic {}, &first, &second, seed).into_iter().enumerate() {
                prop_assert!(first[index].min(second[index]) <= gene && gene <= first[index].max(second[index]));
            }
        }

        #[test]
        fn all_genes_have_the_same_share(count in 1..200usize, seed: u64) {
            let child = child(&Arithmetic {}, &vec![0.0; count], &vec![1.0; count], seed);
            prop_assert!(child.iter().all(|&gene| gene == child[0]));
        }
    }

    #[test]
    fn the_share_is_uniform() {
        let shares: f32 = (0..2000).map(|seed| child(&Arithmetic {}, &[0.0], &[1.0], seed)[0]).sum();
        assert!((shares / 2000.0 - 0.5).abs() < 0.03, "{shares}");
    }
}
