//! How much of a champion's gait is left in worlds that are not quite the one it learned in.
//!
//! A gait that is usable in one exact world may lean on it: on one friction, one time step, one perfectly flat floor. A
//! game has none of them. So a champion is replayed under many perturbations of the world, each judged by the rules the
//! champion itself is judged by, alone and without near worlds, and what is told is the share that stays usable and the part of the fitness that is kept.

use crate::Registry;
use crate::{
    champion::Champion,
    episode_parts::SetupError,
    judge::{
        Judge,
        worlds::{Worlds, is_usable},
    },
    perturbation::World,
};
use envs_core::{Conditions, Variation};
use envs_lanes::LANES;
use ne_core::{Purpose, Seed, SettingError};
use ne_net::Network;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use tasks::gait::{GaitReport, View};

pub use crate::perturbation::{BUMP_HEIGHTS, Cause, FRICTION, MASS, TORQUE};

/// The most perturbations.
const MOST: u32 = 100_000;

/// Bumps reach this far beyond where the champion gets in the unperturbed world, m.
const BEYOND: f32 = 5.0;

/// What is left of a champion's gait.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Robustness {
    /// The name of the rules by which its gaits are judged.
    pub judged_as: String,
    /// How they look at them.
    pub view: View,
    /// Whether the ground has bumps; a terrain that is not flat has none, and is laid out anew in each world.
    #[serde(skip)]
    pub bumpy: bool,
    /// Whether it follows commands: those of each world are others, so that its progress says nothing.
    #[serde(skip)]
    pub commanded: bool,
    /// Whether it is usable without perturbation, and in near worlds.
    pub usable_unperturbed: bool,
    /// How far it runs, or how high it jumps, without perturbation, m.
    #[serde(rename = "progress_unperturbed_m")]
    pub progress_unperturbed: f64,
    /// Share of the perturbed worlds in which its gait is usable, 0 to 1.
    pub usable_share: f64,
    /// The share of each cause's worlds in which it is usable, in order of [`Cause::ALL`], or of the given variation's worlds alone;
    /// causes without a world are left out.
    pub causes: Vec<CauseShare>,
    /// The median of progress in a perturbed world over that without perturbation; `None` if there was none without, and where it
    /// follows commands.
    pub fitness_kept: Option<f64>,
    /// The share of the perturbed worlds in which each [reason](tasks::gait::Reason::name) speaks against it, the most
    /// frequent first.
    pub reasons: Vec<ReasonShare>,
    /// Every perturbed world.
    pub trials: Vec<PerturbedTrial>,
}

/// How a gait bears one cause.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CauseShare {
    /// What is changed.
    pub cause: Cause,
    /// In so many worlds.
    pub worlds: usize,
    /// Share of these in which the gait is usable, 0 to 1.
    pub usable_share: f64,
}

/// How often a reason speaks against a gait.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReasonShare {
    /// Its name.
    pub reason: String,
    /// Share of the perturbed worlds, 0 to 1.
    pub share: f64,
}

/// What a champion did in a perturbed world.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PerturbedTrial {
    /// What is changed.
    pub cause: Cause,
    /// Factor on the ground's friction.
    pub friction: f32,
    /// Factor on the mass.
    pub mass: f32,
    /// Factor on the motors' top torque.
    pub torque: f32,
    /// Factor on gravity.
    pub gravity: f32,
    /// Factor on the motors' gain.
    pub motor_gain: f32,
    /// Solver iterations a step; `None`: those of the champion's settings.
    pub solver_iterations: Option<u32>,
    /// Factor on the natural frequency of joints.
    pub joint_frequency: f32,
    /// Factors on the natural frequency and the damping of contacts.
    pub contacts: [f32; 2],
    /// How many pushes there are in 120 s.
    pub pushes: usize,
    /// Seconds a step lasts.
    #[serde(rename = "time_step_s")]
    pub time_step: f32,
    /// How many bumps there are on the ground.
    pub bumps: usize,
    /// Whether its gait is usable.
    pub usable: bool,
    /// How far it ran, or how high it jumped, m; 0 if there is nothing to measure.
    #[serde(rename = "progress_m")]
    pub progress: f64,
    /// What speaks against it.
    pub reasons: Vec<String>,
}

/// The reason where there is nothing to measure: the body explodes, or does not come to rest at the start.
const UNMEASURABLE: &str = "nothing-to-measure";

/// Why nothing can be said of a champion.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RobustnessError {
    /// Its world cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// There is no telling what is usable.
    #[error("the movement \"{movement}\" is not judged: only {} are", judged.join(", "))]
    NotJudged {
        /// Its name.
        movement: String,
        /// Those that are.
        judged: Vec<String>,
    },
}

/// The worlds a champion is replayed in.
#[derive(Clone, Debug, PartialEq)]
pub struct Perturbations {
    /// How many, from 1 to 100,000.
    pub count: u32,
    /// What they are drawn from.
    pub seed: u64,
    /// Draws the worlds as those of training, in place of the causes; `near_first` has no effect.
    pub variation: Option<Variation>,
}

impl Default for Perturbations {
    /// 100 worlds of seed 1, in which causes take turns.
    fn default() -> Self {
        Self { count: 100, seed: 1, variation: None }
    }
}

/// For the commands in perturbed worlds: other ones than those by which a champion was chosen, whatever the seed.
const ROBUSTNESS: Purpose = Purpose::new("commands of robustness");

/// Replays a champion in perturbed worlds, on the threads of the current pool. What comes out is a function of champion and
/// perturbations, whatever the threads.
///
/// # Errors
/// As [`PerturbedReplays::new`].
pub fn robustness(
    champion: &Champion,
    registry: &Registry,
    perturbations: &Perturbations,
) -> Result<Robustness, RobustnessError> {
    let mut replays = PerturbedReplays::new(champion, registry, perturbations)?;
    replays.go_on(perturbations.count as usize);
    Ok(replays.robustness())
}

/// The replays of a champion in perturbed worlds, a few at a time: for programs that do something else between them.
pub struct PerturbedReplays {
    judge: Judge,
    network: Network,
    perturbations: Perturbations,
    unperturbed: Option<GaitReport>,
    trials: Vec<PerturbedTrial>,
    /// How the rules are called, and how they look at gaits.
    rules: (String, View),
    bumpy: bool,
    commanded: bool,
}

impl PerturbedReplays {
    /// The worlds that are replayed at once, on one thread.
    pub const FEW: usize = LANES;

    /// Replays the champion in the world where it learned, and in none that is perturbed yet.
    ///
    /// # Errors
    /// If the number of worlds or a field of the variation or the champion is out of range, or its movement is unknown or not judged.
    pub fn new(
        champion: &Champion,
        registry: &Registry,
        perturbations: &Perturbations,
    ) -> Result<Self, RobustnessError> {
        SettingError::check_range("perturbations", perturbations.count, 1.0, MOST.into())?;
        if let Some(variation) = perturbations.variation {
            variation.validate().map_err(|error| error.within("variation"))?;
        }
        let judge = Judge::new(champion.episode_parts(), registry)?;
        let rules = judge.rules().ok_or_else(|| RobustnessError::NotJudged {
            movement: champion.movement.name.clone(),
            judged: registry.movements.judged().map(str::to_owned).collect(),
        })?;
        Ok(Self {
            rules: (rules.name().to_owned(), rules.view()),
            commanded: rules.needs_commands(),
            unperturbed: judge.judge(&champion.network),
            bumpy: champion.terrain.is_flat(),
            network: champion.network.clone(),
            perturbations: perturbations.clone(),
            trials: Vec::new(),
            judge,
        })
    }

    /// In how many perturbed worlds it was replayed, and of how many.
    pub fn progress(&self) -> [usize; 2] {
        [self.trials.len(), self.perturbations.count as usize]
    }

    /// Replays it in so many more worlds, or as many as are left. More than a [`FEW`](Self::FEW) are shared among the threads
    /// of the current pool.
    pub fn go_on(&mut self, worlds: usize) {
        let from = self.trials.len() as u32;
        let indices: Vec<u32> = (from..self.perturbations.count).take(worlds).collect();
        let trials: Vec<_> = match indices.len() {
            0..=Self::FEW => self.replay(&indices),
            _ => indices.par_chunks(Self::FEW).flat_map_iter(|indices| self.replay(indices)).collect(),
        };
        self.trials.extend(trials);
    }

    /// What is left of its gait in the worlds that it was replayed in.
    pub fn robustness(self) -> Robustness {
        let progress_unperturbed = self.progress_unperturbed();
        let Self { trials, unperturbed, rules: (judged_as, view), bumpy, commanded, .. } = self;
        let share = |count: usize| count as f64 / trials.len().max(1) as f64;
        let kept = || median(trials.iter().map(|trial| trial.progress / progress_unperturbed).collect());
        let reasons = reasons(&trials).into_iter();
        Robustness {
            judged_as,
            view,
            bumpy,
            commanded,
            usable_unperturbed: unperturbed.as_ref().is_some_and(is_usable),
            progress_unperturbed,
            usable_share: share(trials.iter().filter(|trial| trial.usable).count()),
            causes: causes(&trials),
            fitness_kept: (!commanded && progress_unperturbed > 0.0 && !trials.is_empty()).then(kept),
            reasons: reasons
                .map(|(reason, count)| ReasonShare { reason: reason.to_owned(), share: share(count) })
                .collect(),
            trials,
        }
    }

    fn progress_unperturbed(&self) -> f64 {
        self.unperturbed.as_ref().map_or(0.0, GaitReport::progress)
    }

    /// Replays it in the worlds of these indices, which follow each other. Each has commands of its own.
    fn replay(&self, indices: &[u32]) -> Vec<PerturbedTrial> {
        let Perturbations { seed, variation, .. } = self.perturbations;
        let reach = self.progress_unperturbed().abs() as f32 + BEYOND;
        let draw = |&index: &u32| match variation {
            Some(variation) => World::draw_of(variation, Seed::of_run(seed), index, &self.judge),
            None => World::draw(Seed::of_run(seed), index, &self.judge, reach),
        };
        let worlds: Vec<World> = indices.iter().map(draw).collect();
        let places: Vec<_> = worlds.iter().map(|world| (world.conditions.clone(), world.landscape.clone())).collect();
        let judge = self.judge.clone().drawing_from(Seed::of_run(seed), ROBUSTNESS);
        let first = indices.first().copied().unwrap_or_default();
        let reports = Worlds::new(&judge, &places).beginning_with_trial(first).judge(&self.network);
        worlds.into_iter().zip(reports).map(|(world, report)| PerturbedTrial::new(&world, report)).collect()
    }
}

/// How each cause is borne.
fn causes(trials: &[PerturbedTrial]) -> Vec<CauseShare> {
    let share = |cause| {
        let worlds = trials.iter().filter(|trial| trial.cause == cause);
        let usable = worlds.clone().filter(|trial| trial.usable).count();
        let worlds = worlds.count();
        (worlds > 0).then(|| CauseShare { cause, worlds, usable_share: usable as f64 / worlds as f64 })
    };
    Cause::ALL.into_iter().chain([Cause::Variation]).filter_map(share).collect()
}

/// How many trials each reason speaks against, the most first.
fn reasons(trials: &[PerturbedTrial]) -> Vec<(&str, usize)> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for reason in trials.iter().flat_map(|trial| &trial.reasons) {
        *counts.entry(reason).or_default() += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by_key(|&(_, count)| std::cmp::Reverse(count));
    counts
}

/// The middle value, or the mean of the two middle ones. Of at least one.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (low, high) = (values[(values.len() - 1) / 2], values[values.len() / 2]);
    0.5 * (low + high)
}

impl PerturbedTrial {
    fn new(world: &World, report: Option<GaitReport>) -> Self {
        let Conditions { friction, mass, torque, gravity, motor_gain, solver_iterations, joint_frequency, .. } =
            world.conditions;
        let mut reasons: Vec<_> = match report.as_ref().and_then(|report| report.verdict.as_ref()) {
            Some(verdict) => verdict.reasons.iter().map(|reason| reason.name().to_owned()).collect(),
            None => vec![UNMEASURABLE.to_owned()],
        };
        // Two legs may have the same reason.
        reasons.sort_unstable();
        reasons.dedup();
        Self {
            cause: world.cause,
            gravity,
            motor_gain,
            solver_iterations,
            joint_frequency,
            contacts: [world.conditions.contact_frequency, world.conditions.contact_damping],
            pushes: world.conditions.pushes.len(),
            friction,
            mass,
            torque,
            time_step: world.time_step,
            bumps: world.bumps,
            usable: report.as_ref().is_some_and(is_usable),
            progress: report.as_ref().map_or(0.0, GaitReport::progress),
            reasons,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robustness_check::tests::champion;
    use ne_core::StopConditions;

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }

    /// Else a run with the seed of `--seed` would be tried by what chose its champion.
    #[test]
    fn commands_are_others_than_those_of_training_with_the_same_seed() {
        let judge = crate::perturbation::tests::judge("biped-1", "jumping");
        let seed = |purpose| judge.clone().drawing_from(Seed::of_run(1), purpose).seed();
        assert_ne!(seed(ROBUSTNESS), seed(crate::judge::TRAINING));
    }

    /// In worlds that nothing else tells apart.
    #[test]
    fn every_world_has_commands_of_its_own() {
        let registry = Registry::default();
        let stop = StopConditions { generations: Some(1), ..StopConditions::default() };
        let champion = champion("tetrapod-1", "playing", 1, stop);
        let ways = |seed, count| -> Vec<u64> {
            let perturbations = Perturbations { count, seed, variation: Some(Variation::default()) };
            let robustness = robustness(&champion, &registry, &perturbations).expect("it is judged");
            robustness.trials.iter().map(|trial| trial.progress.to_bits()).collect()
        };
        // More than lanes play at once.
        let (mut all, others) = (ways(1, 40), ways(2, 2));
        assert_eq!(all[..20], ways(1, 20));
        let perturbations = Perturbations { count: 40, seed: 1, variation: Some(Variation::default()) };
        let mut replays = PerturbedReplays::new(&champion, &registry, &perturbations).expect("it is judged");
        while replays.progress()[0] < 40 {
            let few = if replays.progress()[0] == 0 { PerturbedReplays::FEW } else { 20 };
            replays.go_on(few);
        }
        let in_steps = replays.robustness().trials;
        assert_eq!(in_steps.iter().map(|trial| trial.progress.to_bits()).collect::<Vec<_>>(), all, "a few at a time");
        assert!(others.iter().all(|way| !all.contains(way)), "another seed, other commands");
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 40);
    }

    #[test]
    fn reasons_are_told_by_how_often_they_hold() {
        let trial = |reasons: &[&str]| PerturbedTrial {
            cause: Cause::Friction,
            gravity: 1.0,
            motor_gain: 1.0,
            solver_iterations: None,
            joint_frequency: 1.0,
            contacts: [1.0; 2],
            pushes: 0,
            friction: 1.0,
            mass: 1.0,
            torque: 1.0,
            time_step: 0.02,
            bumps: 0,
            usable: false,
            progress: 0.0,
            reasons: reasons.iter().map(|&reason| reason.to_owned()).collect(),
        };
        let trials = [trial(&["slow"]), trial(&["slow", "tilted"]), trial(&[]), trial(&["fall", "tilted", "slow"])];
        assert_eq!(reasons(&trials), [("slow", 3), ("tilted", 2), ("fall", 1)]);
    }
}
