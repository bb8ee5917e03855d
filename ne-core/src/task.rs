use crate::{Evaluation, Failure, Phenotype, Seed, Threads, threads};

/// Scores phenotypes.
///
/// An implementor owes:
/// - the result is a function of the phenotype's behaviour and the seed: no clock, no shared generator, nothing left
///   over from an earlier evaluation; chance comes from [`Seed::stream`];
/// - the phenotype is [`reset`](Phenotype::reset) before it is used;
/// - whatever goes wrong is an [`Evaluation`] with a [`Failure`], not a panic: a phenotype of another shape, outputs
///   that are NaN (clamping one into a number would hide it).
///
/// Check yours with `check_task` of the [conformance kit](crate::conformance).
///
/// All members of a generation are evaluated with the same seed: they face the same trials, so that the comparison is
/// fair and a batch can share its worlds.
pub trait Task: Send + Sync {
    /// The number of inputs a phenotype must have.
    fn inputs(&self) -> usize;

    /// The number of outputs a phenotype must have.
    fn outputs(&self) -> usize;

    /// Evaluates one phenotype.
    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation;

    /// Evaluates several phenotypes at once: bodies that share a world, SIMD lanes, a GPU.
    ///
    /// Returns one evaluation for each phenotype, in order; each is to the bit what [`evaluate`](Self::evaluate) would
    /// have given for that phenotype alone.
    fn evaluate_batch(&self, phenotypes: &mut [&mut dyn Phenotype], seed: Seed) -> Vec<Evaluation> {
        phenotypes.iter_mut().map(|phenotype| self.evaluate(&mut **phenotype, seed)).collect()
    }

    /// How many phenotypes [`evaluate_batch`](Self::evaluate_batch) likes best at a time; at least 1. An evaluator may
    /// hand over fewer.
    fn batch_size(&self) -> usize {
        1
    }

    /// Evaluates a whole generation on several threads: what [`Parallel`](crate::Parallel) calls.
    ///
    /// Returns what [`evaluate_batch`](Self::evaluate_batch) would, on however many threads. Without an implementation of its
    /// own each thread takes batches of at most [`batch_size`](Self::batch_size), which is fine unless the last of them keeps
    /// the others waiting.
    fn evaluate_spread(
        &self,
        phenotypes: &mut [&mut dyn Phenotype],
        seed: Seed,
        threads: &dyn Threads,
    ) -> Vec<Evaluation> {
        threads::spread_batches(self, phenotypes, seed, threads)
    }

    /// Compares the phenotype's shape with the task's; for implementors to call first.
    ///
    /// # Errors
    /// [`Failure::ShapeMismatch`] if inputs or outputs differ.
    fn check_shape(&self, phenotype: &dyn Phenotype) -> Result<(), Failure> {
        let (inputs, outputs) = (self.inputs(), self.outputs());
        let (found_inputs, found_outputs) = (phenotype.inputs(), phenotype.outputs());
        if (found_inputs, found_outputs) == (inputs, outputs) {
            Ok(())
        } else {
            Err(Failure::ShapeMismatch { found_inputs, found_outputs, inputs, outputs })
        }
    }
}
