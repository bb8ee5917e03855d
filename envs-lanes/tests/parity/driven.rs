//! Creatures that are driven from outside: with a net's outputs as actions, rapier's episodes to the bit.

use crate::stage::{both, nets, shipped};
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::{DrivenEnd, DrivenLanes, LANES, LaneEpisode};
use ne_core::{Failure, Phenotype, Seed, Task};
use tasks::{Environment, Episode, FallEnds, Movement, Running, Snapshot, Sum, TimeAloft, Trials};

const STEPS: u32 = 150;

fn movement() -> Box<dyn Movement> {
    Box::new(Sum::of(Running::default()).plus(0.25, TimeAloft::default()).plus(-0.1, FallEnds::default()))
}

/// Lanes each with an episode of another seed, one after the other, driven by nets; compared with what rapier's episode
/// shows and with its fitness.
fn compare(name: &str, variation: Variation) {
    let blueprint = shipped(name);
    let sensors = blueprint.creature().sensors.clone();
    let (rapier, lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), variation);
    let episode = LaneEpisode::new(lanes, movement(), STEPS, Trials::default()).expect("valid");
    let reference = Episode::new(rapier, movement(), STEPS, Trials::default()).expect("valid");
    let mut driven = DrivenLanes::new(&episode);
    let (inputs, outputs) = (driven.inputs(), driven.outputs());
    // The last lane stays empty.
    let mut nets = nets(inputs, outputs, LANES - 1);
    let seed = |lane: usize, round: u32| Seed::of_run(7 + lane as u64).trial(round);
    let mut shown: Vec<Vec<Snapshot>> = vec![Vec::new(); nets.len()];
    let mut rewards = vec![0.0; nets.len()];
    let mut rounds = vec![0; nets.len()];
    for (lane, net) in nets.iter_mut().enumerate() {
        driven.begin(lane, &episode.environment().settled(seed(lane, 0)).expect("it comes to rest"));
        net.reset();
    }
    let (mut sensed, mut wanted) = (vec![0.0; inputs], vec![0.0; outputs]);
    while rounds.iter().any(|&round| round < 2) {
        driven.sense();
        for (lane, net) in nets.iter_mut().enumerate() {
            driven.read(lane, &mut sensed);
            net.activate(&sensed, &mut wanted);
            driven.act(lane, &wanted);
        }
        let mut ended = Vec::new();
        driven.step(&mut |lane, step| {
            rewards[lane] += step.reward;
            ended.extend(step.end.map(|end| (lane, end)));
        });
        for (lane, shown) in shown.iter_mut().enumerate() {
            if driven.plays(lane) || ended.iter().any(|(ended, _)| *ended == lane) {
                shown.push(driven.snapshot(lane).clone());
            }
        }
        for (lane, end) in ended {
            assert!(matches!(end, DrivenEnd::OutOfTime | DrivenEnd::Ended), "{end:?}");
            let seed_now = seed(lane, rounds[lane]);
            let mut expected = Vec::new();
            let mut net = nets[lane].clone();
            let played = reference.play(&mut net, seed_now, &mut |moment: &tasks::Moment<'_>| {
                if moment.step > 0 {
                    expected.push(moment.snapshot.clone());
                }
            });
            assert_eq!(shown[lane], expected, "{name}, lane {lane}");
            assert_eq!(driven.value(lane), played.movement.value());
            let fitness = episode_fitness(&reference, &mut nets[lane], seed_now);
            assert_eq!(driven.value(lane), fitness);
            assert!((rewards[lane] - fitness).abs() <= 1e-12 * f64::from(STEPS), "{} for {fitness}", rewards[lane]);
            rounds[lane] += 1;
            (rewards[lane], shown[lane]) = (0.0, Vec::new());
            nets[lane].reset();
            let start = episode.environment().settled(seed(lane, rounds[lane])).expect("it comes to rest");
            driven.begin(lane, &start);
        }
    }
}

/// What training says an episode is worth: the trial 0 of a seed, so played by a task whose trial it is.
fn episode_fitness<E: Environment>(episode: &Episode<E>, net: &mut dyn Phenotype, seed: Seed) -> f64 {
    if seed.trial_index() > 0 {
        let played = episode.play(net, seed, &mut ());
        assert_eq!(played.outcome.failure, None);
        return played.movement.value();
    }
    episode.evaluate(net, seed).fitness().expect("it does not fail").get()
}

#[test]
fn an_episode_driven_by_a_net_has_the_bits_of_rapier_and_its_rewards_are_its_fitness() {
    for name in ["biped-1", "tetrapod-2"] {
        compare(name, Variation::default());
    }
}

#[test]
fn worlds_that_vary_and_level_ones_beside_them_are_driven_too() {
    compare("biped-2", Variation::strong());
    // Of these some have bumps and some have none.
    compare("tetrapod-1", Variation { bumps: 0.02, ..Variation::default() });
}

#[test]
fn an_action_that_is_no_number_ends_the_episode_of_its_lane_alone() {
    let blueprint = shipped("biped-1");
    let sensors = blueprint.creature().sensors.clone();
    let (_, lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), Variation::default());
    let episode = LaneEpisode::new(lanes, Box::new(Running::default()), 10, Trials::default()).expect("valid");
    let start = episode.environment().settled(Seed::of_run(1)).expect("it comes to rest");
    let mut driven = DrivenLanes::new(&episode);
    let motors = driven.outputs();
    driven.begin(3, &start);
    driven.begin(4, &start);
    driven.act(3, &vec![f32::NAN; motors]);
    driven.act(4, &vec![9.0; motors]);
    let mut seen = Vec::new();
    driven.step(&mut |lane, step| seen.push((lane, step)));
    let failure = Failure::NonFinite { what: "output 0".into() };
    assert_eq!(seen[0].1, envs_lanes::DrivenStep { reward: 0.0, end: Some(DrivenEnd::Failed(failure)) });
    assert_eq!((seen[1].0, &seen[1].1.end), (4, &None));
    // It can begin anew, and what is beyond 1 is 1.
    driven.begin(3, &start);
    driven.begin(4, &start);
    driven.act(3, &vec![1.0; motors]);
    driven.act(4, &vec![9.0; motors]);
    for _ in 0..10 {
        driven.step(&mut |_, step| assert!(step.reward.is_finite()));
    }
    assert_eq!(driven.snapshot(3), driven.snapshot(4));
    assert!(!driven.plays(3), "it is out of time");
}
