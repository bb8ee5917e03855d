mod heats;
mod serial;
pub use heats::{Heat, Heats};
pub use serial::Serial;

#[cfg(feature = "parallel")]
mod parallel;
#[cfg(feature = "parallel")]
pub use parallel::{Parallel, ThreadsError};

use crate::{Evaluation, Failure, Genome, Seed, Task};

/// Spreads the evaluations of a generation over whatever there is: this thread, several threads, machines later.
///
/// An implementor owes:
/// - one evaluation for each genome, in order, the same whatever it is spread over;
/// - each is to the bit what [`Task::evaluate`] gives for that genome's phenotype and this seed, or, for one that
///   [saves the whole evaluation](Heats) for the promising, a cheaper one, which then ranks below all that are whole and
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

/// Expresses a few genomes and evaluates them as one batch; a batch with too many or too few evaluations has failed.
fn evaluate_batch<G: Genome>(task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
    use crate::Phenotype;
    let mut phenotypes: Vec<G::Phenotype> = genomes.iter().map(Genome::express).collect();
    let mut batch: Vec<&mut dyn Phenotype> =
        phenotypes.iter_mut().map(|phenotype| phenotype as &mut dyn Phenotype).collect();
    let evaluations = task.evaluate_batch(&mut batch, seed);
    if evaluations.len() == genomes.len() {
        return evaluations;
    }
    // Nobody can say which evaluation belongs to whom.
    let what = format!("the task gave {} evaluations for a batch of {}", evaluations.len(), genomes.len());
    vec![Evaluation::failed(Failure::Other { what }); genomes.len()]
}
