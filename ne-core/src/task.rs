use crate::{Evaluation, Failure, Phenotype, Seed, Threads};
use std::{
    fmt,
    sync::{Mutex, PoisonError},
};

/// Scores phenotypes.
///
/// An implementor owes:
/// - the result is a function of the phenotype's behaviour and the seed: no clock, no shared generator, nothing left
///   over from an earlier evaluation; chance comes from [`Seed::stream`];
/// - the phenotype is [`reset`](Phenotype::reset) before every trial, the first too: it may remember another evaluation;
/// - whatever goes wrong is an [`Evaluation`] with a [`Failure`], not a panic: a phenotype of another shape, outputs
///   that are NaN (clamping one into a number would hide it).
///
/// A function is a task as well: [`TaskFn`]. Check yours with `check_task` of the [conformance kit](crate::conformance).
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
        spread_batches(self, phenotypes, seed, threads)
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

/// A function as a [`Task`].
///
/// It is given a phenotype of the right shape, reset, and says how good it is: an [`Evaluation`], or a number, which is the
/// fitness.
///
/// ```
/// use ne_core::{Phenotype, Seed, TaskFn};
///
/// /// The second output is to be the square of the input.
/// let task = TaskFn::new(1, 2, |net: &mut dyn Phenotype, _: Seed| {
///     let mut outputs = [0.0; 2];
///     net.activate(&[3.0], &mut outputs);
///     -f64::from((outputs[1] - 9.0).abs())
/// });
/// ```
#[derive(Clone, Copy)]
pub struct TaskFn<F> {
    inputs: usize,
    outputs: usize,
    evaluate: F,
}

impl<E: Into<Evaluation>, F: Fn(&mut dyn Phenotype, Seed) -> E + Send + Sync> TaskFn<F> {
    /// A task for phenotypes with so many inputs and outputs. The function owes what a [`Task`] owes.
    pub fn new(inputs: usize, outputs: usize, evaluate: F) -> Self {
        Self { inputs, outputs, evaluate }
    }
}

impl<E: Into<Evaluation>, F: Fn(&mut dyn Phenotype, Seed) -> E + Send + Sync> Task for TaskFn<F> {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn outputs(&self) -> usize {
        self.outputs
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        phenotype.reset();
        (self.evaluate)(phenotype, seed).into()
    }
}

impl<F> fmt::Debug for TaskFn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { inputs, outputs, .. } = self;
        f.debug_struct("TaskFn").field("inputs", inputs).field("outputs", outputs).finish_non_exhaustive()
    }
}

/// What [`Task::evaluate_spread`] does if a task does nothing else: an idle thread takes the next batch, none larger than an
/// even share.
pub(crate) fn spread_batches<T: Task + ?Sized>(
    task: &T,
    phenotypes: &mut [&mut dyn Phenotype],
    seed: Seed,
    threads: &dyn Threads,
) -> Vec<Evaluation> {
    let count = phenotypes.len();
    let even = count.div_ceil(threads.count().max(1));
    let batch = task.batch_size().min(even).max(1);
    let done: Mutex<Vec<(usize, Vec<Evaluation>)>> = Mutex::default();
    let queue = Mutex::new(phenotypes.chunks_mut(batch).enumerate());
    threads.each(&|| {
        loop {
            let next = queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((place, batch)) = next else { return };
            let evaluations = evaluate_batch(task, batch, seed);
            done.lock().unwrap_or_else(PoisonError::into_inner).push((place, evaluations));
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_by_key(|&(place, _)| place);
    done.into_iter().flat_map(|(_, evaluations)| evaluations).collect()
}

/// One batch; one with too many or too few evaluations has failed.
pub(crate) fn evaluate_batch<T: Task + ?Sized>(
    task: &T,
    batch: &mut [&mut dyn Phenotype],
    seed: Seed,
) -> Vec<Evaluation> {
    let evaluations = task.evaluate_batch(batch, seed);
    complete(evaluations, batch.len())
}

/// These evaluations of so many phenotypes; failures if they are too many or too few, since none can be told whose it is.
pub(crate) fn complete(evaluations: Vec<Evaluation>, count: usize) -> Vec<Evaluation> {
    if evaluations.len() == count {
        return evaluations;
    }
    let what = format!("the task gave {} evaluations for a batch of {count}", evaluations.len());
    vec![Evaluation::failed(Failure::Other { what }); count]
}
