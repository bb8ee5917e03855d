use super::{Evaluator, evaluate_phenotypes};
use crate::{Evaluation, Genome, Seed, Task, Threads};
use rayon::prelude::*;

/// So many phenotypes are in memory at the same time at most: so many that no thread waits for long, and few beside a
/// population of a million.
const AT_ONCE: usize = 1 << 14;

/// Evaluates a generation on a pool of threads of its own; where there are no threads, as in a browser, on the calling thread.
#[derive(Debug)]
pub struct Parallel {
    pool: Option<rayon::ThreadPool>,
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
        if cfg!(target_family = "wasm") {
            return Ok(Self { pool: None });
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|index| format!("evaluator {index}"))
            .build()
            .map_err(|source| ThreadsError { threads, source })?;
        Ok(Self { pool: Some(pool) })
    }

    /// Does other work on these threads: what `work` hands to rayon stays on them.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, rayon::ThreadPool::current_num_threads)
    }
}

impl Threads for Parallel {
    fn count(&self) -> usize {
        self.threads()
    }

    fn each(&self, work: &(dyn Fn() + Sync)) {
        match &self.pool {
            Some(pool) => pool.install(|| (0..self.threads()).into_par_iter().with_max_len(1).for_each(|_| work())),
            None => work(),
        }
    }
}

impl Evaluator for Parallel {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        let evaluate = |genomes: &[G]| {
            let mut phenotypes: Vec<G::Phenotype> = self.install(|| genomes.par_iter().map(Genome::express).collect());
            evaluate_phenotypes(task, &mut phenotypes, seed, self)
        };
        let mut evaluations = Vec::with_capacity(genomes.len());
        genomes.chunks(AT_ONCE).for_each(|some| evaluations.extend(evaluate(some)));
        evaluations
    }
}
