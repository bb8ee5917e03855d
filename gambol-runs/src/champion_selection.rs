//! The champion selection of runs whose worlds vary, whose episodes are short or whose bodies are several: the champion
//! is chosen in one whole episode of the creature, in the world as the configuration has it, and by rapier.

use crate::{
    config::EngineChoice,
    reference::ReferenceEpisode,
    robustness_check::{RobustnessCheck, Trial},
    tiers::{DEPENDABLE, USABLE},
};
use ne_core::{
    Evaluation, Evaluator, Fitness, Genome, Parallel, Phenotype, Seed, Task, TieredFitness,
    champion_selection::{ChampionSelection, ReEvaluation},
};
use ne_net::Network;
use std::{borrow::Cow, cmp::Reverse, sync::Arc};

/// Judges candidates in the engine of training, and has the best of them confirmed by rapier. If rapier does not agree to
/// the bit, all candidates are judged again, in rapier.
pub(crate) struct ReferenceSelection {
    task: Box<dyn Task>,
    /// Rapier, if the task is not in rapier itself.
    reference: Option<Box<dyn Task>>,
    /// The varied worlds in which fitness must be kept.
    proof: Option<Box<dyn Task>>,
    /// Whose gait is usable, if those of this movement are judged.
    usable: Option<Box<FirstUsable>>,
    /// In how many perturbed worlds it is, if training varies the world.
    steadiness: Option<Box<Steadiness>>,
    steps: Vec<(Trial, usize)>,
    /// Which of the usable candidates of a re-evaluation goes on, if they are compared.
    steadiest: Option<Box<Steadiest>>,
    seed: Seed,
    evaluator: Arc<Parallel>,
}

/// Says which of these controllers are the first whose gaits are usable, at most so many.
type FirstUsable = dyn Fn(&[&dyn Phenotype], usize) -> Vec<usize> + Send + Sync;

/// Says in how many perturbed worlds of a trial the gait of a controller is usable; any smaller number will do if it is so in
/// fewer than are given.
type Steadiness = dyn Fn(&dyn Phenotype, Trial, usize) -> usize + Send + Sync;

/// Says which of these controllers is usable in most schedules of commands; of equals the first.
type Steadiest = dyn Fn(&[&dyn Phenotype]) -> Option<usize> + Send + Sync;

/// In how many worlds of which trial a gait must be usable for one tier above [`USABLE`], for two and so on; one that fails
/// at a step is not tried at those above. First a quarter of the worlds, half, three quarters, all but one. Finer steps would
/// have a slow champion that is usable in one world more stand above one twice as fast.
const STEPS: [(Trial, usize); 8] = [
    (Trial::Short, 4),
    (Trial::Short, 8),
    (Trial::Short, 11),
    (Trial::Short, Trial::Short.worlds() - 1),
    (Trial::Long, 8),
    (Trial::Long, 11),
    (Trial::Long, 13),
    (Trial::Long, Trial::Long.worlds() - 1),
];

/// In how many schedules of commands a gait that is told what to do must be usable for the first tiers above [`USABLE`]: that it does
/// so whatever it is told comes before that it does so in any world. One of some thousand candidates that has passed nine schedules
/// may yet fail in every second.
const SCHEDULES: [usize; 9] = [8, 16, 20, 24, 26, 28, 30, 31, Trial::MoreCommands.worlds()];

const _: () = assert!(SCHEDULES[(DEPENDABLE - USABLE - 1) as usize] == 30, "the documentation says 30");

/// All steps, in their order, of a gait that is told what to do or is not.
fn steps(commanded: bool) -> Vec<(Trial, usize)> {
    let schedules = SCHEDULES.map(|schedules| (Trial::MoreCommands, schedules));
    let first: &[_] = if commanded { &schedules } else { &[] };
    [first, &STEPS].concat()
}

/// The highest tier of a champion whose gait is judged in this episode.
pub(crate) fn highest_tier(reference: &ReferenceEpisode) -> u8 {
    USABLE + steps_of(reference).len() as u8
}

/// The steps that a champion is tried at there; none where nothing varies.
fn steps_of(reference: &ReferenceEpisode) -> Vec<(Trial, usize)> {
    reference.robustness_check.as_ref().map_or_else(Vec::new, |check| steps(check.needs_commands()))
}

/// So many of the best candidates have their gaits judged at a re-evaluation, until one of them is usable.
const JUDGED: usize = 8;

/// So many of those that are told what to do, and as many that are usable are compared: what they earn says little of how often they
/// fail.
const COMPARED: usize = 16;

/// How much of its fitness a candidate keeps in varied worlds: less than a quarter, up to three quarters, or more. Steps may
/// be shorter there, and episodes are, so what keeps all of its speed may keep only half of its distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kept {
    Little,
    Half,
    Most,
}

/// The champion selection's task in rapier, which remembers what it played last.
struct InRapier(ReferenceEpisode);

impl Task for InRapier {
    fn inputs(&self) -> usize {
        self.0.episode.inputs()
    }

    fn outputs(&self) -> usize {
        self.0.episode.outputs()
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        match Network::of(phenotype) {
            Some(network) => self.0.replay(&network, seed).1,
            None => self.0.episode.evaluate(phenotype, seed),
        }
    }
}

fn network(phenotype: &dyn Phenotype) -> Option<Network> {
    Network::of(phenotype).map(Cow::into_owned)
}

/// All are nets, or none is.
fn networks(phenotypes: &[&dyn Phenotype]) -> Vec<Network> {
    phenotypes.iter().filter_map(|net| network(*net)).collect()
}

impl ReferenceSelection {
    /// The champion selection of a run.
    pub(crate) fn new(reference: &ReferenceEpisode, evaluator: Arc<Parallel>) -> Self {
        let confirmed = reference.task.engine() != EngineChoice::Rapier;
        let commanded = reference.robustness_check.as_ref().is_some_and(RobustnessCheck::needs_commands);
        Self {
            task: Box::new(reference.task.clone()),
            reference: confirmed.then(|| Box::new(InRapier(reference.clone())) as Box<dyn Task>),
            proof: reference.proof.clone().map(|proof| Box::new(proof) as Box<dyn Task>),
            usable: reference.judge.clone().map(|judge| {
                let evaluator = evaluator.clone();
                let first_usable = move |phenotypes: &[&dyn Phenotype], most| {
                    let networks = networks(phenotypes);
                    evaluator.install(|| judge.first_usable(&networks, most))
                };
                Box::new(first_usable) as Box<FirstUsable>
            }),
            steadiness: reference.robustness_check.clone().map(|check| {
                let evaluator = evaluator.clone();
                let steadiness = move |phenotype: &dyn Phenotype, trial, needed| {
                    let usable = |network| evaluator.install(|| check.usable(&network, trial, needed));
                    network(phenotype).map_or(0, usable)
                };
                Box::new(steadiness) as Box<Steadiness>
            }),
            steadiest: reference.robustness_check.clone().filter(|_| commanded).map(|check| {
                let evaluator = evaluator.clone();
                let steadiest = move |phenotypes: &[&dyn Phenotype]| {
                    let networks = networks(phenotypes);
                    evaluator.install(|| check.steadiest(&networks, Trial::Commands))
                };
                Box::new(steadiest) as Box<Steadiest>
            }),
            steps: steps_of(reference),
            seed: reference.seed,
            evaluator,
        }
    }

    /// The highest tier.
    fn highest(&self) -> u8 {
        USABLE + self.steps.len() as u8
    }

    /// In how many worlds of a trial a gait must be usable for this tier.
    fn needed(&self, trial: Trial, tier: u8) -> usize {
        let tiers = self.steps.iter().zip(USABLE + 1..).filter(|&(&(of, _), step)| of == trial && step <= tier);
        tiers.map(|(&(_, worlds), _)| worlds).max().unwrap_or(0)
    }

    /// Tiers: 0 for a gait that is not known to be usable, and from [`USABLE`] on the more perturbed worlds it is usable in.
    /// Gaits are judged, the most promising first, until one is usable, or enough of them to be [compared](Self::best_of). That one,
    /// or the best of these, is tried in the perturbed worlds. One that would not become champion whatever came of it is not looked at.
    fn tiers<G: Genome>(
        &self,
        candidates: &[G],
        evaluations: &[Evaluation],
        standing: Option<TieredFitness>,
    ) -> Vec<u8> {
        let mut tiers = vec![0; candidates.len()];
        let Some(usable) = &self.usable else { return tiers };
        let kept = self.kept(candidates, evaluations);
        let place = |index: usize, tier: u8| Some(TieredFitness { tier, fitness: evaluations[index].fitness()? });
        let hoped = |index: usize| place(index, self.hoped(kept[index], standing));
        let mut able: Vec<usize> = (0..candidates.len()).filter(|&index| hoped(index) > standing).collect();
        able.sort_by_key(|&index| Reverse((kept[index], evaluations[index].fitness())));
        // Those that keep most come first; where they are slow and safe, and not usable, the fittest have their turn.
        let mut fittest = able.clone();
        fittest.sort_by_key(|&index| Reverse(evaluations[index].fitness()));
        let (judged, most) = if self.steadiest.is_some() { (COMPARED, COMPARED) } else { (JUDGED, 1) };
        let first = &able[..able.len().min(judged)];
        let fittest = fittest.iter().take(judged).filter(|index| !first.contains(index));
        let tried: Vec<usize> = first.iter().chain(fittest).copied().collect();
        let controllers: Vec<G::Phenotype> = tried.iter().map(|&index| candidates[index].express()).collect();
        let controllers: Vec<&dyn Phenotype> = controllers.iter().map(|net| net as &dyn Phenotype).collect();
        let usable =
            tracing::debug_span!("gaits", candidates = controllers.len()).in_scope(|| usable(&controllers, most));
        // Those that may get no high tier are not compared with those that may.
        let most_hoped = usable.iter().map(|&place| self.hoped(kept[tried[place]], standing)).max();
        let usable: Vec<usize> =
            usable.into_iter().filter(|&place| Some(self.hoped(kept[tried[place]], standing)) == most_hoped).collect();
        if let Some(best) = self.best_of(&controllers, &usable) {
            let best = tried[best];
            let hoped = self.hoped(kept[best], standing);
            let enough = (USABLE..=hoped).find(|&tier| place(best, tier) > standing).unwrap_or(hoped);
            tiers[best] = self.steady(&candidates[best], enough, hoped);
        }
        tiers
    }

    /// Of these usable controllers the first, or, where they are compared, the one that is usable in most schedules.
    fn best_of(&self, controllers: &[&dyn Phenotype], usable: &[usize]) -> Option<usize> {
        match &self.steadiest {
            Some(steadiest) if usable.len() > 1 => {
                let _span = tracing::debug_span!("compared", candidates = usable.len()).entered();
                let chosen: Vec<&dyn Phenotype> = usable.iter().map(|&index| controllers[index]).collect();
                steadiest(&chosen).map(|best| usable[best])
            }
            _ => usable.first().copied(),
        }
    }

    /// The tier that a usable candidate may get. The first champion that is usable need not be more than that: it is
    /// wanted at once. But one that is told what to do is of little use if it does so in one schedule alone; and where it is the
    /// champion of the stage before, a candidate that is worse would soon take its place.
    fn hoped(&self, kept: Kept, standing: Option<TieredFitness>) -> u8 {
        let first = self.steadiest.is_none() && standing.is_none_or(|standing| standing.tier < USABLE);
        match kept {
            _ if first || self.steadiness.is_none() => USABLE,
            Kept::Little => USABLE + 1,
            Kept::Half | Kept::Most => self.highest(),
        }
    }

    /// The tier of a usable candidate, up to `hoped`. A tier below `enough` is of no use, and given as [`USABLE`].
    fn steady<G: Genome>(&self, candidate: &G, enough: u8, hoped: u8) -> u8 {
        let Some(steadiness) = &self.steadiness else { return USABLE };
        let controller = candidate.express();
        let (mut tier, mut last) = (USABLE, None);
        for &(trial, worlds) in &self.steps[..usize::from(hoped - USABLE)] {
            let known = last.filter(|&(known, _)| known == trial);
            let (_, usable) = known.unwrap_or_else(|| {
                let span = tracing::debug_span!("perturbed worlds", ?trial);
                (trial, span.in_scope(|| steadiness(&controller, trial, self.needed(trial, enough))))
            });
            last = Some((trial, usable));
            if usable < worlds {
                break;
            }
            tier += 1;
        }
        if tier < enough { USABLE } else { tier }
    }

    /// How much of its fitness each keeps in varied worlds; little for a candidate with less than half of the best
    /// fitness here, since it is easy to keep little.
    fn kept<G: Genome>(&self, candidates: &[G], evaluations: &[Evaluation]) -> Vec<Kept> {
        let mut kept = vec![Kept::Little; candidates.len()];
        let Some(proof) = &self.proof else { return kept };
        let fitness = |index: usize| evaluations[index].fitness().map_or(0.0, Fitness::get);
        let best = (0..candidates.len()).map(fitness).fold(0.0, f64::max);
        let fit: Vec<usize> =
            (0..candidates.len()).filter(|&index| fitness(index) > 0.0 && fitness(index) >= 0.5 * best).collect();
        let genomes: Vec<G> = fit.iter().map(|&index| candidates[index].clone()).collect();
        let evaluations =
            tracing::debug_span!("varied episodes").in_scope(|| self.evaluator.evaluate(&**proof, &genomes, self.seed));
        for (&index, varied) in fit.iter().zip(evaluations) {
            let share = varied.fitness().map_or(0.0, Fitness::get) / fitness(index);
            kept[index] = match share {
                _ if share >= 0.75 => Kept::Most,
                _ if share >= 0.25 => Kept::Half,
                _ => Kept::Little,
            };
        }
        kept
    }

    /// Whether rapier finds the best of these as good as they say, if there is one that is to become champion.
    fn confirmed<G: Genome>(
        &self,
        reference: &dyn Task,
        candidates: &[G],
        evaluations: &[Evaluation],
        tiers: &[u8],
        standing: Option<TieredFitness>,
    ) -> bool {
        let place = |index: usize| Some(TieredFitness { tier: tiers[index], fitness: evaluations[index].fitness()? });
        let able = (0..candidates.len()).filter(|&index| place(index) > standing);
        let Some(best) = able.min_by_key(|&index| Reverse(place(index))) else { return true };
        let again = tracing::debug_span!("episode in rapier")
            .in_scope(|| self.evaluator.install(|| reference.evaluate(&mut candidates[best].express(), self.seed)));
        let agree = again.outcome == evaluations[best].outcome;
        if !agree {
            let (lanes, rapier) = (&evaluations[best].outcome, &again.outcome);
            tracing::warn!(?lanes, ?rapier, "lanes and rapier diverged; the candidates are judged in rapier");
        }
        agree
    }
}

impl<G: Genome> ChampionSelection<G> for ReferenceSelection {
    fn seed(&self) -> Seed {
        self.seed
    }

    fn takes_recommendation(&self) -> bool {
        self.steadiest.is_some()
    }

    fn judge(&self, candidates: &[G], standing: Option<TieredFitness>) -> ReEvaluation {
        let reference = tracing::debug_span!("reference episodes");
        let evaluations = reference.in_scope(|| self.evaluator.evaluate(&*self.task, candidates, self.seed));
        let tiers = self.tiers(candidates, &evaluations, standing);
        match &self.reference {
            Some(reference) if !self.confirmed(&**reference, candidates, &evaluations, &tiers, standing) => {
                let evaluations = self.evaluator.evaluate(&**reference, candidates, self.seed);
                let tiers = self.tiers(candidates, &evaluations, standing);
                ReEvaluation { evaluations, tiers, diverged: true }
            }
            _ => ReEvaluation { evaluations, tiers, diverged: false },
        }
    }
}

#[cfg(test)]
mod tests;
