//! Where gaits are judged: the reference world, and worlds near it.

mod near;
pub mod worlds;

use crate::Registry;
use crate::{
    config::RunConfig,
    episode_parts::{EpisodeParts, SetupError},
    obstacles::ObstaclesPassed,
    trajectory::Recording,
};
use envs_core::Landscape;
use envs_lanes::LaneEnvironment;
use envs_rapier::{RapierEnvironment, Variation};
use ne_core::{Purpose, Seed};
use ne_net::Network;
use rand::Rng;
use serde::Serialize;
use std::sync::{Arc, OnceLock};
use tasks::{
    Episode, Movement, MovementSpec, Trials,
    gait::{GaitReport, Judgement, NearWorlds, Rules},
};

use crate::tiers::DEPENDABLE;
pub use crate::tiers::USABLE;
use near::near_worlds;
use worlds::{Worlds, is_usable};

/// Judges the gaits of a creature in one world: rapier, the settled start pose, no variation, and as many seconds as the
/// judgement asks for. Nothing ends the episode early. A gait that is usable there is tried in [near worlds](NearWorlds) too.
#[derive(Clone)]
pub struct Judge {
    episode: Episode<RapierEnvironment>,
    movement: Box<dyn Movement>,
    rules: Option<Arc<dyn Rules>>,
    /// The creature in the same world in lanes, which have rapier's bits; `None` if they cannot simulate it.
    lanes: Option<LaneEnvironment>,
    /// What is drawn in the worlds here, where nothing varies: commands.
    seed: Seed,
    /// Built when they are first needed.
    near: Arc<OnceLock<Worlds>>,
}

/// The [tier](ne_core::champion_selection::ReEvaluation::tiers) that ends a run until usable. A movement without commands ends at
/// [`USABLE`], and one with commands at the tier of 30 of 32 schedules: a gait that is usable in one schedule may fail in half of the
/// others. Where the world does not vary no tier is above [`USABLE`].
pub fn tier_to_reach(config: &RunConfig, registry: &Registry) -> u8 {
    let commanded = registry.movements.rules(&config.movement.name).is_some_and(|rules| rules.needs_commands());
    if commanded && !config.variation.is_none() { DEPENDABLE } else { USABLE }
}

/// For the worlds by which champions are chosen.
pub(crate) const TRAINING: Purpose = Purpose::new("judge of training");

/// A movement that is not judged is watched for so long, s.
const UNJUDGED_SECONDS: f64 = 20.0;

impl Judge {
    /// A judge for a creature with its sensors, motors and physics.
    ///
    /// # Errors
    /// If a field is out of range or the movement is unknown.
    pub fn new(parts: EpisodeParts<'_>, registry: &Registry) -> Result<Self, SetupError> {
        parts.physics.validate().map_err(|error| error.within("physics"))?;
        let rules = registry.movements.rules(&parts.movement.name);
        let steps = Some(steps_of(judged_seconds(rules.as_deref()), parts.physics.time_step));
        let movement = MovementSpec { steps, terms: Vec::new(), objectives: Vec::new(), ..parts.movement.clone() };
        let parts =
            EpisodeParts { movement: &movement, trials: Trials::default(), variation: Variation::default(), ..parts };
        let episode = parts.build(registry)?;
        let movement = registry.movements.build(&movement)?;
        let lanes = parts.build_lanes(registry).ok().map(|episode| episode.environment().clone());
        Ok(Self { episode, movement, rules, lanes, seed: Seed::of_run(0), near: Arc::default() })
    }

    /// The same judge, whose worlds draw from this seed for this purpose, and not from the seed by which a saved champion is judged: a
    /// champion is not to be chosen by the commands it is judged by.
    pub(crate) fn drawing_from(self, seed: Seed, purpose: Purpose) -> Self {
        Self { seed: Seed::of_run(seed.stream(purpose).next_u64()), near: Arc::default(), ..self }
    }

    pub(crate) fn seed(&self) -> Seed {
        self.seed
    }

    /// The creature in this world.
    pub fn environment(&self) -> &RapierEnvironment {
        self.episode.environment()
    }

    /// The same in lanes, if they can simulate it.
    pub(crate) fn lanes(&self) -> Option<&LaneEnvironment> {
        self.lanes.as_ref()
    }

    pub(crate) fn movement(&self) -> Box<dyn Movement> {
        self.movement.clone()
    }

    /// How long an episode lasts here, in steps.
    pub fn steps(&self) -> u32 {
        self.episode.steps()
    }

    /// By which rules a gait is judged here, if it is.
    pub fn rules(&self) -> Option<&Arc<dyn Rules>> {
        self.rules.as_ref()
    }

    /// How long a gait is played here, s.
    pub(crate) fn seconds(&self) -> f64 {
        judged_seconds(self.rules.as_deref())
    }

    /// What a controller does here. A body that explodes, and a controller of another shape, leave a short recording.
    pub fn record(&self, network: &Network) -> Recording {
        record(&self.episode, network, self.seed)
    }

    /// Measures what a controller does here, and judges it here and in near worlds; `None` for one that falls silent at
    /// once: there is nothing to measure.
    pub fn judge(&self, network: &Network) -> Option<GaitReport> {
        self.measure(network).map(|gait| gait.report)
    }

    /// The same, and how many obstacles it passes. What is not usable here is not tried in near worlds.
    pub fn measure(&self, network: &Network) -> Option<Gait> {
        let mut gait = self.measure_alone(network)?;
        if let Some(verdict) = gait.report.verdict.take() {
            let near = verdict.usable.then(|| self.try_near_worlds(network));
            gait.report.verdict = Some(with_near_worlds(verdict, near));
        }
        Some(gait)
    }

    /// The same, judged here alone.
    pub fn measure_alone(&self, network: &Network) -> Option<Gait> {
        worlds::measure(self.environment(), self.rules.as_deref(), &self.record(network).snapshots)
    }

    /// In how many near worlds a controller's gait is usable, on the threads of the current pool.
    pub fn try_near_worlds(&self, network: &Network) -> NearWorlds {
        let worlds = self.near();
        NearWorlds { usable: worlds.usable(network, 0), worlds: worlds.len() }
    }

    fn near(&self) -> &Worlds {
        self.near.get_or_init(|| {
            let landscape: &Landscape = self.environment().landscape();
            let conditions = near_worlds(self.environment().motors().len()).into_iter();
            let conditions: Vec<_> = conditions.map(|conditions| (conditions, landscape.clone())).collect();
            // The first trial is the reference episode's.
            Worlds::new(self, &conditions).beginning_with_trial(1)
        })
    }

    /// Whether a controller's gait is usable, here and in near worlds; never for a movement that is not judged.
    pub fn is_usable(&self, network: &Network) -> bool {
        self.judge(network).is_some_and(|report| is_usable(&report))
    }

    /// The first of these controllers whose gaits are usable, at most so many, on the threads of the current pool. All are played at
    /// once, in lanes where they can; only what is usable is tried in near worlds. Whether lanes are right is for the champion
    /// selection to ask: it has a champion's episode played again by rapier.
    pub fn first_usable(&self, networks: &[Network], most: usize) -> Vec<usize> {
        let Some(reference) = Worlds::reference(self) else {
            return (0..networks.len()).filter(|&index| self.is_usable(&networks[index])).take(most).collect();
        };
        let is_usable = |verdicts: &[Option<Judgement>]| verdicts.iter().flatten().any(|verdict| verdict.usable);
        let verdicts = reference.verdicts(networks);
        let promising: Vec<usize> = (0..networks.len()).filter(|&index| is_usable(&verdicts[index])).collect();
        let mut found = Vec::new();
        // Near worlds are not built for nothing.
        if promising.is_empty() {
            return found;
        }
        let near = self.near();
        let required = NearWorlds::required(near.len());
        // In turns: what comes after the last that is wanted is not played.
        for some in promising.chunks(near.at_once()) {
            let networks: Vec<Network> = some.iter().map(|&index| networks[index].clone()).collect();
            let usable = near.usable_all(&networks, required);
            found.extend(some.iter().zip(usable).filter_map(|(&index, usable)| (usable >= required).then_some(index)));
            if found.len() >= most {
                break;
            }
        }
        found.truncate(most);
        found
    }

    /// The same judge, where nothing is played in lanes.
    #[cfg(test)]
    pub(crate) fn in_rapier(self) -> Self {
        Self { lanes: None, near: Arc::default(), ..self }
    }
}

fn with_near_worlds(verdict: Judgement, near: Option<NearWorlds>) -> Judgement {
    match near {
        Some(near) => verdict.with_near_worlds(near),
        None => verdict,
    }
}

/// What a controller does in the one world of an episode.
pub(crate) fn record(episode: &Episode<RapierEnvironment>, network: &Network, seed: Seed) -> Recording {
    let mut recording = Recording::default();
    // Without variation nothing but commands comes from the seed.
    episode.play(&mut network.clone(), seed, &mut recording);
    recording
}

/// A gait, and how far it got on its terrain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gait {
    /// What was measured of it.
    #[serde(flatten)]
    pub report: GaitReport,
    /// How many obstacles of each kind it passed; empty on flat ground.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<ObstaclesPassed>,
}

/// How long an episode must be for the judgement, s.
fn judged_seconds(rules: Option<&dyn Rules>) -> f64 {
    rules.map_or(UNJUDGED_SECONDS, Rules::seconds)
}

/// The steps of an episode of so many seconds.
pub(crate) fn steps_of(seconds: f64, time_step: f32) -> u32 {
    (seconds / f64::from(time_step)).round() as u32
}
