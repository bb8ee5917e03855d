//! The jury of runs whose worlds vary: who is champion is decided in the world as the configuration has it, and by rapier.

use crate::{config::EngineChoice, gait::USABLE, setup::Nominal};
use ne_core::{Evaluation, Evaluator, Fitness, Genome, Judgement, Jury, Parallel, Phenotype, Seed, Standing, Task};
use ne_net::{DenseNet, GraphNet, Network};
use std::{any::Any, cmp::Reverse, sync::Arc};

/// Judges finalists in the engine of training, and has the best of them confirmed by rapier. If rapier does not agree to
/// the bit, everybody is judged again, in rapier.
pub(crate) struct NominalJury {
    task: Box<dyn Task>,
    /// Rapier, if the task is not in rapier itself.
    reference: Option<Box<dyn Task>>,
    /// The varied worlds in which fitness must be kept.
    proof: Option<Box<dyn Task>>,
    /// Whether a gait is usable, if those of this movement are judged.
    usable: Option<Box<Usable>>,
    seed: Seed,
    evaluator: Arc<Parallel>,
}

/// Says whether the gait of a controller is usable.
type Usable = dyn Fn(&dyn Phenotype) -> bool + Send + Sync;

/// Steps in which the share of fitness kept is told apart: little, half, and three quarters or more. Finer ones would have
/// a slow champion that keeps everything stand above one ten times as fast that keeps nearly everything.
const DEGREES: u8 = 2;

/// So many of the best finalists have their gaits judged at a hearing, until one of them is usable.
const JUDGED: usize = 4;

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
        match network_of(phenotype) {
            Some(network) => self.0.replay(&network, seed).1,
            None => self.0.episode.evaluate(phenotype, seed),
        }
    }
}

/// The net that a controller is, if it is one.
fn network_of(phenotype: &dyn Phenotype) -> Option<Network> {
    let net: &dyn Any = phenotype;
    let network = net.downcast_ref::<Network>().cloned();
    let network = network.or_else(|| net.downcast_ref::<DenseNet>().map(|net| net.clone().into()));
    network.or_else(|| net.downcast_ref::<GraphNet>().map(|net| net.clone().into()))
}

impl NominalJury {
    /// The jury of a run.
    pub(crate) fn new(nominal: &Nominal, evaluator: Arc<Parallel>) -> Self {
        let confirmed = nominal.task.engine() != EngineChoice::Rapier;
        Self {
            task: Box::new(nominal.task.clone()),
            reference: confirmed.then(|| Box::new(InRapier(nominal.clone())) as Box<dyn Task>),
            proof: nominal.proof.clone().map(|proof| Box::new(proof) as Box<dyn Task>),
            usable: nominal.stage.clone().map(|stage| {
                let usable = move |phenotype: &dyn Phenotype| {
                    network_of(phenotype).is_some_and(|network| stage.is_usable(&network))
                };
                Box::new(usable) as Box<Usable>
            }),
            seed: nominal.seed,
            evaluator,
        }
    }

    /// Grades: 0 for whoever is not known to be usable, and from [`USABLE`] on the more of its fitness is kept in varied
    /// worlds. Gaits are judged, the best first, until one is usable; who would not become champion even if its gait
    /// were is not looked at.
    fn grades<G: Genome>(&self, finalists: &[G], evaluations: &[Evaluation], standing: Option<Standing>) -> Vec<u8> {
        let mut grades = vec![0; finalists.len()];
        let Some(usable) = &self.usable else { return grades };
        let kept = self.kept(finalists, evaluations);
        let place = |index: usize| {
            let grade = USABLE + (kept[index] * f64::from(DEGREES)).round() as u8;
            Some(Standing { grade, fitness: evaluations[index].fitness()? })
        };
        let mut able: Vec<usize> = (0..finalists.len()).filter(|&index| place(index) > standing).collect();
        able.sort_by_key(|&index| Reverse(place(index)));
        // Those who keep most come first; where they are slow and safe, and not usable, the fittest have their turn.
        let mut fittest = able.clone();
        fittest.sort_by_key(|&index| Reverse(evaluations[index].fitness()));
        let first = &able[..able.len().min(JUDGED)];
        let mut candidates = first.iter().chain(fittest.iter().take(JUDGED).filter(|index| !first.contains(index)));
        if let Some(&best) = candidates.find(|&&index| usable(&finalists[index].express())) {
            grades[best] = place(best).map_or(0, |standing| standing.grade);
        }
        grades
    }

    /// The share of its fitness that each keeps in varied worlds, 0 to 1; 0 for whoever has less than half of the best
    /// fitness here, since it is easy to keep little.
    fn kept<G: Genome>(&self, finalists: &[G], evaluations: &[Evaluation]) -> Vec<f64> {
        let Some(proof) = &self.proof else { return vec![0.0; finalists.len()] };
        let varied = self.evaluator.evaluate(&**proof, finalists, self.seed);
        let best = evaluations.iter().filter_map(Evaluation::fitness).max().map_or(0.0, Fitness::get);
        let share = |(varied, nominal): (&Evaluation, &Evaluation)| match (varied.fitness(), nominal.fitness()) {
            (Some(varied), Some(nominal)) if nominal.get() > 0.0 && nominal.get() >= 0.5 * best => {
                (varied.get() / nominal.get()).clamp(0.0, 1.0)
            }
            _ => 0.0,
        };
        varied.iter().zip(evaluations).map(share).collect()
    }

    /// Whether rapier finds the best of these as good as they say, if there is one that is to become champion.
    fn confirmed<G: Genome>(
        &self,
        reference: &dyn Task,
        finalists: &[G],
        evaluations: &[Evaluation],
        grades: &[u8],
        standing: Option<Standing>,
    ) -> bool {
        let place = |index: usize| Some(Standing { grade: grades[index], fitness: evaluations[index].fitness()? });
        let able = (0..finalists.len()).filter(|&index| place(index) > standing);
        let Some(best) = able.min_by_key(|&index| Reverse(place(index))) else { return true };
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

    fn judge(&self, finalists: &[G], standing: Option<Standing>) -> Judgement {
        let evaluations = self.evaluator.evaluate(&*self.task, finalists, self.seed);
        let grades = self.grades(finalists, &evaluations, standing);
        match &self.reference {
            Some(reference) if !self.confirmed(&**reference, finalists, &evaluations, &grades, standing) => {
                let evaluations = self.evaluator.evaluate(&**reference, finalists, self.seed);
                let grades = self.grades(finalists, &evaluations, standing);
                Judgement { evaluations, grades, parted: true }
            }
            _ => Judgement { evaluations, grades, parted: false },
        }
    }
}

#[cfg(test)]
mod tests;
