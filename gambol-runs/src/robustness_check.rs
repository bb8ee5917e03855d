//! Where it is tried whether a candidate's gait would be usable in worlds that are not quite the one it is judged in.

use crate::{
    judge::{Judge, TRAINING, worlds::Worlds},
    perturbation::{Cause, World},
};
use envs_core::{Conditions, Landscape, Variation};
use ne_core::{Purpose, Seed};
use ne_net::Network;
use rand::RngExt;
use std::sync::{Arc, OnceLock};

/// The shortest step, as a factor on that of the settings: as in training ([`Variation::light`]).
const SHORTEST_STEP: f32 = 0.7;

const ROBUSTNESS_CHECK: Purpose = Purpose::new("robustness check");

/// Which worlds a candidate is tried in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Trial {
    /// As many of each cause (in water one less of the last), for at most 15 s: most of what fails in a minute fails by then.
    Short,
    /// All causes together, for as long as a gait is judged.
    Long,
    /// Near worlds, each with commands of its own, for as long as a gait is judged.
    Commands,
    /// The same with other commands: enough to tell a candidate that seldom fails from one that was lucky.
    MoreCommands,
}

impl Trial {
    const ALL: [Self; 4] = [Self::Short, Self::Long, Self::Commands, Self::MoreCommands];

    /// In how many worlds: as many as lanes play in one turn or in two.
    pub(crate) const fn worlds(self) -> usize {
        match self {
            Self::Short => 15,
            Self::Long | Self::Commands => 16,
            Self::MoreCommands => 32,
        }
    }

    /// Gaits are played for so long, s.
    fn seconds(self) -> f64 {
        match self {
            Self::Short => 15.0,
            Self::Long | Self::Commands | Self::MoreCommands => f64::INFINITY,
        }
    }

    /// Which perturbed world, of those that [`World::draw`] numbers, and so many body lengths the bumps reach there; `None`: a near
    /// one. So many `causes` take turns in these numbers, and all together come last. In the short trial bumps reach a quarter of
    /// what a fast gait covers: beyond it the ground is flat, and physics faster.
    fn perturbed(self, index: u32, causes: u32) -> Option<(u32, f32)> {
        match self {
            Self::Short => Some((index, 15.0)),
            Self::Long => {
                let after_short = (Self::Short.worlds() as u32).next_multiple_of(causes);
                Some((after_short + causes * index + causes - 1, 60.0))
            }
            Self::Commands | Self::MoreCommands => None,
        }
    }
}

/// A few worlds, always the same, of the kind that [`robustness`](crate::robust::robustness) is measured in.
#[derive(Clone)]
pub struct RobustnessCheck {
    judge: Judge,
    seed: Seed,
    /// For each trial, built when they are first needed.
    worlds: [Arc<OnceLock<Worlds>>; Trial::ALL.len()],
}

impl RobustnessCheck {
    pub(crate) fn new(judge: Judge, seed: Seed) -> Self {
        Self { judge, seed, worlds: Default::default() }
    }

    /// Whether what the gait is judged by asks whether it does as it is told.
    pub(crate) fn needs_commands(&self) -> bool {
        self.judge.rules().is_some_and(|rules| rules.needs_commands())
    }

    /// In how many of the worlds a controller's gait is usable, on the threads of the current pool; fewer than `needed`, how many
    /// does not matter, if it is so in fewer than these.
    pub(crate) fn usable(&self, network: &Network, trial: Trial, needed: usize) -> usize {
        self.worlds(trial).usable(network, needed)
    }

    /// The one of these controllers whose gait is usable in most of the worlds, of equals the first, and in how many.
    pub(crate) fn steadiest(&self, networks: &[Network], trial: Trial) -> Option<(usize, usize)> {
        let worlds = self.worlds(trial);
        let mut steadiest = None;
        let mut places = 0..;
        // In turns: what is worse than the best of those before is not played to its end.
        for some in networks.chunks(worlds.at_once()) {
            let needed = steadiest.map_or(0, |(_, most)| most + 1);
            for (usable, place) in worlds.usable_all(some, needed).into_iter().zip(&mut places) {
                if steadiest.is_none_or(|(_, most)| usable > most) {
                    steadiest = Some((place, usable));
                }
            }
        }
        steadiest
    }

    fn worlds(&self, trial: Trial) -> &Worlds {
        let build = || Worlds::new(&self.judge_of(trial), &self.draw(trial)).shortened(trial.seconds());
        self.worlds[trial as usize].get_or_init(build)
    }

    /// What is told where a gait was found usable is not told again where it is to be told something else.
    fn judge_of(&self, trial: Trial) -> Judge {
        let judge = self.judge.clone();
        match trial {
            Trial::Short | Trial::Long => judge,
            Trial::Commands | Trial::MoreCommands => judge.drawing_from(self.lot(trial), TRAINING),
        }
    }

    /// Other worlds than those robustness is measured in, whatever the run's seed.
    fn lot(&self, trial: Trial) -> Seed {
        let mut stream = self.seed.stream(ROBUSTNESS_CHECK);
        let [first, second] = [stream.random(), stream.random()];
        Seed::of_run(if trial == Trial::MoreCommands { second } else { first })
    }

    fn draw(&self, trial: Trial) -> Vec<(Conditions, Landscape)> {
        let (environment, lot) = (self.judge.environment(), self.lot(trial));
        let causes = Cause::all_of(&self.judge).len() as u32;
        let world = |index| match trial.perturbed(index, causes) {
            Some((number, reach)) => {
                let reach = reach * environment.blueprint().body_length();
                let World { conditions, landscape, .. } =
                    World::draw_with(lot, number, &self.judge, reach, without_short_steps);
                (conditions, landscape)
            }
            None => {
                let conditions = Variation::near().draw(lot.trial(index), environment.motors().len());
                (conditions, environment.landscape().clone())
            }
        };
        (0..trial.worlds() as u32).map(world).collect()
    }
}

/// The shortest step of a perturbed world is a quarter of a usual one. In one that has it an episode takes four times as long,
/// and all lanes beside it wait; what bears long steps bears short ones.
fn without_short_steps(variation: Variation) -> Variation {
    let [shortest, longest] = variation.time_step;
    Variation { time_step: [shortest.max(SHORTEST_STEP), longest], ..variation }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::Registry;
    use crate::{
        champion::Champion,
        judge::USABLE,
        perturbation::tests::judge,
        request::Request,
        training::{TrainOptions, train},
    };
    use envs_core::Ground;
    use ne_core::{StopConditions, StopSignal};

    /// The champion of a short run without stages.
    pub(crate) fn champion(creature: &str, movement: &str, seed: u64, stop: StopConditions) -> Champion {
        let names = (Some(creature.into()), Some(movement.into()));
        let request = Request { creature: names.0, movement: names.1, ..Request::default() };
        let mut config = request.resolve(&Registry::default()).expect("shipped");
        (config.seed, config.stop, config.stages) = (seed, stop, Vec::new());
        let options = TrainOptions {
            threads: 1,
            registry: Registry::default(),
            signal: StopSignal::default(),
            on_generation: &mut |_| {},
        };
        let folder = tempfile::tempdir().expect("a folder");
        train(&config, &folder.path().join("run"), options).expect("it runs").champion.expect("a champion")
    }

    #[test]
    fn the_long_trial_is_of_all_causes_together_and_in_other_worlds_than_the_short_one() {
        for causes in [Cause::ALL.len(), Cause::WITHOUT_BUMPS.len()].map(|causes| causes as u32) {
            for index in 0..Trial::Long.worlds() as u32 {
                let (number, _) = Trial::Long.perturbed(index, causes).expect("a perturbed world");
                assert_eq!(number % causes, causes - 1, "{causes} causes");
                assert!(number >= Trial::Short.worlds() as u32, "{causes} causes");
            }
        }
    }

    /// Against the same worlds, one by one in rapier.
    #[test]
    fn a_gait_is_tried_in_every_world() {
        let counts: Vec<usize> = (1..=3)
            .flat_map(|seed| Trial::ALL.map(|trial| (seed, trial)))
            .map(|(seed, trial)| {
                let as_soon_as_usable =
                    StopConditions { generations: Some(40), tier: Some(USABLE), ..StopConditions::default() };
                let champion = champion("biped-1", "jumping", seed, as_soon_as_usable);
                let registry = Registry::default();
                let judge = Judge::new(champion.episode_parts(), &registry).expect("builds");
                let robustness_check = RobustnessCheck::new(judge.clone(), Seed::of_run(seed));
                let count = robustness_check.usable(&champion.network, trial, 0);
                let known = robustness_check.usable(&champion.network, trial, count);
                assert_eq!(known, count, "as many as are needed");
                assert!(robustness_check.usable(&champion.network, trial, count + 1) <= count);
                let judge = robustness_check.judge_of(trial).in_rapier();
                let worlds = (0..).zip(robustness_check.draw(trial));
                let one_by_one = worlds.map(|(index, world)| Worlds::new(&judge, &[world]).beginning_with_trial(index));
                assert_eq!(one_by_one.map(|world| world.usable(&champion.network, 0)).sum::<usize>(), count);
                count
            })
            .collect();
        assert!(counts.iter().any(|&count| count > 0), "no gait is ever usable: {counts:?}");
    }

    /// However many are played at once.
    #[test]
    fn several_gaits_are_judged_as_each_is_alone() {
        let as_soon_as_usable =
            StopConditions { generations: Some(40), tier: Some(USABLE), ..StopConditions::default() };
        let usable = [1, 2, 3].map(|seed| champion("tetrapod-1", "running", seed, as_soon_as_usable));
        let one_generation = StopConditions { generations: Some(1), ..StopConditions::default() };
        let others = [4, 5, 6].map(|seed| champion("tetrapod-1", "running", seed, one_generation));
        let judge = Judge::new(usable[0].episode_parts(), &Registry::default()).expect("builds");
        let check = RobustnessCheck::new(judge.clone(), Seed::of_run(1));
        let networks: Vec<Network> = others
            .iter()
            .zip(&usable)
            .flat_map(|(other, usable)| [other, usable])
            .map(|it| it.network.clone())
            .collect();
        let alone: Vec<usize> = (0..networks.len()).filter(|&index| judge.is_usable(&networks[index])).collect();
        assert!(alone.len() >= 2, "{alone:?}");
        let counts: Vec<usize> = networks.iter().map(|network| check.usable(network, Trial::Short, 0)).collect();
        let most = (0..counts.len()).min_by_key(|&index| std::cmp::Reverse(counts[index]));
        let most = most.map(|index| (index, counts[index]));
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            for first in [1, 2, networks.len()] {
                let expected = &alone[..alone.len().min(first)];
                assert_eq!(pool.install(|| judge.first_usable(&networks, first)), expected);
            }
            assert_eq!(pool.install(|| check.steadiest(&networks, Trial::Short)), most, "{counts:?}");
        }
        assert_eq!(check.steadiest(&[], Trial::Short), None);
    }

    #[test]
    fn commands_are_others_in_worlds_that_are_near() {
        let judge = judge("biped-1", "jumping");
        let check = |seed| RobustnessCheck::new(judge.clone(), Seed::of_run(seed));
        let seed = |seed, trial| check(seed).judge_of(trial).seed();
        assert_eq!(seed(1, Trial::Short), judge.seed());
        assert_ne!(seed(1, Trial::Commands), judge.seed());
        assert_ne!(seed(1, Trial::Commands), seed(2, Trial::Commands));
        assert_ne!(seed(1, Trial::Commands), seed(1, Trial::MoreCommands));
        for (conditions, landscape) in
            [Trial::Commands, Trial::MoreCommands].iter().flat_map(|&trial| check(1).draw(trial))
        {
            assert!((conditions.friction - 1.0).abs() <= 0.01 + 1e-6 && conditions.pushes.is_empty(), "{conditions:?}");
            assert_eq!(landscape, Ground::flat().into());
        }
        assert!(!check(1).needs_commands(), "a jump is told nothing");
    }

    #[test]
    fn every_run_has_worlds_of_its_own() {
        let judge = judge("biped-1", "jumping");
        let worlds = |seed, trial| RobustnessCheck::new(judge.clone(), Seed::of_run(seed)).draw(trial);
        for trial in Trial::ALL {
            assert_eq!(worlds(1, trial).len(), trial.worlds());
            assert_eq!(worlds(1, trial), worlds(1, trial));
            assert_ne!(worlds(1, trial), worlds(2, trial));
        }
        let short = worlds(1, Trial::Short);
        for (conditions, landscape) in worlds(1, Trial::Long) {
            let flat = Landscape::from(Ground::flat());
            assert!(landscape != flat && conditions.gravity != 1.0 && !conditions.pushes.is_empty(), "all together");
            assert!(short.iter().all(|(known, _)| *known != conditions), "another world");
        }
    }
}
