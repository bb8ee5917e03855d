//! Where it is tried whether a finalist's gait would be usable in worlds that are not quite the one it is judged in.

use crate::{gait::Stage, perturbation::World, worlds::Worlds};
use envs_core::{Conditions, Landscape};
use ne_core::{Purpose, Seed};
use ne_net::Network;
use rand::RngExt;
use std::sync::{Arc, OnceLock};

const PROVING_GROUND: Purpose = Purpose::new("proving ground");

/// Perturbed worlds a candidate is tried in: as many of each cause, and no more than lanes play at once.
pub(crate) const WORLDS: usize = 15;

/// Gaits are played for so long there, s: most of what fails in a minute fails by then.
const SECONDS: f64 = 15.0;

/// So many body lengths the bumps reach: a quarter of what a fast gait covers. Beyond it the
/// ground is flat, and physics faster.
const REACH: f32 = 15.0;

/// A few worlds, always the same, of the kind that [`robustness`](crate::robust::robustness) is measured in.
#[derive(Clone)]
pub struct ProvingGround {
    stage: Stage,
    seed: Seed,
    /// Built when they are first needed.
    worlds: Arc<OnceLock<Worlds>>,
}

impl ProvingGround {
    pub(crate) fn new(stage: Stage, seed: Seed) -> Self {
        Self { stage, seed, worlds: Arc::default() }
    }

    /// In how many of the worlds a controller's gait is usable, on the threads of the current pool.
    pub(crate) fn usable(&self, network: &Network) -> usize {
        self.worlds.get_or_init(|| Worlds::new(&self.stage, &self.draw()).shortened(SECONDS)).usable(network)
    }

    fn draw(&self) -> Vec<(Conditions, Landscape)> {
        let reach = REACH * self.stage.environment().blueprint().body_length();
        // Other worlds than those robustness is measured in, whatever the run's seed.
        let lot: u64 = self.seed.stream(PROVING_GROUND).random();
        let world = |index| {
            let World { conditions, landscape, .. } = World::draw(Seed::of_run(lot), index, &self.stage, reach);
            (conditions, landscape)
        };
        (0..WORLDS as u32).map(world).collect()
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
    use tasks::MovementCatalogue;

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

    /// Against the same worlds, one by one in rapier.
    #[test]
    fn a_gait_is_tried_in_every_world() {
        let counts: Vec<usize> = (1..=3)
            .map(|seed| {
                let (champion, catalogue) = (champion(seed), MovementCatalogue::default());
                let stage = Stage::new(champion.episode_parts(), &catalogue).expect("builds");
                let proving = ProvingGround::new(stage.clone(), Seed::of_run(seed));
                let count = proving.usable(&champion.network);
                let stage = stage.in_rapier();
                let one_by_one = proving.draw().into_iter().map(|world| Worlds::new(&stage, &[world]));
                assert_eq!(one_by_one.map(|world| world.usable(&champion.network)).sum::<usize>(), count);
                count
            })
            .collect();
        assert!(counts.iter().any(|&count| count > 0), "nobody is ever usable: {counts:?}");
    }

    #[test]
    fn every_run_has_worlds_of_its_own() {
        let stage = stage("biped-1", "jumping");
        let worlds = |seed| ProvingGround::new(stage.clone(), Seed::of_run(seed)).draw();
        assert_eq!(worlds(1).len(), WORLDS);
        assert_eq!(worlds(1), worlds(1));
        assert_ne!(worlds(1), worlds(2));
    }
}
