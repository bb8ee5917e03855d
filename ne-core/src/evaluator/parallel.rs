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

/// Why an evaluator has no threads.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ThreadsError {
    /// More than [`Parallel::MOST_THREADS`].
    #[error("{0} threads: at most {most} are allowed", most = Parallel::MOST_THREADS)]
    TooMany(usize),
    /// The operating system would not start them.
    #[error("cannot start {threads} threads: {source}")]
    Start {
        /// So many were asked for.
        threads: usize,
        /// What it said.
        source: rayon::ThreadPoolBuildError,
    },
}

impl Parallel {
    /// So many threads at most.
    pub const MOST_THREADS: usize = 1024;

    /// An evaluator with this many threads, up to [`MOST_THREADS`](Self::MOST_THREADS); 0 means one for each core.
    ///
    /// # Errors
    /// If there are too many, or they cannot be started.
    pub fn new(threads: usize) -> Result<Self, ThreadsError> {
        if threads > Self::MOST_THREADS {
            return Err(ThreadsError::TooMany(threads));
        }
        if cfg!(target_family = "wasm") {
            return Ok(Self { pool: None });
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|index| format!("evaluator {index}"))
            .build()
            .map_err(|source| ThreadsError::Start { threads, source })?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_threads_than_any_machine_has_are_refused() {
        let refused = Parallel::new(100_000).expect_err("too many").to_string();
        assert_eq!(refused, "100000 threads: at most 1024 are allowed");
    }
}
