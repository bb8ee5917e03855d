//! Whole evaluations: batches in lanes against one creature at a time in rapier.

use crate::stage::{SHIPPED, all_sensors, both, nets, shipped};
use creatures::Actuation;
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::{Instructions, LaneEpisode};
use ne_core::{Evaluation, Phenotype, Seed, Task};
use ne_net::DenseNet;
use tasks::{
    Body, Combine, Energy, Environment, Episode, FallEnds, Jumping, Movement, Objectives, Rollovers, Running, Snapshot,
    Sum, TimeAloft, Trials, Verdict,
};

fn movement() -> Box<dyn Movement> {
    let all = Sum::of(Running::default()).plus(-1e-4, Energy::default()).plus(0.5, Jumping::default());
    let all = all.plus(-0.1, Rollovers::default()).plus(0.2, TimeAloft::default());
    // An objective that would end the episode must not.
    let energy = Objectives::beside(Box::new(all)).and(-1.0, Box::new(Energy::default()));
    Box::new(energy.and(1.0, Box::new(Running::default())).and(-2.0, Box::new(FallEnds::default())))
}

fn batch(task: &LaneEpisode, nets: &mut [DenseNet], seed: Seed) -> Vec<Evaluation> {
    let mut phenotypes: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
    task.evaluate_batch(&mut phenotypes, seed)
}

#[test]
fn a_batch_gives_what_rapier_gives() {
    for name in SHIPPED {
        let blueprint = shipped(name);
        let sensors = all_sensors(&blueprint);
        let trials = Trials { count: 2, combine: Combine::Mean, lessons: false };
        let worlds = [Variation::default(), Variation::light(), Variation::strong()];
        for (variation, actuation) in worlds.into_iter().zip([Actuation::Speed, Actuation::angle(), Actuation::angle()])
        {
            let (rapier, lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), variation);
            let rapier = rapier.with_actuation(actuation).expect("a gain in range");
            let lanes = lanes.with_actuation(actuation).expect("a gain in range");
            let rapier = Episode::new(rapier, movement(), 150, trials).expect("valid");
            let lanes = LaneEpisode::new(lanes, movement(), 150, trials).expect("valid");
            let mut nets = nets(rapier.inputs(), rapier.outputs(), 20);
            let found = batch(&lanes, &mut nets, Seed::of_run(3));
            for (net, found) in nets.iter_mut().zip(found) {
                assert_eq!(found.objectives.len(), if found.outcome.is_ok() { 3 } else { 0 });
                assert_eq!(found, rapier.evaluate(net, Seed::of_run(3)), "{name}, {variation:?}");
            }
        }
    }
}

/// Worth what the body weighs that it was told of, N.
#[derive(Clone, Default)]
struct Weighing(f64);

impl Movement for Weighing {
    fn name(&self) -> &str {
        "weighing"
    }

    fn unit(&self) -> &str {
        "N"
    }

    fn bind(&mut self, body: &Body) {
        self.0 = body.weight();
    }

    fn begin(&mut self, _: &Snapshot) {}

    fn observe(&mut self, _: &Snapshot) -> Verdict {
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.0
    }
}

#[test]
fn a_movement_is_told_what_the_body_weighs_in_each_trial() {
    let blueprint = shipped("tetrapod-1");
    let sensors = blueprint.creature().sensors.clone();
    let variation = Variation { mass: 0.5, gravity: 0.5, ..Variation::default() };
    let trials = Trials { count: 5, combine: Combine::Mean, lessons: false };
    let (rapier, lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), variation);
    let rapier = Episode::new(rapier, Box::<Weighing>::default(), 10, trials).expect("valid");
    let lanes = LaneEpisode::new(lanes, Box::<Weighing>::default(), 10, trials).expect("valid");
    let (seed, mut nets) = (Seed::of_run(4), nets(rapier.inputs(), rapier.outputs(), 40));
    let reference = rapier.environment().body().expect("a creature").weight();
    let weights = (0..trials.count).map(|trial| {
        let world = variation.draw(seed.trial(trial), rapier.outputs());
        reference * f64::from(world.mass) * f64::from(world.gravity)
    });
    let expected = weights.sum::<f64>() / f64::from(trials.count);
    for (net, found) in nets.clone().iter_mut().zip(batch(&lanes, &mut nets, seed)) {
        let fitness = found.outcome.as_ref().expect("stands").get();
        assert!((fitness / expected - 1.0).abs() < 1e-5, "{fitness} N, not {expected}");
        assert_eq!(found, rapier.evaluate(net, seed));
    }
}

/// Falls end episodes at different times, so that lanes are refilled all the time.
#[test]
fn neither_neighbours_nor_instructions_change_a_bit() {
    let blueprint = shipped("biped-1");
    let sensors = blueprint.creature().sensors.clone();
    let (_, lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), Variation::light());
    let falls = || Box::new(Sum::of(Running::default()).plus(-1.0, FallEnds::default()));
    let trials = Trials { count: 3, combine: Combine::Worst, lessons: false };
    let task = LaneEpisode::new(lanes, falls(), 200, trials).expect("valid");
    let seed = Seed::of_run(8);
    let mut nets = nets(task.inputs(), task.outputs(), 70);
    let alone: Vec<Evaluation> = nets.iter_mut().map(|net| task.evaluate(net, seed)).collect();
    assert!(alone.iter().any(|evaluation| evaluation.steps < 600), "no creature falls");
    for instructions in Instructions::available() {
        let task = task.clone().with_instructions(instructions);
        assert_eq!(batch(&task, &mut nets, seed), alone, "{instructions}");
        for size in [1, 2, 15, 16, 17, 33] {
            let found: Vec<Evaluation> = nets.chunks_mut(size).flat_map(|nets| batch(&task, nets, seed)).collect();
            assert_eq!(found, alone, "batches of {size}, {instructions}");
        }
    }
}

#[test]
fn fewer_trials_and_steps_are_the_first_ones() {
    let blueprint = shipped("biped-1");
    let sensors = blueprint.creature().sensors.clone();
    let (_, lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), Variation::light());
    let task = |steps, count| {
        let trials = Trials { count, combine: Combine::Worst, lessons: false };
        LaneEpisode::new(lanes.clone(), movement(), steps, trials).expect("valid")
    };
    let mut nets = nets(lanes.inputs(), lanes.outputs(), 5);
    let mut evaluate = |task: &LaneEpisode| batch(task, &mut nets, Seed::of_run(4));
    let whole = task(60, 4);
    for (fewer, count) in [(0, 1), (1, 1), (3, 3), (4, 4), (9, 4)] {
        let cheaper = whole.shortened(20).with_fewer_trials(fewer);
        assert_eq!(evaluate(&cheaper), evaluate(&task(20, count)), "{fewer} of 4 trials");
    }
}
