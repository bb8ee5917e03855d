mod serial;
pub use serial::Serial;

#[cfg(feature = "parallel")]
mod parallel;
#[cfg(feature = "parallel")]
pub use parallel::{Parallel, ThreadsError};

use crate::{Evaluation, Genome, Seed, Task};

/// Spreads the evaluations of a generation over whatever there is: this thread, several threads, machines later.
///
/// An implementor owes: one evaluation for each genome, in order, each to the bit what
/// [`Task::evaluate`] gives for that genome's phenotype and this seed.
pub trait Evaluator {
    /// Evaluates every genome of a generation.
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation>;
}

/// Expresses a few genomes and evaluates them as one batch.
fn evaluate_batch<G: Genome>(task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
    use crate::Phenotype;
    let mut phenotypes: Vec<G::Phenotype> = genomes.iter().map(Genome::express).collect();
    let mut batch: Vec<&mut dyn Phenotype> =
        phenotypes.iter_mut().map(|phenotype| phenotype as &mut dyn Phenotype).collect();
    task.evaluate_batch(&mut batch, seed)
}
