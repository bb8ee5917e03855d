//! Crossover: the contract and four operators.

mod arithmetic;
mod choice;
mod one_point;
mod two_point;
mod uniform;

pub use {
    arithmetic::Arithmetic, choice::CrossoverChoice, one_point::OnePoint, two_point::TwoPoint,
    uniform::UniformCrossover,
};

use crate::Setting;
use ne_core::RandomStream;

/// Makes the genes of a child from those of two parents.
///
/// An implementor owes, and [`check_crossover`](crate::conformance::check_crossover) checks:
/// - every gene of `child` is written, whatever it held before;
/// - parents that are equal have a child equal to them;
/// - the result depends on the parents and the stream alone, and is finite if they are.
pub trait Crossover: Setting {
    /// Writes the child of `first` and `second`; all three slices have the same length.
    ///
    /// # Panics
    /// May panic if the lengths differ.
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream);
}

/// What the tests of all operators need.
#[cfg(test)]
pub(crate) mod testing {
    use super::*;
    use ne_core::{Purpose, Seed};
    use proptest::prelude::*;

    /// Two parents of equal length.
    pub(crate) fn parents() -> impl Strategy<Value = (Vec<f32>, Vec<f32>)> {
        (1..200usize).prop_flat_map(|count| {
            let genes = proptest::collection::vec(-5.0..5.0f32, count);
            (genes.clone(), genes)
        })
    }

    /// The child of these parents, written over NaN.
    pub(crate) fn child(operator: &impl Crossover, first: &[f32], second: &[f32], seed: u64) -> Vec<f32> {
        let mut child = vec![f32::NAN; first.len()];
        operator.cross(first, second, &mut child, &mut Seed::of_run(seed).stream(Purpose::new("test")));
        child
    }

    /// From which parent, false or true, each gene comes, for a gene count.
    pub(crate) fn origins(operator: &impl Crossover, count: usize, seed: u64) -> Vec<bool> {
        let (first, second) = (vec![0.0; count], vec![1.0; count]);
        let child = child(operator, &first, &second, seed);
        assert!(child.iter().all(|&gene| gene == 0.0 || gene == 1.0), "a gene of neither parent: {child:?}");
        child.iter().map(|&gene| gene == 1.0).collect()
    }

    /// How often the origin changes from gene to gene.
    pub(crate) fn changes(origins: &[bool]) -> usize {
        origins.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }
}
