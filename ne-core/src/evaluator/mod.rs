mod serial;
mod successive_halving;
pub use serial::Serial;
pub use successive_halving::{Rung, SuccessiveHalving};

#[cfg(feature = "parallel")]
mod parallel;
#[cfg(feature = "parallel")]
pub use parallel::{Parallel, ThreadsError};

use crate::{Evaluation, Genome, Phenotype, Seed, Task};

/// Spreads the evaluations of a generation over whatever there is: this thread, several threads, machines later.
///
/// An implementor owes:
/// - one evaluation for each genome, in order, the same whatever it is spread over;
/// - each is to the bit what [`Task::evaluate`] gives for that genome's phenotype and this seed, or, for one that
///   [saves the whole evaluation](SuccessiveHalving) for the promising, a cheaper one, which then ranks below all that are whole and
///   have not failed. Whoever was evaluated whole differs from what the task gives in nothing but the steps, which are all
///   that were spent on it.
pub trait Evaluator {
    /// Evaluates every genome of a generation.
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation>;
}

impl<E: Evaluator> Evaluator for &E {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        (**self).evaluate(task, genomes, seed)
    }
}

/// The phenotypes of genomes, as tasks take them.
fn as_batch<P: Phenotype>(phenotypes: &mut [P]) -> Vec<&mut dyn Phenotype> {
    phenotypes.iter_mut().map(|phenotype| phenotype as &mut dyn Phenotype).collect()
}
