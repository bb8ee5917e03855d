//! Where it is tried whether a finalist's gait would be usable in worlds that are not quite the one it is judged in.

use crate::{gait::Stage, perturbation::World};
use ne_core::{Purpose, Seed};
use ne_net::Network;
use rand::RngExt;
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};
use tasks::MovementCatalogue;

const PROVING_GROUND: Purpose = Purpose::new("proving ground");

/// Perturbed worlds a finalist is tried in.
pub(crate) const WORLDS: usize = 12;

/// So many are tried at a time, before it is asked whether going on can change anything.
const AT_ONCE: usize = 4;

/// So many body lengths the bumps reach: a quarter of what a fast gait covers. More take time and tell no more.
const REACH: f32 = 15.0;

/// A few worlds, always the same, of the kind that [`robustness`](crate::robust::robustness) is measured in.
#[derive(Clone)]
pub struct ProvingGround {
    stage: Stage,
    catalogue: MovementCatalogue,
    seed: Seed,
    /// Built when they are first needed. `None`: the creature does not come to rest there.
    worlds: Arc<OnceLock<Vec<Option<Stage>>>>,
}

impl ProvingGround {
    pub(crate) fn new(stage: Stage, catalogue: MovementCatalogue, seed: Seed) -> Self {
        Self { stage, catalogue, seed, worlds: Arc::default() }
    }

    /// In how many of the worlds a controller's gait is usable; `None` as soon as it cannot be `least`.
    pub(crate) fn usable(&self, network: &Network, least: usize) -> Option<usize> {
        let worlds = self.worlds.get_or_init(|| self.build());
        let mut usable = 0;
        for (tried, few) in worlds.chunks(AT_ONCE).enumerate() {
            if usable + worlds.len() - tried * AT_ONCE < least {
                return None;
            }
            let fine = |world: &&Option<Stage>| world.as_ref().is_some_and(|stage| stage.is_usable(network));
            usable += few.par_iter().filter(fine).count();
        }
        Some(usable).filter(|&usable| usable >= least)
    }

    fn build(&self) -> Vec<Option<Stage>> {
        let reach = REACH * self.stage.environment().blueprint().body_length();
        // Other worlds than those robustness is measured in, whatever the run's seed.
        let lot: u64 = self.seed.stream(PROVING_GROUND).random();
        let world = |index| {
            let World { conditions, ground, .. } = World::draw(Seed::of_run(lot).trial(index), &self.stage, reach);
            self.stage.under(&conditions, ground, &self.catalogue).ok()
        };
        (0..WORLDS as u32).into_par_iter().map(world).collect()
    }
}
