use super::{Evaluator, evaluate_batch};
use crate::{Evaluation, Genome, Seed, Task};
use rayon::prelude::*;

/// Evaluates batches on a pool of threads of its own; an idle thread takes the next batch.
#[derive(Debug)]
pub struct Parallel {
    pool: rayon::ThreadPool,
}

/// The operating system would not start the threads.
#[derive(Debug, thiserror::Error)]
#[error("cannot start {threads} threads: {source}")]
pub struct ThreadsError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

impl Parallel {
    /// An evaluator with this many threads; 0 means one for each core.
    ///
    /// # Errors
    /// If the threads cannot be started.
    pub fn new(threads: usize) -> Result<Self, ThreadsError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|index| format!("evaluator {index}"))
            .build()
            .map_err(|source| ThreadsError { threads, source })?;
        Ok(Self { pool })
    }

    /// Does other work on these threads: what `work` hands to rayon stays on them.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.install(work)
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }
}

impl Evaluator for Parallel {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        // Batches no larger than an even share, so that no thread idles while another has two.
        let even = genomes.len().div_ceil(self.threads());
        let batch = task.batch_size().min(even).max(1);
        self.pool.install(|| {
            genomes.par_chunks(batch).with_max_len(1).flat_map_iter(|batch| evaluate_batch(task, batch, seed)).collect()
        })
    }
}
