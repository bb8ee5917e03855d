//! What environments are made of: from a caller's words to episodes that are checked.

use creatures::{Blueprint, Senses};
use envs_core::Landscape;
use envs_lanes::{LANES, LaneEpisode};
use envs_rapier::RapierEnvironment;
use gambol_runs::{Registry, config::EngineChoice, request::Request};
use ne_core::Seed;
use std::{
    borrow::Cow,
    collections::BTreeSet,
    error::Error,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};
use tasks::{Environment, Episode, MovementSpec};

/// Everything that can be named. Built when it is first asked for.
pub(crate) fn registry() -> Arc<Registry> {
    lock().get_or_insert_default().clone()
}

/// The same, if it was asked for before.
pub(crate) fn built() -> Option<Arc<Registry>> {
    lock().clone()
}

/// Adds something of a name of its own; what was added under that name before is replaced. `add` must not call Python, which
/// may wait for the lock.
///
/// # Errors
/// If the library has a movement of that name.
pub(crate) fn register(name: String, add: impl FnOnce(&mut Registry)) -> Result<(), String> {
    static ADDED: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let mut added = ADDED.lock().unwrap_or_else(PoisonError::into_inner);
    let mut changed = Registry::clone(&registry());
    if !added.contains(&name) && changed.movements.find(&name).is_some() {
        return Err(format!("name = \"{name}\": the library has a movement of that name"));
    }
    add(&mut changed);
    added.insert(name);
    // What is being built with the one before goes on with it.
    let before = lock().replace(Arc::new(changed));
    // Its movements may be dropped with it, which may call Python.
    drop(added);
    drop(before);
    Ok(())
}

fn lock() -> MutexGuard<'static, Option<Arc<Registry>>> {
    static REGISTRY: Mutex<Option<Arc<Registry>>> = Mutex::new(None);
    REGISTRY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The episodes of environments, in the engine that plays them.
pub(crate) enum Episodes {
    /// Sixteen at once.
    Lanes(Box<LaneEpisode>),
    /// One at a time: the reference, and what lanes cannot do.
    Rapier(Box<Episode<RapierEnvironment>>),
}

/// Episodes, and what a caller wants to know of them.
pub(crate) struct Described {
    pub(crate) episodes: Episodes,
    /// The names of the movement, its terms and its objectives.
    pub(crate) movements: Vec<String>,
    /// Sensors are scaled to ± this.
    pub(crate) input_range: f32,
    /// The unit of the fitness.
    pub(crate) unit: String,
    /// The whole configuration, as JSON.
    pub(crate) config: String,
}

/// The names of a movement, its terms and its objectives: any of them may be Python's.
pub(crate) fn names_in(movement: &MovementSpec) -> Vec<String> {
    let added = movement.terms.iter().chain(&movement.objectives).map(|term| term.term.clone());
    [movement.name.clone()].into_iter().chain(added).collect()
}

impl Described {
    /// What a request asks for. The engine is that of the request, or that of training.
    pub(crate) fn build(request: &Request) -> Result<Self, Box<dyn Error>> {
        let registry = &registry();
        let config = request.resolve(registry)?;
        let parts = config.episode_parts();
        let episodes = match config.engine {
            EngineChoice::Lanes => Episodes::Lanes(Box::new(parts.build_lanes(registry)?)),
            EngineChoice::Rapier => Episodes::Rapier(Box::new(parts.build(registry)?)),
        };
        let unit = registry.movements.build(&config.movement)?.unit().to_owned();
        let input_range = config.controller.input_range;
        let movements = names_in(&config.movement);
        Ok(Self { episodes, movements, input_range, unit, config: serde_json::to_string(&config)? })
    }
}

impl Episodes {
    /// How many environments are stepped together.
    pub(crate) fn together(&self) -> usize {
        match self {
            Self::Lanes(_) => LANES,
            Self::Rapier(_) => 1,
        }
    }

    /// What steps them: `avx2`, `rapier` and the like.
    pub(crate) fn stepped_by(&self) -> &'static str {
        match self {
            Self::Lanes(episode) => episode.instructions().name(),
            Self::Rapier(_) => "rapier",
        }
    }

    /// The longest an episode lasts, in steps.
    pub(crate) fn steps(&self) -> u32 {
        match self {
            Self::Lanes(episode) => episode.steps(),
            Self::Rapier(episode) => episode.steps(),
        }
    }

    /// Seconds a step lasts, before variation.
    pub(crate) fn time_step(&self) -> f32 {
        match self {
            Self::Lanes(episode) => episode.environment().settings().time_step,
            Self::Rapier(episode) => episode.environment().settings().time_step,
        }
    }

    /// How many numbers are sensed, and how many motors there are.
    pub(crate) fn shape(&self) -> (usize, usize) {
        match self {
            Self::Lanes(episode) => (episode.environment().inputs(), episode.environment().outputs()),
            Self::Rapier(episode) => (episode.environment().inputs(), episode.environment().outputs()),
        }
    }

    /// The creature.
    pub(crate) fn blueprint(&self) -> &Blueprint {
        match self {
            Self::Lanes(episode) => episode.environment().blueprint(),
            Self::Rapier(episode) => episode.environment().blueprint(),
        }
    }

    /// What the creature moves on in the episode of this seed.
    pub(crate) fn landscape(&self, seed: Seed) -> Cow<'_, Landscape> {
        match self {
            Self::Lanes(episode) => episode.environment().landscape_of(seed),
            Self::Rapier(episode) => episode.environment().landscape_of(seed),
        }
    }

    /// What is sensed.
    pub(crate) fn senses(&self) -> &Senses {
        match self {
            Self::Lanes(episode) => episode.environment().senses(),
            Self::Rapier(episode) => episode.environment().senses(),
        }
    }

    /// The names of what is sensed and of the motors, each with its unit.
    pub(crate) fn channels(&self) -> [Vec<(String, String)>; 2] {
        let motors = match self {
            Self::Lanes(episode) => episode.environment().motors(),
            Self::Rapier(episode) => episode.environment().motors(),
        };
        [self.senses().channels(), motors.channels()]
            .map(|channels| channels.iter().map(|channel| (channel.name.clone(), channel.unit.to_string())).collect())
    }
}
