use super::{Evaluator, evaluate_phenotypes};
use crate::{Evaluation, Genome, Seed, Task};

/// Evaluates one batch after the other on the calling thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct Serial;

impl Evaluator for Serial {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        let mut phenotypes: Vec<G::Phenotype> = genomes.iter().map(Genome::express).collect();
        evaluate_phenotypes(task, &mut phenotypes, seed, &())
    }
}
