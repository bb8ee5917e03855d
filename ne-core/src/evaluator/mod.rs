mod serial;
pub use serial::Serial;

#[cfg(feature = "parallel")]
mod parallel;
#[cfg(feature = "parallel")]
pub use parallel::{Parallel, ThreadsError};

use crate::{Evaluation, Genome, Phenotype, Seed, Task, Threads, task::complete};

/// Spreads the evaluations of a generation over whatever there is: this thread, several threads, machines later.
///
/// An implementor owes:
/// - one evaluation for each genome, in order, the same whatever it is spread over;
/// - each is to the bit what [`Task::evaluate`] gives for that genome's phenotype and this seed, or, for one that
///   [saves the whole evaluation](crate::successive_halving) for the promising, a cheaper one, which then ranks below all that are whole and
///   have not failed. An individual that was evaluated whole differs from what the task gives in nothing but the steps, which
///   are all that were spent on it.
pub trait Evaluator {
    /// Evaluates every genome of a generation.
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation>;
}

impl<E: Evaluator> Evaluator for &E {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        (**self).evaluate(task, genomes, seed)
    }
}

impl<E: Evaluator> Evaluator for std::sync::Arc<E> {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        (**self).evaluate(task, genomes, seed)
    }
}

/// Evaluates freshly expressed phenotypes, spread over these threads: what every evaluator ends in.
///
/// A task sees none of another shape than its own; these have failed with [`Failure::ShapeMismatch`](crate::Failure). It sees
/// the others [reset](Phenotype::reset).
pub fn evaluate_phenotypes<P: Phenotype>(
    task: &dyn Task,
    phenotypes: &mut [P],
    seed: Seed,
    threads: &dyn Threads,
) -> Vec<Evaluation> {
    let shapes: Vec<_> = phenotypes.iter().map(|phenotype| task.check_shape(phenotype)).collect();
    let fitting = phenotypes.iter_mut().zip(&shapes).filter(|(_, shape)| shape.is_ok());
    let mut fitting: Vec<&mut dyn Phenotype> = fitting.map(|(phenotype, _)| phenotype as &mut dyn Phenotype).collect();
    for phenotype in &mut fitting {
        phenotype.reset();
    }
    let evaluations = task.evaluate_spread(&mut fitting, seed, threads);
    let mut evaluations = complete(evaluations, fitting.len()).into_iter();
    let result = |shape: Result<(), _>| match shape {
        // There is one for each that fits.
        Ok(()) => evaluations.next().unwrap_or_else(|| Evaluation::new(f64::NAN)),
        Err(failure) => Evaluation::failed(failure),
    };
    shapes.into_iter().map(result).collect()
}
