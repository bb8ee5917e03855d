//! Controllers played in worlds of their own: every moment is rapier's, to the bit.

use crate::stage::{both, nets, shipped};
use envs_core::{PhysicsSettings, Settled, Variation};
use envs_lanes::{LANES, LaneEngine, LaneEnvironment, Play, play};
use envs_rapier::RapierEnvironment;
use ne_core::{Failure, Seed};
use ne_net::{DenseNet, DenseShape, Network};
use tasks::{Environment, Episode, Moment, Outcome, Running, Snapshot, Trials};

/// Several plays in each lane.
const PLAYS: usize = 2 * LANES + 5;

/// A creature in both engines: in worlds that all have bumps, and in one that is flat.
struct Scene {
    bumpy: (RapierEnvironment, LaneEnvironment),
    flat: (RapierEnvironment, LaneEnvironment),
}

impl Scene {
    fn new(name: &str, settings: PhysicsSettings) -> Self {
        let blueprint = shipped(name);
        let sensors = blueprint.creature().sensors.clone();
        let in_worlds = |variation| both(&blueprint, &sensors, settings, variation);
        Self { bumpy: in_worlds(Variation::strong()), flat: in_worlds(Variation::default()) }
    }

    fn worlds(&self, play: usize) -> &(RapierEnvironment, LaneEnvironment) {
        if play.is_multiple_of(3) { &self.flat } else { &self.bumpy }
    }

    fn start(&self, play: usize) -> Settled<LaneEngine> {
        self.worlds(play).1.settled(seed(play)).expect("it comes to rest")
    }

    /// What rapier shows of a play, and how it ends.
    fn in_rapier(&self, play: usize, network: &Network, steps: u32) -> (Vec<Snapshot>, Outcome) {
        let environment = self.worlds(play).0.clone();
        let movement = Box::new(Running::default());
        let episode = Episode::new(environment, movement, steps, Trials::default()).expect("valid");
        let mut shown = Vec::new();
        let mut watch = |moment: &Moment<'_>| shown.push(moment.snapshot.clone());
        let played = episode.play(&mut network.clone(), seed(play), &mut watch);
        (shown, played.outcome)
    }
}

fn seed(play: usize) -> Seed {
    Seed::of_run(3).trial(play as u32)
}

fn steps(play: usize) -> u32 {
    20 + 13 * (play as u32 % 7)
}

/// Plays all, and compares each with rapier.
fn compare(scene: &Scene, networks: &[Network]) -> Vec<Outcome> {
    let starts: Vec<Settled<LaneEngine>> = (0..PLAYS).map(|play| scene.start(play)).collect();
    let network = |play: usize| &networks[play % networks.len()];
    let plays: Vec<Play<'_>> =
        (0..PLAYS).map(|play| Play { network: network(play), start: &starts[play], steps: steps(play) }).collect();
    let mut shown: Vec<Vec<Snapshot>> = vec![Vec::new(); PLAYS];
    let outcomes = play(&scene.flat.1, &plays, |play, snapshot| {
        shown[play].push(snapshot.clone());
        true
    });
    for (play, (shown, outcome)) in shown.iter().zip(&outcomes).enumerate() {
        let (wanted, ended) = scene.in_rapier(play, network(play), steps(play));
        assert_eq!((shown, outcome), (&wanted, &ended), "play {play}");
    }
    outcomes
}

fn networks(environment: &impl Environment, count: usize) -> Vec<Network> {
    nets(environment.inputs(), environment.outputs(), count).into_iter().map(Into::into).collect()
}

/// A net of another topology.
fn other(environment: &impl Environment) -> Network {
    let shape = DenseShape::new(environment.inputs(), vec![3], environment.outputs());
    let weights: Vec<f32> = (0..shape.weight_count()).map(|index| (index % 5) as f32 - 2.0).collect();
    DenseNet::new(shape, &weights).expect("valid").into()
}

#[test]
fn every_moment_is_that_of_rapier() {
    for name in ["apod", "biped-1", "tetrapod-2"] {
        let scene = Scene::new(name, PhysicsSettings::default());
        let alike = networks(&scene.flat.1, 4);
        let outcomes = compare(&scene, &alike);
        assert!(outcomes.iter().all(|outcome| outcome.failure.is_none()), "{name}: {outcomes:?}");
        let mixed: Vec<Network> = alike.into_iter().chain([other(&scene.flat.1)]).collect();
        compare(&scene, &mixed);
    }
}

#[test]
fn what_goes_wrong_ends_a_play_and_no_other() {
    let settings = PhysicsSettings { unstable_speed: 4.0, ..PhysicsSettings::default() };
    let scene = Scene::new("tetrapod-1", settings);
    let moving = networks(&scene.flat.1, 3);
    let shape = DenseShape::new(scene.flat.1.inputs(), vec![10], scene.flat.1.outputs());
    let still: Network = DenseNet::new(shape.clone(), &vec![0.0; shape.weight_count()]).expect("valid").into();
    let outcomes = compare(&scene, &moving.into_iter().chain([still.clone()]).collect::<Vec<_>>());
    let failed = outcomes.iter().filter(|outcome| outcome.failure.is_some()).count();
    assert!((1..PLAYS).contains(&failed), "{failed} of {PLAYS}");

    let start = scene.start(0);
    let environment = &scene.flat.1;
    let shape = DenseShape::new(environment.inputs() + 1, vec![], environment.outputs());
    let misfit = DenseNet::new(shape.clone(), &vec![0.0; shape.weight_count()]).expect("valid").into();
    let plays = [&misfit, &still].map(|network| Play { network, start: &start, steps: 5 });
    let mut shown = Vec::new();
    let outcomes = play(environment, &plays, |play, _| {
        shown.push(play);
        true
    });
    assert!(matches!(outcomes[0].failure, Some(Failure::ShapeMismatch { .. })), "{outcomes:?}");
    assert_eq!((outcomes[1].steps, shown), (5, vec![1; 6]));
}

#[test]
fn the_observer_may_end_a_play() {
    let scene = Scene::new("biped-1", PhysicsSettings::default());
    let (network, starts) = (other(&scene.flat.1), (0..PLAYS).map(|play| scene.start(play)).collect::<Vec<_>>());
    let plays: Vec<Play<'_>> = starts.iter().map(|start| Play { network: &network, start, steps: 30 }).collect();
    let mut shown = vec![0; PLAYS];
    // Each is left after as many steps as its index; the last ones end by themselves.
    let outcomes = play(&scene.flat.1, &plays, |play, _| {
        shown[play] += 1;
        shown[play] <= play
    });
    let wanted: Vec<u32> = (0..PLAYS as u32).map(|play| play.min(30)).collect();
    assert_eq!(outcomes.iter().map(|outcome| outcome.steps).collect::<Vec<_>>(), wanted);
    let moments: Vec<usize> = wanted.iter().map(|&steps| steps as usize + 1).collect();
    assert_eq!(shown, moments);
    let none = [Play { network: &network, start: &starts[0], steps: 0 }];
    assert_eq!(play(&scene.flat.1, &none, |_, _| true)[0].steps, 0);
}
