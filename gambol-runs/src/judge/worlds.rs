//! Worlds in which gaits are judged, each by itself.

use crate::judge::{Gait, Judge, record, steps_of};
use crate::obstacles::ObstaclesPassed;
use envs_core::{Conditions, CreatureEnvironment, Engine, EnvironmentError, Landscape};
use envs_lanes::{LANES, LaneEnvironment, Play};
use envs_rapier::RapierEnvironment;
use ne_core::Seed;
use ne_net::Network;
use rayon::prelude::*;
use std::sync::Arc;
use tasks::{
    Environment, Episode, Snapshot, Trials,
    gait::{GaitReport, Judgement, Reason, Rules, Trajectory},
};

/// Worlds of one creature, built once. Controllers are played in them in lanes, many at once, where lanes can simulate them,
/// and else in rapier; what comes out is the same.
#[derive(Clone)]
pub struct Worlds {
    rules: Option<Arc<dyn Rules>>,
    /// How long gaits are played, s.
    seconds: f64,
    /// Each world draws commands from a trial of it, the first from the trial with this index.
    seed: Seed,
    first: u32,
    /// `None`: the creature does not come to rest there.
    worlds: Vec<Option<World>>,
}

#[derive(Clone)]
enum World {
    InLanes(Box<LaneEnvironment>),
    InRapier(Box<Episode<RapierEnvironment>>),
}

/// How long a controller is played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Until {
    /// The whole episode.
    Over,
    /// Until the gait is lost, if lanes play it; or, of a controller whose gait is lost in more than so many worlds, not at all.
    Lost { most: usize },
}

/// Feet are no longer than this, m.
const MARGIN: f64 = 5.0;

/// A controller in a world.
type Pair<'a, W> = (usize, &'a Network, &'a W);

impl Worlds {
    /// Builds worlds under these conditions and in these landscapes, on the threads of the current pool.
    pub fn new(judge: &Judge, worlds: &[(Conditions, Landscape)]) -> Self {
        let build = |(conditions, landscape): &(Conditions, Landscape)| World::new(judge, conditions, landscape);
        let worlds = worlds.par_iter().map(build).collect();
        Self { rules: judge.rules().cloned(), seconds: judge.seconds(), seed: judge.seed(), first: 0, worlds }
    }

    /// The same worlds, of which the first draws from the trial with this index: for those that are a part of more.
    #[must_use]
    pub(crate) fn beginning_with_trial(self, first: u32) -> Self {
        Self { first, ..self }
    }

    /// The same worlds, in which gaits are played for at most so many seconds: enough to choose between candidates, and too
    /// short for a verdict.
    #[must_use]
    pub(crate) fn shortened(self, seconds: f64) -> Self {
        Self { seconds: self.seconds.min(seconds), ..self }
    }

    /// The judge's own world alone, in lanes; `None` if they cannot simulate it.
    pub(crate) fn reference(judge: &Judge) -> Option<Self> {
        let world = World::InLanes(Box::new(judge.lanes()?.clone()));
        Some(Self {
            rules: judge.rules().cloned(),
            seconds: judge.seconds(),
            seed: judge.seed(),
            first: 0,
            worlds: vec![Some(world)],
        })
    }

    /// How many worlds there are.
    pub fn len(&self) -> usize {
        self.worlds.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.worlds.is_empty()
    }

    /// Measures what a controller does in each world, on the threads of the current pool. `None`: there is nothing to
    /// measure.
    pub fn judge(&self, network: &Network) -> Vec<Option<GaitReport>> {
        self.judge_all(std::slice::from_ref(network)).pop().unwrap_or_default()
    }

    /// The same for several controllers.
    pub fn judge_all(&self, networks: &[Network]) -> Vec<Vec<Option<GaitReport>>> {
        self.play(networks, Until::Over)
    }

    /// The verdict on each of several controllers in each world; `None` for one that is not usable and [is
    /// lost](Rules::is_lost) before its episode is over, and where there is nothing to measure.
    pub(crate) fn verdicts(&self, networks: &[Network]) -> Vec<Vec<Option<Judgement>>> {
        let reports = self.play(networks, Until::Lost { most: self.len() });
        reports.into_iter().map(|worlds| worlds.into_iter().map(|report| report?.verdict).collect()).collect()
    }

    fn play(&self, networks: &[Network], until: Until) -> Vec<Vec<Option<GaitReport>>> {
        let (mut in_lanes, mut in_rapier): (Vec<Pair<'_, _>>, Vec<Pair<'_, _>>) = (Vec::new(), Vec::new());
        let every = networks.iter().flat_map(|network| self.worlds.iter().map(move |world| (network, world)));
        for (place, (network, world)) in every.enumerate() {
            match world {
                Some(World::InLanes(environment)) => in_lanes.push((place, network, &**environment)),
                Some(World::InRapier(episode)) => in_rapier.push((place, network, &**episode)),
                None => {}
            }
        }
        let measured_in_rapier = in_rapier.into_par_iter().map(|(place, network, episode)| {
            let steps = steps_of(self.seconds, episode.environment().settings().time_step);
            let recording = record(&episode.shortened(steps), network, self.seed_of(place));
            (place, measure(episode.environment(), self.rules.as_deref(), &recording.snapshots))
        });
        let measured_in_lanes = in_lanes.par_chunks(LANES).flat_map(|pairs| self.judge_in_lanes(pairs, until));
        let mut reports: Vec<Vec<Option<GaitReport>>> = vec![vec![None; self.len()]; networks.len()];
        for (place, gait) in measured_in_lanes.chain(measured_in_rapier).collect::<Vec<_>>() {
            reports[place / self.len()][place % self.len()] = gait.map(|gait| gait.report);
        }
        reports
    }

    /// What the world at this place among plays draws from.
    fn seed_of(&self, place: usize) -> Seed {
        self.seed.trial(self.first + (place % self.len()) as u32)
    }

    /// In how many worlds nothing but its length speaks against the gait of a controller; fewer than `needed`, how many does
    /// not matter, if it is so in fewer than these.
    pub(crate) fn usable(&self, network: &Network, needed: usize) -> usize {
        self.usable_all(std::slice::from_ref(network), needed).first().copied().unwrap_or(0)
    }

    /// The same for several controllers.
    pub(crate) fn usable_all(&self, networks: &[Network], needed: usize) -> Vec<usize> {
        let length = |reason: &Reason| matches!(reason, Reason::TooShort { .. });
        let sound = |verdict: &Judgement| verdict.reasons.iter().all(length);
        // A body that explodes breaks off before.
        let is_whole = |report: &GaitReport| report.duration > self.seconds - report.time_step;
        let most = self.len().saturating_sub(needed);
        let reports = self.play(networks, Until::Lost { most });
        let count = |reports: Vec<Option<GaitReport>>| {
            let whole = reports.into_iter().flatten().filter(is_whole);
            whole.filter_map(|report| report.verdict).filter(sound).count()
        };
        reports.into_iter().map(count).collect()
    }

    /// So many controllers keep all threads of the current pool at work, with no lane empty.
    pub(crate) fn at_once(&self) -> usize {
        (LANES * rayon::current_num_threads() / self.len().max(1)).max(1)
    }

    fn judge_in_lanes(&self, pairs: &[Pair<'_, LaneEnvironment>], until: Until) -> Vec<(usize, Option<Gait>)> {
        let Some((_, _, environment)) = pairs.first() else { return Vec::new() };
        // Nothing varies in these worlds: nothing but commands comes from the seed, and nothing can go wrong.
        let starts = pairs.iter().map(|&(place, _, world)| world.settled(self.seed_of(place)).ok());
        let begun: Vec<_> = pairs.iter().zip(starts).filter_map(|(pair, start)| Some((pair, start?))).collect();
        let steps = |world: &LaneEnvironment| steps_of(self.seconds, world.settings().time_step);
        let plays: Vec<Play<'_>> =
            begun.iter().map(|((_, network, world), start)| Play { network, start, steps: steps(world) }).collect();
        let bodies: Vec<_> = begun.iter().map(|((_, _, world), _)| world.body()).collect();
        let is_lost = |play: usize, now: &Snapshot| match (&self.rules, bodies[play]) {
            (Some(rules), Some(body)) => rules.is_lost(body, now),
            _ => false,
        };
        let controller = |play: usize| begun[play].0.0 / self.len();
        // In how many worlds each controller is lost; places ascend.
        let mut lost = vec![0; begun.len().checked_sub(1).map_or(0, |last| controller(last) + 1)];
        let mut recordings: Vec<Vec<Snapshot>> = vec![Vec::new(); plays.len()];
        envs_lanes::play(environment, &plays, |play, snapshot| {
            if let Until::Lost { most } = until {
                let lost = &mut lost[controller(play)];
                let now = is_lost(play, snapshot);
                *lost += usize::from(now);
                if now || *lost > most {
                    // There is nothing to measure in an empty recording.
                    recordings[play] = Vec::new();
                    return false;
                }
            }
            recordings[play].push(snapshot.clone());
            true
        });
        // A recording may have megabytes: each goes as soon as it is measured.
        let measured = |((place, _, world), snapshots): (&Pair<'_, LaneEnvironment>, Vec<Snapshot>)| {
            (*place, measure(*world, self.rules.as_deref(), &snapshots))
        };
        let pairs: Vec<&Pair<'_, LaneEnvironment>> = begun.iter().map(|(pair, _)| *pair).collect();
        pairs.into_par_iter().zip(recordings).map(measured).collect()
    }
}

impl World {
    /// `None` if the world makes no sense, or the creature does not come to rest there.
    fn new(judge: &Judge, conditions: &Conditions, landscape: &Landscape) -> Option<Self> {
        match judge.lanes().map(|lanes| lanes.under_varied(conditions, landscape.clone())) {
            Some(Ok(environment)) => Some(Self::InLanes(Box::new(environment))),
            // What lanes refuse rapier may simulate.
            None | Some(Err(EnvironmentError::Unsupported { .. })) => {
                let environment = judge.environment().under_varied(conditions, landscape.clone()).ok()?;
                let steps = steps_of(judge.seconds(), environment.settings().time_step);
                let episode = Episode::new(environment, judge.movement(), steps, Trials::default()).ok()?;
                Some(Self::InRapier(Box::new(episode)))
            }
            Some(Err(_)) => None,
        }
    }
}

/// Measures a recording of a world; `None` for one that breaks off at once.
pub(crate) fn measure<E: Engine>(
    environment: &CreatureEnvironment<E>,
    rules: Option<&dyn Rules>,
    snapshots: &[Snapshot],
) -> Option<Gait> {
    let body = environment.body()?;
    let trajectory = Trajectory::new(body, snapshots).ok()?;
    let ground = || environment.landscape().ground.profile(extent(snapshots));
    let trajectory = if body.uneven_ground { trajectory.on_terrain(ground()) } else { trajectory };
    let report = GaitReport::of(&trajectory, rules);
    Some(Gait { report, obstacles: ObstaclesPassed::count(environment.landscape(), snapshots) })
}

/// From where to where parts have been, with room for their size, m.
fn extent(snapshots: &[Snapshot]) -> [f64; 2] {
    let places = || snapshots.iter().flat_map(|snapshot| &snapshot.parts).map(|part| f64::from(part.x));
    [places().fold(f64::INFINITY, f64::min) - MARGIN, places().fold(f64::NEG_INFINITY, f64::max) + MARGIN]
}

/// Whether what was measured is a usable gait; never for a movement that is not judged.
pub(crate) fn is_usable(report: &GaitReport) -> bool {
    report.verdict.as_ref().is_some_and(|verdict| verdict.usable)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::near::near_worlds;
    use crate::perturbation::{
        self,
        tests::{judge, judge_in_water, judge_with},
    };
    use creatures::Terrain;
    use envs_core::{Ground, PhysicsSettings};
    use ne_net::{DenseNet, DenseShape};
    use tasks::gait::Findings;

    fn network(judge: &Judge, seed: usize) -> Network {
        let shape = DenseShape::new(judge.environment().inputs(), vec![], judge.environment().outputs());
        let weights: Vec<f32> = (0..shape.weight_count()).map(|index| (index * seed % 7) as f32 * 0.3 - 0.8).collect();
        DenseNet::new(shape, &weights).expect("a net").into()
    }

    fn perturbed(judge: &Judge) -> Vec<(Conditions, Landscape)> {
        let draw = |index| {
            let world = perturbation::World::draw(Seed::of_run(4), index, judge, 5.0);
            (world.conditions, world.landscape)
        };
        (0..5).map(draw).collect()
    }

    #[test]
    fn lanes_measure_what_rapier_measures() {
        for (creature, movement) in [("tetrapod-1", "jumping"), ("biped-1", "running")] {
            let judge = judge(creature, movement);
            let reference = (Conditions::reference(judge.environment().outputs()), Ground::flat().into());
            let conditions: Vec<_> = perturbed(&judge).into_iter().chain([reference]).collect();
            let networks = [network(&judge, 3), network(&judge, 5)];
            let reports = Worlds::new(&judge, &conditions).judge_all(&networks);
            assert_eq!(reports, Worlds::new(&judge.clone().in_rapier(), &conditions).judge_all(&networks));
            for (network, reports) in networks.iter().zip(&reports) {
                assert_eq!(reports.len(), 6);
                assert!(reports.iter().all(Option::is_some));
                assert_eq!(reports[5], judge.measure_alone(network).map(|gait| gait.report));
                assert_ne!(reports[0], reports[5], "another world, another gait");
            }
        }
    }

    /// What is lost and not played to its end has no verdict; all others have theirs.
    #[test]
    fn whether_a_gait_is_usable_does_not_depend_on_how_long_it_is_played() {
        let judge = judge("biped-1", "running");
        let networks: Vec<Network> = (2..8).map(|seed| network(&judge, seed)).collect();
        let worlds = Worlds::new(&judge, &perturbed(&judge));
        let whole = worlds.judge_all(&networks).into_iter().flatten().map(|report| report?.verdict);
        let mut lost = 0;
        for (whole, verdict) in whole.zip(worlds.verdicts(&networks).into_iter().flatten()) {
            match (whole, verdict) {
                (whole, Some(verdict)) => assert_eq!(whole, Some(verdict)),
                (Some(whole), None) => {
                    assert!(whole.reasons.iter().any(|reason| matches!(reason, Reason::Tilted { .. })));
                    lost += 1;
                }
                (None, None) => {}
            }
        }
        assert!(lost > 0, "none fell");
    }

    #[test]
    fn swimmers_are_measured_in_perturbed_worlds_and_on_no_ground() {
        let judge = judge_in_water("apod", "swimming");
        let reference = (Conditions::reference(judge.environment().outputs()), Ground::none().into());
        let worlds: Vec<_> = perturbed(&judge).into_iter().chain([reference]).collect();
        let network = network(&judge, 3);
        let reports = Worlds::new(&judge, &worlds).judge(&network);
        assert!(reports.iter().all(Option::is_some), "{reports:?}");
        assert_eq!(reports[5], judge.measure_alone(&network).map(|gait| gait.report));
        assert_ne!(reports[4], reports[5], "all causes but bumps");
    }

    #[test]
    fn near_worlds_draw_commands_of_their_own() {
        let judge = judge("biped-1", "running");
        let near = judge.near();
        assert!((0..near.len()).all(|place| near.seed_of(place) != judge.seed().trial(0)));
        assert_eq!(judge.seed().trial(0), judge.seed(), "the reference episode's");
    }

    /// Has nothing against any gait.
    #[derive(Debug)]
    struct Lenient;

    impl Rules for Lenient {
        fn name(&self) -> &str {
            "lenient"
        }

        fn seconds(&self) -> f64 {
            2.0
        }

        fn judge(&self, _: &GaitReport, _: &Trajectory<'_>) -> Findings {
            Findings::default()
        }
    }

    /// A body that explodes breaks off, and a short recording alone speaks against no gait in a short trial.
    #[test]
    fn a_world_in_which_the_body_explodes_does_not_count() {
        let usable = |unstable_speed: f32, seconds: f64| {
            let physics = PhysicsSettings { unstable_speed, ..PhysicsSettings::default() };
            let judge = judge_with("biped-1", "jumping", &Terrain::default(), physics);
            let world = (Conditions::reference(judge.environment().outputs()), Ground::flat().into());
            let worlds = Worlds { rules: Some(Arc::new(Lenient)), seconds: 2.0, ..Worlds::new(&judge, &[world]) };
            worlds.shortened(seconds).usable(&network(&judge, 3), 0)
        };
        assert_eq!([usable(100.0, 2.0), usable(100.0, 1.5)], [1, 1]);
        // It is faster than 2 m/s after 1.36 s.
        assert_eq!([usable(2.0, 2.0), usable(2.0, 1.5), usable(2.0, 1.0)], [0, 0, 1]);
    }

    /// A near world of the longest step has a longer one.
    #[test]
    fn worlds_are_built_about_settings_at_the_ends_of_their_ranges() {
        let longest = PhysicsSettings { time_step: 0.05, gravity: 100.0, ..PhysicsSettings::default() };
        let shortest = PhysicsSettings { time_step: 0.001, ..PhysicsSettings::default() };
        for physics in [longest, shortest] {
            let judge = judge_with("biped-1", "jumping", &Terrain::default(), physics);
            let motors = judge.environment().outputs();
            let near = near_worlds(motors).into_iter().map(|conditions| (conditions, Ground::flat().into()));
            let worlds: Vec<_> = perturbed(&judge).into_iter().chain(near).collect();
            let built = Worlds::new(&judge, &worlds).worlds;
            assert!(built.iter().all(Option::is_some), "{:?}", built.iter().map(Option::is_some).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_world_that_makes_no_sense_has_nothing_to_measure() {
        let judge = judge("biped-1", "jumping");
        let reference = Conditions::reference(judge.environment().outputs());
        let heavy = Conditions { mass: f32::NAN, ..reference.clone() };
        let worlds = [reference, heavy].map(|conditions| (conditions, Ground::flat().into()));
        let reports = Worlds::new(&judge, &worlds).judge(&network(&judge, 3));
        assert_eq!(reports.iter().map(Option::is_some).collect::<Vec<_>>(), [true, false]);
        assert!(Worlds::new(&judge, &[]).judge(&network(&judge, 3)).is_empty());
    }
}
