use super::Crossover;
use crate::Setting;
use ne_core::RandomStream;
use rand::Rng;
use serde::{Deserialize, Serialize};

/// Uniform crossover: each gene from either parent with equal chance, independently.
///
/// Source: Syswerda, *Uniform Crossover in Genetic Algorithms*, ICGA 1989.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UniformCrossover {}

impl Setting for UniformCrossover {}

impl Crossover for UniformCrossover {
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream) {
        child.copy_from_slice(first);
        // One random bit a gene.
        for (genes, others) in child.chunks_mut(32).zip(second.chunks(32)) {
            let bits = stream.next_u32();
            for (index, (gene, &other)) in genes.iter_mut().zip(others).enumerate() {
                *gene = if bits >> index & 1 == 1 { other } else { *gene };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{child, origins, parents};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn genes_keep_their_place((first, second) in parents(), seed: u64) {
            for (index, gene) in child(&UniformCrossover {}, &first, &second, seed).into_iter().enumerate() {
                prop_assert!(gene == first[index] || gene == second[index]);
            }
        }
    }

    #[test]
    fn each_gene_is_a_fair_coin() {
        let mut counts = [0; 70];
        (0..2000).for_each(|seed| {
            let origins = origins(&UniformCrossover {}, 70, seed);
            counts.iter_mut().zip(origins).for_each(|(count, second)| *count += u32::from(second));
        });
        assert!(counts.iter().all(|count| (900..1100).contains(count)), "{counts:?}");
    }
}
