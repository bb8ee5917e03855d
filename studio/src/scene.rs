//! What is to be shown, as plain data: all that it takes to build an arena, wherever that is.

use crate::descent::Member;
use envs_rapier::RapierEnvironment;
use gambol_runs::{Registry, champion::Champion, config::RunConfig, episode_parts::SetupError, judge::Judge};
use ne_core::Seed;
use ne_net::Network;
use serde::{Deserialize, Serialize};

/// Creatures of one body, and their world.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Which creatures they are.
    pub who: Shown,
    /// The generation they are of.
    pub generation: u64,
    /// Where they move.
    pub world: World,
    /// Their controllers, the best first.
    pub entrants: Vec<Entrant>,
    /// The trial.
    pub seed: Seed,
}

/// Where creatures move.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum World {
    /// Where a run trains them.
    Training(Box<RunConfig>),
    /// Where a champion is judged.
    Judged(Box<Champion>),
}

/// Which creatures a scene has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shown {
    /// A generation, the best first.
    Population,
    /// One of a generation, and its parents.
    Family,
    /// A champion, perhaps with its ghost.
    Champion,
}

/// One that is to be shown.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entrant {
    /// Its controller.
    pub network: Network,
    /// What else is known of it.
    pub member: Member,
}

impl World {
    /// The world, in rapier.
    ///
    /// # Errors
    /// If something in it cannot be built.
    pub fn build(&self, registry: &Registry) -> Result<RapierEnvironment, SetupError> {
        Ok(match self {
            Self::Training(config) => config.episode_parts().build(registry)?.environment().clone(),
            Self::Judged(champion) => Judge::new(champion.episode_parts(), registry)?.environment().clone(),
        })
    }
}
