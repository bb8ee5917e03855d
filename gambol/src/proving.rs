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

/// So many body lengths the bumps reach: a quarter of what a fast gait covers. Beyond it the
/// ground is flat, and rapier faster.
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
            let World { conditions, landscape, .. } = World::draw(Seed::of_run(lot).trial(index), &self.stage, reach);
            self.stage.under(&conditions, landscape, &self.catalogue).ok()
        };
        (0..WORLDS as u32).into_par_iter().map(world).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        champion::Champion,
        config::Request,
        gait::USABLE,
        perturbation::tests::stage,
        training::{TrainOptions, train},
    };
    use ne_core::{StopConditions, StopSignal};

    /// A champion that has just become usable.
    fn champion(seed: u64) -> Champion {
        let names = (Some("biped-1".into()), Some("jumping".into()));
        let request = Request { creature: names.0, movement: names.1, ..Request::default() };
        let mut config = request.resolve(&MovementCatalogue::default()).expect("shipped");
        config.seed = seed;
        config.stop = StopConditions { generations: Some(40), grade: Some(USABLE), ..StopConditions::default() };
        let options = TrainOptions {
            threads: 1,
            catalogue: MovementCatalogue::default(),
            signal: StopSignal::default(),
            on_generation: &mut |_| {},
        };
        let folder = tempfile::tempdir().expect("a folder");
        train(&config, &folder.path().join("run"), options).expect("it runs").champion.expect("a champion")
    }

    /// Against the same worlds, one by one: giving up early must not change what is told.
    #[test]
    fn a_gait_is_tried_in_every_world_or_given_up() {
        let counts: Vec<usize> = (1..=3)
            .map(|seed| {
                let (champion, catalogue) = (champion(seed), MovementCatalogue::default());
                let stage = Stage::new(champion.episode_parts(), &catalogue).expect("builds");
                let proving = ProvingGround::new(stage, catalogue, Seed::of_run(seed));
                let usable = |world: &&Stage| world.is_usable(&champion.network);
                let count = proving.build().iter().flatten().filter(usable).count();
                for least in 0..=WORLDS {
                    let told = proving.usable(&champion.network, least);
                    assert_eq!(told, Some(count).filter(|&count| count >= least));
                }
                count
            })
            .collect();
        assert!(counts.iter().any(|&count| count > 0), "nobody is ever usable: {counts:?}");
    }

    #[test]
    fn every_run_has_worlds_of_its_own() {
        let stage = stage("biped-1", "jumping");
        let steps = |seed| {
            let ground = ProvingGround::new(stage.clone(), MovementCatalogue::default(), Seed::of_run(seed));
            let step = |world: &Option<Stage>| world.as_ref().map(|world| world.environment().settings().time_step);
            ground.build().iter().map(step).collect::<Vec<_>>()
        };
        assert_eq!(steps(1).len(), WORLDS);
        assert_eq!(steps(1), steps(1));
        assert_ne!(steps(1), steps(2));
    }
}
