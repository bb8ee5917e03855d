//! The jury of runs whose worlds vary: who is champion is decided in the world as the configuration has it, and by rapier.

use crate::{config::EngineChoice, setup::Nominal};
use ne_core::{Evaluation, Evaluator, Fitness, Genome, Judgement, Jury, Parallel, Phenotype, Seed, Task};
use ne_net::{DenseNet, GraphNet, Network};
use std::{any::Any, cmp::Reverse, sync::Arc};

/// Judges finalists in the engine of training, and has the best of them confirmed by rapier. If rapier does not agree to
/// the bit, everybody is judged again, in rapier.
pub(crate) struct NominalJury {
    task: Box<dyn Task>,
    /// Rapier, if the task is not in rapier itself.
    reference: Option<Box<dyn Task>>,
    seed: Seed,
    evaluator: Arc<Parallel>,
}

/// The jury's task in rapier, which remembers what it played last.
struct InRapier(Nominal);

impl Task for InRapier {
    fn inputs(&self) -> usize {
        self.0.episode.inputs()
    }

    fn outputs(&self) -> usize {
        self.0.episode.outputs()
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        let net: &dyn Any = phenotype;
        let network = net.downcast_ref::<Network>().cloned();
        let network = network.or_else(|| net.downcast_ref::<DenseNet>().map(|net| net.clone().into()));
        let network = network.or_else(|| net.downcast_ref::<GraphNet>().map(|net| net.clone().into()));
        match network {
            Some(network) => self.0.replay(&network, seed).1,
            None => self.0.episode.evaluate(phenotype, seed),
        }
    }
}

impl NominalJury {
    /// The jury of a run.
    pub(crate) fn new(nominal: &Nominal, evaluator: Arc<Parallel>) -> Self {
        let confirmed = nominal.task.engine() != EngineChoice::Rapier;
        Self {
            task: Box::new(nominal.task.clone()),
            reference: confirmed.then(|| Box::new(InRapier(nominal.clone())) as Box<dyn Task>),
            seed: nominal.seed,
            evaluator,
        }
    }

    /// Whether rapier finds the best of these as good as they say, if there is one that is to become champion.
    fn confirmed<G: Genome>(
        &self,
        reference: &dyn Task,
        finalists: &[G],
        evaluations: &[Evaluation],
        standing: Option<Fitness>,
    ) -> bool {
        let able = (0..finalists.len()).filter(|&index| evaluations[index].fitness() > standing);
        let Some(best) = able.min_by_key(|&index| Reverse(evaluations[index].fitness())) else { return true };
        let again = reference.evaluate(&mut finalists[best].express(), self.seed);
        let agree = again.outcome == evaluations[best].outcome;
        if !agree {
            let (lanes, rapier) = (&evaluations[best].outcome, &again.outcome);
            tracing::warn!(?lanes, ?rapier, "lanes and rapier parted; the finalists are judged in rapier");
        }
        agree
    }
}

impl<G: Genome> Jury<G> for NominalJury {
    fn seed(&self) -> Seed {
        self.seed
    }

    fn judge(&self, finalists: &[G], standing: Option<Fitness>) -> Judgement {
        let evaluations = self.evaluator.evaluate(&*self.task, finalists, self.seed);
        match &self.reference {
            Some(reference) if !self.confirmed(&**reference, finalists, &evaluations, standing) => {
                Judgement { evaluations: self.evaluator.evaluate(&**reference, finalists, self.seed), parted: true }
            }
            _ => Judgement { evaluations, parted: false },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Failure, conformance::Puppet};

    /// Worth is what the puppet answers, as this engine sees it.
    struct Fake(fn(f64) -> Evaluation);

    impl Task for Fake {
        fn inputs(&self) -> usize {
            0
        }

        fn outputs(&self) -> usize {
            1
        }

        fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
            assert_eq!(seed, Seed::of_run(7), "everybody is judged in one world");
            let mut answer = [0.0];
            phenotype.reset();
            phenotype.activate(&[], &mut answer);
            (self.0)(f64::from(answer[0]))
        }
    }

    fn judge(lanes: fn(f64) -> Evaluation, rapier: Option<fn(f64) -> Evaluation>) -> (Vec<Evaluation>, bool) {
        let jury = NominalJury {
            task: Box::new(Fake(lanes)),
            reference: rapier.map(|rapier| Box::new(Fake(rapier)) as Box<dyn Task>),
            seed: Seed::of_run(7),
            evaluator: Arc::new(Parallel::new(1).expect("a thread starts")),
        };
        let Judgement { evaluations, parted } = jury.judge(&Puppet::sample(0, 1, 6), None);
        (evaluations, parted)
    }

    fn all(engine: fn(f64) -> Evaluation) -> Vec<Evaluation> {
        judge(engine, None).0
    }

    fn failed(_: f64) -> Evaluation {
        Evaluation::failed(Failure::Other { what: "it fell apart".into() })
    }

    #[test]
    fn what_rapier_confirms_stands() {
        assert_eq!(judge(Evaluation::new, Some(Evaluation::new)), (all(Evaluation::new), false));
        assert_eq!(judge(Evaluation::new, None), (all(Evaluation::new), false));
        assert_eq!(judge(failed, Some(Evaluation::new)), (all(failed), false), "there is nobody to confirm");
    }

    #[test]
    fn where_lanes_and_rapier_part_all_are_judged_in_rapier() {
        let off: fn(f64) -> Evaluation = |worth| Evaluation::new(-worth);
        assert_eq!(judge(Evaluation::new, Some(off)), (all(off), true));
        assert_eq!(judge(Evaluation::new, Some(failed)), (all(failed), true));
        let by_a_bit: fn(f64) -> Evaluation = |worth| Evaluation::new(worth.next_up());
        assert_eq!(judge(Evaluation::new, Some(by_a_bit)), (all(by_a_bit), true));
    }
}
