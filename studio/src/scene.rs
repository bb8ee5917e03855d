//! What is to be shown, as plain data: all that it takes to build an arena, wherever that is.

use envs_rapier::RapierEnvironment;
use gambol_runs::{Registry, champion::Champion, config::RunConfig, episode_parts::SetupError, judge::Judge};
use ne_core::{Fitness, Seed};
use ne_net::Network;
use serde::{Deserialize, Serialize};

/// Creatures of one body, and their world.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
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

/// One that is to be shown.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entrant {
    /// Its controller.
    pub network: Network,
    /// Its fitness in training; `None` if it failed there.
    pub fitness: Option<Fitness>,
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
