use super::{Evaluator, as_batch};
use crate::{Evaluation, Genome, Seed, Task, threads::complete};

/// Evaluates one batch after the other on the calling thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct Serial;

impl Evaluator for Serial {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        let mut phenotypes: Vec<G::Phenotype> = genomes.iter().map(Genome::express).collect();
        complete(task.evaluate_spread(&mut as_batch(&mut phenotypes), seed, &()), genomes.len())
    }
}
