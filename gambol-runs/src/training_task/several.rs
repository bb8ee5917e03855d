//! Fitness over several bodies: one net that has to move them all.

use super::TrainingTask;
use ne_core::{Evaluation, Fitness, Phenotype, Seed, Task, Threads};
use tasks::Combine;

/// The same episodes in several bodies, in each of which every individual is evaluated with the same seed.
///
/// An evaluation is put together of one in each body as one is of trials: the mean or the worst of their fitnesses, the
/// means of objectives and measurements, the sum of steps. Bodies come one after the other, and an individual that
/// fails in one is not tried in those that follow.
#[derive(Clone)]
pub struct SeveralBodies {
    /// At least one.
    bodies: Vec<TrainingTask>,
    combine: Combine,
}

impl SeveralBodies {
    /// In this body, and in others with as many inputs and outputs.
    pub(crate) fn new(first: TrainingTask, others: Vec<TrainingTask>, combine: Combine) -> Self {
        Self { bodies: [vec![first], others].concat(), combine }
    }

    /// The task in each body alone; the first is that of the creature itself.
    pub fn bodies(&self) -> &[TrainingTask] {
        &self.bodies
    }

    /// The same with each body's task changed.
    pub(crate) fn map(&self, change: impl Fn(&TrainingTask) -> TrainingTask) -> Self {
        Self { bodies: self.bodies.iter().map(change).collect(), combine: self.combine }
    }

    /// One evaluation, of those in the bodies; the last may have failed.
    fn together(&self, evaluations: &[Evaluation]) -> Evaluation {
        let steps = evaluations.iter().map(|evaluation| evaluation.steps).sum();
        if let Some(Err(failure)) = evaluations.last().map(|evaluation| &evaluation.outcome) {
            return Evaluation::failed(failure.clone()).with_steps(steps);
        }
        let count = evaluations.len() as f64;
        let fitnesses = evaluations.iter().filter_map(Evaluation::fitness).map(Fitness::get);
        let fitness = match self.combine {
            Combine::Mean | Combine::WorstLesson => fitnesses.sum::<f64>() / count,
            Combine::Worst => fitnesses.fold(f64::INFINITY, f64::min),
        };
        let mut all = Evaluation::new(fitness).with_steps(steps);
        for evaluation in evaluations {
            all.objectives.resize(evaluation.objectives.len(), 0.0);
            for (mean, objective) in all.objectives.iter_mut().zip(&evaluation.objectives) {
                *mean += objective / count;
            }
            all.measurements.add_share(&evaluation.measurements, count);
        }
        all
    }

    /// Evaluates in one body after the other, in each those that have not failed in an earlier one.
    fn evaluate_in_each(
        &self,
        phenotypes: &mut [&mut dyn Phenotype],
        evaluate: impl Fn(&TrainingTask, &mut [&mut dyn Phenotype]) -> Vec<Evaluation>,
    ) -> Vec<Evaluation> {
        let mut evaluations: Vec<Vec<Evaluation>> = vec![Vec::new(); phenotypes.len()];
        for body in &self.bodies {
            let fine = |so_far: &[Evaluation]| so_far.last().is_none_or(|last| last.outcome.is_ok());
            let able: Vec<usize> = (0..phenotypes.len()).filter(|&index| fine(&evaluations[index])).collect();
            let mut able_phenotypes: Vec<&mut dyn Phenotype> = phenotypes
                .iter_mut()
                .enumerate()
                .filter(|(index, _)| able.binary_search(index).is_ok())
                .map(|(_, phenotype)| &mut **phenotype)
                .collect();
            for (index, evaluation) in able.into_iter().zip(evaluate(body, &mut able_phenotypes)) {
                evaluations[index].push(evaluation);
            }
        }
        evaluations.iter().map(|evaluations| self.together(evaluations)).collect()
    }
}

impl Task for SeveralBodies {
    fn inputs(&self) -> usize {
        self.bodies[0].inputs()
    }

    fn outputs(&self) -> usize {
        self.bodies[0].outputs()
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        self.evaluate_batch(&mut [phenotype], seed).remove(0)
    }

    fn evaluate_batch(&self, phenotypes: &mut [&mut dyn Phenotype], seed: Seed) -> Vec<Evaluation> {
        self.evaluate_in_each(phenotypes, |body, able| body.evaluate_batch(able, seed))
    }

    fn evaluate_spread(
        &self,
        phenotypes: &mut [&mut dyn Phenotype],
        seed: Seed,
        threads: &dyn Threads,
    ) -> Vec<Evaluation> {
        self.evaluate_in_each(phenotypes, |body, able| body.evaluate_spread(able, seed, threads))
    }

    fn batch_size(&self) -> usize {
        self.bodies[0].batch_size()
    }
}
