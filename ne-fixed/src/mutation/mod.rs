//! Mutation: the contract and four operators.

mod choice;
mod distributed;
mod gaussian;
mod self_adaptive;
mod uniform;

pub use {
    choice::MutationChoice, distributed::DistributedMutation, gaussian::GaussianMutation,
    self_adaptive::SelfAdaptiveMutation, uniform::UniformMutation,
};

use crate::Setting;
use ne_core::RandomStream;

/// Changes the genes of a child by chance.
///
/// An implementor owes, and [`check_mutation`](crate::conformance::check_mutation) checks:
/// - the result depends on the arguments alone;
/// - weights stay finite, and `deviation` finite and not negative, if they were;
/// - `strength` scales the size of a change, not its probability.
pub trait Mutation: Setting {
    /// Changes `weights`.
    ///
    /// `deviation` belongs to the individual and is inherited: for mutations that adapt themselves; others leave it as
    /// it is. `strength`, above 0 and normally 1, is larger in a population that stagnates (see
    /// [`StagnationBoost`](crate::StagnationBoost)).
    fn mutate(&self, weights: &mut [f32], deviation: &mut f32, strength: f32, stream: &mut RandomStream);

    /// The deviation individuals of the first generation have; 0 for mutations that do not use it.
    fn initial_deviation(&self) -> f32 {
        0.0
    }
}

/// What the tests of all operators need.
#[cfg(test)]
pub(crate) mod testing {
    use super::*;
    use ne_core::{Purpose, Seed};

    /// What the operator makes of `count` weights of zero: the changes alone.
    pub(crate) fn changes(operator: &impl Mutation, count: usize, strength: f32, seed: u64) -> Vec<f32> {
        mutated(operator, vec![0.0; count], operator.initial_deviation(), strength, seed).0
    }

    /// What the operator makes of weights and deviation.
    pub(crate) fn mutated(
        operator: &impl Mutation,
        mut weights: Vec<f32>,
        mut deviation: f32,
        strength: f32,
        seed: u64,
    ) -> (Vec<f32>, f32) {
        let mut stream = Seed::of_run(seed).stream(Purpose::new("test"));
        operator.mutate(&mut weights, &mut deviation, strength, &mut stream);
        (weights, deviation)
    }

    /// The share of genes the operator changes, measured on many.
    pub(crate) fn measured_rate(operator: &impl Mutation) -> f64 {
        let touched: usize = (0..100)
            .map(|seed| changes(operator, 1000, 1.0, seed).iter().filter(|&&change| change != 0.0).count())
            .sum();
        touched as f64 / 100_000.0
    }

    /// The standard deviation of changes, about zero.
    pub(crate) fn spread(changes: &[f32]) -> f64 {
        (changes.iter().map(|&change| f64::from(change).powi(2)).sum::<f64>() / changes.len() as f64).sqrt()
    }
}
