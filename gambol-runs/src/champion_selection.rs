//! The champion selection of runs whose worlds vary, whose episodes are short or whose bodies are several: the champion
//! is chosen in one whole episode of the creature, in the world as the configuration has it, and by rapier.

use crate::{
    config::EngineChoice,
    reference::ReferenceEpisode,
    robustness_check::{RobustnessCheck, Trial},
    tiers::USABLE,
};
use ne_core::{
    Evaluation, Evaluator, Fitness, Genome, Parallel, Phenotype, Seed, Task, TieredFitness,
    champion_selection::{ChampionSelection, ReEvaluation},
};
use ne_net::Network;
use std::{borrow::Cow, cmp::Reverse, sync::Arc};
use steps::{Step, steps};

mod steps;

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
    steps: Vec<Step>,
    /// Which of the usable candidates of a re-evaluation goes on, if they are compared.
    steadiest: Option<Box<Steadiest>>,
    choice: Choice,
    seed: Seed,
    evaluator: Arc<Parallel>,
}

/// Says which of these controllers are the first whose gaits are usable, at most so many.
type FirstUsable = dyn Fn(&[&dyn Phenotype], usize) -> Vec<usize> + Send + Sync;

/// Says in how many perturbed worlds of a trial the gait of a controller is usable; any smaller number will do if it is so in
/// fewer than are given.
type Steadiness = dyn Fn(&dyn Phenotype, Trial, usize) -> usize + Send + Sync;

/// Says which of these controllers is usable in most worlds, of equals the first, and in how many.
type Steadiest = dyn Fn(&[&dyn Phenotype]) -> Option<(usize, usize)> + Send + Sync;

/// The highest tier of a champion that is chosen there; `None` where none is chosen, or its gait is not judged.
pub(crate) fn highest_tier(reference: Option<&ReferenceEpisode>) -> Option<u8> {
    let reference = reference.filter(|reference| reference.judge.is_some())?;
    Some(USABLE + steps_of(reference).len() as u8)
}

/// The highest tier that any champion can have.
#[cfg(feature = "schema")]
pub(crate) fn highest_tier_of_all() -> u8 {
    [false, true].into_iter().map(|commanded| USABLE + steps(commanded).len() as u8).fold(USABLE, u8::max)
}

/// The steps that a champion is tried at there; none where nothing varies.
fn steps_of(reference: &ReferenceEpisode) -> Vec<Step> {
    reference.robustness_check.as_ref().map_or_else(Vec::new, |check| steps(check.needs_commands()))
}

/// How the candidate that is tried for a high tier is chosen.
#[derive(Clone, Copy, Debug)]
struct Choice {
    /// So many of the best have their gaits judged.
    judged: usize,
    /// So many that are usable are compared: what gaits earn says little of how often they fail.
    compared: usize,
    /// In the worlds of this trial.
    trial: Trial,
    /// Whether the first that is usable becomes champion at once, whatever else there is.
    first_at_once: bool,
}

impl Choice {
    /// Of gaits that are told what to do or are not, in a run that goes on from another or does not: if the champion that it brings had
    /// only the lowest tier, a worse candidate would soon replace it.
    const fn of(commanded: bool, goes_on: bool) -> Self {
        match commanded {
            // The trial that also gives the tier, so it is not held again.
            false => Self { judged: 8, compared: 4, trial: Trial::Short, first_at_once: !goes_on },
            // A gait that does as it is told in one schedule may fail in most others.
            true => Self { judged: 16, compared: 16, trial: Trial::Commands, first_at_once: false },
        }
    }
}

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

/// The count of a trial that was held.
fn count(known: &[(Trial, usize)], trial: Trial) -> Option<usize> {
    known.iter().find(|(held, _)| *held == trial).map(|&(_, usable)| usable)
}

fn network(phenotype: &dyn Phenotype) -> Option<Network> {
    Network::of(phenotype).map(Cow::into_owned)
}

/// All are nets, or none is.
fn networks(phenotypes: &[&dyn Phenotype]) -> Vec<Network> {
    phenotypes.iter().filter_map(|net| network(*net)).collect()
}

impl ReferenceSelection {
    /// The champion selection of a run, which goes on from what another has found or does not.
    pub(crate) fn new(reference: &ReferenceEpisode, goes_on: bool, evaluator: Arc<Parallel>) -> Self {
        let confirmed = reference.task.engine() != EngineChoice::Rapier;
        let commanded = reference.robustness_check.as_ref().is_some_and(RobustnessCheck::needs_commands);
        let choice = Choice::of(commanded, goes_on);
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
            steadiest: reference.robustness_check.clone().map(|check| {
                let evaluator = evaluator.clone();
                let steadiest = move |phenotypes: &[&dyn Phenotype]| {
                    let networks = networks(phenotypes);
                    evaluator.install(|| check.steadiest(&networks, choice.trial))
                };
                Box::new(steadiest) as Box<Steadiest>
            }),
            steps: steps_of(reference),
            choice,
            seed: reference.seed,
            evaluator,
        }
    }

    /// The highest tier.
    fn highest(&self) -> u8 {
        USABLE + self.steps.len() as u8
    }

    /// The least number of worlds of a trial for this tier. Other trials count with what is known of them, and before they are held with
    /// all of their worlds.
    fn needed(&self, trial: Trial, tier: u8, known: &[(Trial, usize)]) -> usize {
        let steps = self.steps[..usize::from(tier - USABLE)].iter().filter(|step| step.trials.contains(&trial));
        let of = |other: Trial| count(known, other).unwrap_or(other.worlds());
        let others = |step: &Step| step.trials.iter().filter(|&&other| other != trial).map(|&other| of(other)).sum();
        steps.map(|step| step.worlds.saturating_sub(others(step))).max().unwrap_or(0)
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
        let Choice { judged, compared, .. } = self.choice;
        let most = if self.steadiest.is_none() || self.is_wanted_at_once(standing) { 1 } else { compared };
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
        if let Some((best, known)) = self.best_of(&controllers, &usable) {
            let best = tried[best];
            let hoped = self.hoped(kept[best], standing);
            let enough = (USABLE..=hoped).find(|&tier| place(best, tier) > standing).unwrap_or(hoped);
            tiers[best] = self.steady(&candidates[best], known, enough, hoped);
        }
        tiers
    }

    /// Of these usable controllers the first, or, where they are compared, the one that is usable in most worlds; and in how many it is
    /// known to be.
    fn best_of(&self, controllers: &[&dyn Phenotype], usable: &[usize]) -> Option<(usize, Option<(Trial, usize)>)> {
        match &self.steadiest {
            Some(steadiest) if usable.len() > 1 => {
                let _span = tracing::debug_span!("compared", candidates = usable.len()).entered();
                let chosen: Vec<&dyn Phenotype> = usable.iter().map(|&index| controllers[index]).collect();
                steadiest(&chosen).map(|(best, worlds)| (usable[best], Some((self.choice.trial, worlds))))
            }
            _ => usable.first().map(|&first| (first, None)),
        }
    }

    /// Whether the first that is usable becomes champion, and is not tried any further.
    fn is_wanted_at_once(&self, standing: Option<TieredFitness>) -> bool {
        self.choice.first_at_once && standing.is_none_or(|standing| standing.tier < USABLE)
    }

    /// The tier that a usable candidate may get.
    fn hoped(&self, kept: Kept, standing: Option<TieredFitness>) -> u8 {
        match kept {
            _ if self.steadiness.is_none() || self.is_wanted_at_once(standing) => USABLE,
            Kept::Little => USABLE + 1,
            Kept::Half | Kept::Most => self.highest(),
        }
    }

    /// The tier of a usable candidate, of which may be known in how many worlds of one trial it is usable, up to `hoped`. A tier below
    /// `enough` is of no use, and given as [`USABLE`].
    fn steady<G: Genome>(&self, candidate: &G, known: Option<(Trial, usize)>, enough: u8, hoped: u8) -> u8 {
        let Some(steadiness) = &self.steadiness else { return USABLE };
        let controller = candidate.express();
        let (mut tier, mut known) = (USABLE, Vec::from_iter(known));
        for step in &self.steps[..usize::from(hoped - USABLE)] {
            for &trial in step.trials {
                let needed = self.needed(trial, enough, &known);
                if count(&known, trial).is_none() {
                    let span = tracing::debug_span!("perturbed worlds", ?trial);
                    known.push((trial, span.in_scope(|| steadiness(&controller, trial, needed))));
                }
                // Other trials could not make up for it.
                if count(&known, trial) < Some(needed) {
                    return USABLE;
                }
            }
            let usable: usize = step.trials.iter().filter_map(|&trial| count(&known, trial)).sum();
            if usable < step.worlds {
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
