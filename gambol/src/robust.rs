//! How much of a champion's gait is left in worlds that are not quite the one it learned in.
//!
//! A gait that is usable in one exact world may lean on it: on one friction, one time step, one perfectly flat floor. A
//! game has none of them. So a champion is replayed in rapier under many perturbations of the world, each judged as the
//! champion itself is judged, and what is told is the share that stays usable and the part of the fitness that is kept.

use crate::{champion::Champion, gait::Stage, setup::SetupError};
use envs_core::{Conditions, Ground, GroundShape};
use ne_core::{Purpose, RandomStream, Seed, SettingError};
use rand::RngExt;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use tasks::{
    Environment, MovementCatalogue,
    gait::{GaitReport, Kind},
};

const PERTURBATION: Purpose = Purpose::new("perturbation");

/// The friction of the ground is changed by up to this share, either way.
pub const FRICTION: f32 = 0.3;
/// The mass of all parts together is.
pub const MASS: f32 = 0.1;
/// The top torque of all motors together is.
pub const TORQUE: f32 = 0.1;
/// The shortest and the longest time step, s; drawn log-uniformly.
pub const TIME_STEPS: [f32; 2] = [1.0 / 120.0, 1.0 / 40.0];
/// The highest bump, m.
pub const HIGHEST_BUMP: f32 = 0.02;

/// The narrowest and the widest bump, m.
const BUMP_WIDTHS: [f32; 2] = [0.2, 0.6];
/// The shortest and the longest flat stretch between two bumps, m.
const BUMP_GAPS: [f32; 2] = [0.3, 1.5];
/// How far a bump reaches below the ground, m: a foot that sinks in is pushed up, and not out at the bottom.
const BUMP_DEPTH: f32 = 0.5;
/// The start pose is clear of bumps by this much, m.
const CLEARANCE: f32 = 0.2;
/// Bumps reach this far beyond where the champion gets in the unperturbed world, and behind its start, m.
const BEYOND: f32 = 5.0;
/// No bumps beyond this, m: nobody gets there.
const FARTHEST: f32 = 500.0;

/// The most perturbations.
const MOST: u32 = 100_000;

/// What is left of a champion's gait.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Robustness {
    /// As what its gaits are judged.
    pub kind: Kind,
    /// Whether it is usable without perturbation.
    pub usable_unperturbed: bool,
    /// How far it runs, or how high it jumps, without perturbation, m.
    #[serde(rename = "progress_unperturbed_m")]
    pub progress_unperturbed: f64,
    /// Share of the perturbed worlds in which its gait is usable, 0 to 1.
    pub usable_share: f64,
    /// The median of progress in a perturbed world over that without perturbation; `None` if there was none without.
    pub fitness_kept: Option<f64>,
    /// The share of the perturbed worlds in which each [reason](tasks::gait::Reason::name) speaks against it, the most
    /// frequent first.
    pub reasons: Vec<ReasonShare>,
    /// Every perturbed world.
    pub trials: Vec<PerturbedTrial>,
}

/// How often a reason speaks against a gait.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReasonShare {
    /// Its name.
    pub reason: &'static str,
    /// Share of the perturbed worlds, 0 to 1.
    pub share: f64,
}

/// What a champion did in a perturbed world.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PerturbedTrial {
    /// Factor on the ground's friction.
    pub friction: f32,
    /// Factor on the mass.
    pub mass: f32,
    /// Factor on the motors' top torque.
    pub torque: f32,
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
    pub reasons: Vec<&'static str>,
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
    #[error("the movement \"{movement}\" is not judged: only running and jumping are")]
    NotJudged {
        /// Its name.
        movement: String,
    },
}

/// Replays a champion in so many perturbed worlds (1 to 100 000), on the threads of the current pool. What comes out is a
/// function of champion, number and seed, whatever the threads.
///
/// # Errors
/// If the number is out of range, a field of the champion is, or its movement is unknown or not judged.
pub fn robustness(
    champion: &Champion,
    catalogue: &MovementCatalogue,
    perturbations: u32,
    seed: u64,
) -> Result<Robustness, RobustnessError> {
    SettingError::check_range("perturbations", perturbations.into(), 1.0, MOST.into())?;
    let stage = Stage::new(champion.episode_parts(), catalogue)?;
    let not_judged = || RobustnessError::NotJudged { movement: champion.movement.name.clone() };
    let kind = stage.kind().ok_or_else(not_judged)?;
    let unperturbed = stage.judge(&champion.network);
    let progress_unperturbed = unperturbed.as_ref().map_or(0.0, |report| progress(kind, report));
    let trials: Vec<PerturbedTrial> = (0..perturbations)
        .into_par_iter()
        .map(|index| {
            let world = World::draw(Seed::of_run(seed).trial(index), &stage, progress_unperturbed as f32);
            let report = stage.under(&world.conditions, world.ground.clone(), catalogue).ok();
            world.told(kind, report.and_then(|stage| stage.judge(&champion.network)))
        })
        .collect();
    let share = |count: usize| count as f64 / f64::from(perturbations);
    Ok(Robustness {
        kind,
        usable_unperturbed: unperturbed.as_ref().is_some_and(is_usable),
        progress_unperturbed,
        usable_share: share(trials.iter().filter(|trial| trial.usable).count()),
        fitness_kept: (progress_unperturbed > 0.0)
            .then(|| median(trials.iter().map(|trial| trial.progress / progress_unperturbed).collect())),
        reasons: reasons(&trials)
            .into_iter()
            .map(|(reason, count)| ReasonShare { reason, share: share(count) })
            .collect(),
        trials,
    })
}

fn is_usable(report: &GaitReport) -> bool {
    report.verdict.as_ref().is_some_and(|verdict| verdict.usable)
}

/// What the movement is about, m.
fn progress(kind: Kind, report: &GaitReport) -> f64 {
    match kind {
        Kind::Running => report.travel.distance,
        Kind::Jumping => report.aloft.highest.unwrap_or(0.0),
    }
}

/// How many trials each reason speaks against, the most first.
fn reasons(trials: &[PerturbedTrial]) -> Vec<(&'static str, usize)> {
    let mut counts: BTreeMap<&'static str, usize> = BTreeMap::new();
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

/// A perturbed world.
struct World {
    conditions: Conditions,
    ground: Ground,
    /// s.
    time_step: f32,
}

impl World {
    /// `progress`: how far the champion gets without perturbation, m.
    fn draw(seed: Seed, stage: &Stage, progress: f32) -> Self {
        let environment = stage.environment();
        let mut stream = seed.stream(PERTURBATION);
        let mut factor = |share: f32| uniform(&mut stream, [1.0 - share, 1.0 + share]);
        let (friction, mass, torque) = (factor(FRICTION), factor(MASS), factor(TORQUE));
        let time_step = libm::expf(uniform(&mut stream, TIME_STEPS.map(libm::logf)));
        let nominal = environment.settings().time_step;
        let conditions = Conditions {
            friction,
            mass,
            torque,
            time_step: time_step / nominal,
            ..Conditions::nominal(environment.outputs())
        };
        let [left, _, right, _] = environment.blueprint().bounding_box();
        let mut ground = Ground::flat();
        add_bumps(&mut ground, &mut stream, right + CLEARANCE, 1.0, (right + progress.abs() + BEYOND).min(FARTHEST));
        add_bumps(&mut ground, &mut stream, left - CLEARANCE, -1.0, left - BEYOND);
        Self { conditions, ground, time_step }
    }

    fn told(self, kind: Kind, report: Option<GaitReport>) -> PerturbedTrial {
        let Conditions { friction, mass, torque, .. } = self.conditions;
        let mut reasons: Vec<_> = match report.as_ref().and_then(|report| report.verdict.as_ref()) {
            Some(verdict) => verdict.reasons.iter().map(tasks::gait::Reason::name).collect(),
            None => vec![UNMEASURABLE],
        };
        // Two legs may have the same reason.
        reasons.sort_unstable();
        reasons.dedup();
        PerturbedTrial {
            friction,
            mass,
            torque,
            time_step: self.time_step,
            bumps: self.ground.shapes.len() - 1,
            usable: report.as_ref().is_some_and(is_usable),
            progress: report.as_ref().map_or(0.0, |report| progress(kind, report)),
            reasons,
        }
    }
}

/// Low flat boxes from one place to another, m; `direction`: 1 forward, −1 backward.
fn add_bumps(ground: &mut Ground, stream: &mut RandomStream, from: f32, direction: f32, to: f32) {
    let mut edge = from;
    loop {
        let gap = uniform(stream, BUMP_GAPS);
        let width = uniform(stream, BUMP_WIDTHS);
        // From 0 (not drawn) to, and with, the highest.
        let top = HIGHEST_BUMP * (1.0 - stream.random::<f32>());
        let x = edge + direction * (gap + 0.5 * width);
        if direction * (x - to) > 0.0 {
            return;
        }
        let (y, height) = (0.5 * (top - BUMP_DEPTH), top + BUMP_DEPTH);
        ground.shapes.push(GroundShape::Box { x, y, width, height });
        edge = x + direction * 0.5 * width;
    }
}

fn uniform(stream: &mut RandomStream, [low, high]: [f32; 2]) -> f32 {
    low + (high - low) * stream.random::<f32>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::EpisodeParts;
    use creatures::{Actuation, DEFAULT_INPUT_RANGE};
    use envs_rapier::{PhysicsSettings, Variation};
    use ne_net::{DenseNet, DenseShape};
    use tasks::{MovementSpec, Trials};

    fn stage(creature: &str, movement: &str) -> Stage {
        let parts = EpisodeParts {
            creature: &creatures::find(creature).expect("shipped"),
            sensors: None,
            input_range: DEFAULT_INPUT_RANGE,
            movement: &MovementSpec { name: movement.into(), steps: None, terms: Vec::new() },
            trials: Trials::default(),
            variation: Variation::default(),
            physics: PhysicsSettings::default(),
            actuation: Actuation::default(),
        };
        Stage::new(parts, &MovementCatalogue::default()).expect("builds")
    }

    #[test]
    fn worlds_are_in_range_and_leave_the_start_pose_clear() {
        for name in ["apod", "biped-1", "decapod-2"] {
            let stage = stage(name, "running");
            let [left, _, right, _] = stage.environment().blueprint().bounding_box();
            for index in 0..200 {
                let seed = Seed::of_run(3).trial(index);
                let World { conditions, ground, time_step } = World::draw(seed, &stage, 10.0);
                assert!((conditions.friction - 1.0).abs() <= FRICTION + 1e-6);
                assert!((conditions.mass - 1.0).abs() <= MASS + 1e-6);
                assert!((conditions.torque - 1.0).abs() <= TORQUE + 1e-6);
                assert!((TIME_STEPS[0] - 1e-6..=TIME_STEPS[1] + 1e-6).contains(&time_step), "{time_step}");
                assert_eq!(ground.validate(), Ok(()));
                assert!(ground.shapes.len() > 8);
                for shape in &ground.shapes[1..] {
                    let GroundShape::Box { x, y, width, height } = *shape else { panic!("a second half space") };
                    let top = y + 0.5 * height;
                    assert!((0.0..=HIGHEST_BUMP + 1e-6).contains(&top), "{top}");
                    let clear = x - 0.5 * width > right || x + 0.5 * width < left;
                    assert!(clear && x < right + 10.0 + BEYOND && x > left - BEYOND, "{x}");
                }
            }
        }
    }

    #[test]
    fn without_perturbation_the_gait_is_the_same_to_the_bit() {
        let stage = stage("tetrapod-1", "jumping");
        let (inputs, outputs) = (stage.environment().inputs(), stage.environment().outputs());
        let shape = DenseShape::new(inputs, vec![], outputs);
        let weights: Vec<f32> = (0..(inputs + 1) * outputs).map(|index| (index % 7) as f32 * 0.3 - 0.8).collect();
        let network = DenseNet::new(shape, &weights).expect("a net").into();
        let nominal = Conditions::nominal(outputs);
        let same = stage.under(&nominal, Ground::flat(), &MovementCatalogue::default()).expect("settles");
        assert_eq!(same.judge(&network).expect("it moves"), stage.judge(&network).expect("it moves"));
        let heavy = Conditions { mass: 1.1, ..nominal };
        let other = stage.under(&heavy, Ground::flat(), &MovementCatalogue::default()).expect("settles");
        assert_ne!(other.judge(&network), stage.judge(&network));
    }

    #[test]
    fn bumps_reach_as_far_as_the_champion() {
        let farthest = |progress: f32| {
            let world = World::draw(Seed::of_run(1), &stage("biped-1", "running"), progress);
            let x = |shape: &GroundShape| if let GroundShape::Box { x, .. } = *shape { x } else { 0.0 };
            world.ground.shapes.iter().map(x).fold(0.0, f32::max)
        };
        assert!((6.0..8.0).contains(&farthest(3.0)), "{}", farthest(3.0));
        assert!((42.0..48.0).contains(&farthest(40.0)), "{}", farthest(40.0));
        assert!(farthest(1e9) <= FARTHEST);
    }

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }

    #[test]
    fn reasons_are_told_by_how_often_they_hold() {
        let trial = |reasons: &[&'static str]| PerturbedTrial {
            friction: 1.0,
            mass: 1.0,
            torque: 1.0,
            time_step: 0.02,
            bumps: 0,
            usable: false,
            progress: 0.0,
            reasons: reasons.to_vec(),
        };
        let trials = [trial(&["slow"]), trial(&["slow", "tilted"]), trial(&[]), trial(&["fall", "tilted", "slow"])];
        assert_eq!(reasons(&trials), [("slow", 3), ("tilted", 2), ("fall", 1)]);
    }
}
