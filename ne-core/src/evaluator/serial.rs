use super::{Evaluator, evaluate_batch};
use crate::{Evaluation, Genome, Seed, Task};

/// Evaluates one batch after the other on the calling thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct Serial;

impl Evaluator for Serial {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        genomes.chunks(task.batch_size().max(1)).flat_map(|batch| evaluate_batch(task, batch, seed)).collect()
    }
}
