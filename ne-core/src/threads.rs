use crate::{Evaluation, Failure, Phenotype, Seed, Task};
use std::sync::{Mutex, PoisonError};

/// Threads a task may spread a batch over; see [`Task::evaluate_spread`].
pub trait Threads: Sync {
    /// How many there are, at least 1.
    fn count(&self) -> usize;

    /// Calls `work` once on each thread, and returns when all calls have. A thread may be busy until another is done: `work`
    /// takes what there is to do from a queue, and never waits for another call.
    fn each(&self, work: &(dyn Fn() + Sync));
}

/// The calling thread alone.
impl Threads for () {
    fn count(&self) -> usize {
        1
    }

    fn each(&self, work: &(dyn Fn() + Sync)) {
        work();
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
