use super::Crossover;
use crate::Setting;
use ne_core::RandomStream;
use rand::Rng;
use serde::{Deserialize, Serialize};

/// Uniform crossover: each gene from either parent with equal chance, independently.
///
/// Source: Syswerda, *Uniform Crossover in Genetic Algorithms*, ICGA 1989.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct UniformCrossover {}

impl Setting for UniformCrossover {}

impl Crossover for UniformCrossover {
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream) {
        child.copy_from_slice(first);
        // A random bit for each gene, eight genes at a time: full blocks become vector instructions.
        let ((genes, last_genes), (others, last_others)) = (child.as_chunks_mut::<8>(), second.as_chunks::<8>());
        for (genes, others) in genes.chunks_mut(4).zip(others.chunks(4)) {
            let mut bits = stream.next_u32();
            for (genes, others) in genes.iter_mut().zip(others) {
                choose(genes, others, bits);
                bits >>= 8;
            }
        }
        choose(last_genes, last_others, stream.next_u32());
    }
}

/// Replaces each of up to eight genes whose bit is set by the other. Without a branch, which would be guessed wrong half
/// of the time.
#[inline(always)]
fn choose(genes: &mut [f32], others: &[f32], bits: u32) {
    const BITS: [u32; 8] = [1, 2, 4, 8, 16, 32, 64, 128];
    for ((gene, &other), bit) in genes.iter_mut().zip(others).zip(BITS) {
        let keep = u32::from(bits & bit != 0).wrapping_sub(1);
        *gene = f32::from_bits(gene.to_bits() & keep | other.to_bits() & !keep);
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
