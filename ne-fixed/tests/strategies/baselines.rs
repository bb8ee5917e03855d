//! What the baselines promise: random search, hill climbing and augmented random search.

use crate::common::{
    assert_damages_are_found, assert_resumes, dense, digest, evaluations_to, generation, generation_of, recurrent,
    score, weights,
};
use ne_core::{
    Evaluation, Failure, Genome, Seed, Strategy,
    conformance::{StrategyOptions, check_strategy},
};
use ne_fixed::{
    Ars, ArsSettings, HillClimbing, HillClimbingSettings, Initialization, RandomSearch, RandomSearchSettings,
};
use ne_net::{Topology, TopologyMap};
use proptest::prelude::*;
use serde_json::json;

fn random() -> RandomSearch {
    RandomSearch::new(RandomSearchSettings::default(), dense()).expect("valid settings")
}

fn climber(settings: HillClimbingSettings) -> HillClimbing {
    HillClimbing::new(settings, dense()).expect("valid settings")
}

fn ars(settings: ArsSettings) -> Ars {
    Ars::new(settings, dense()).expect("valid settings")
}

/// Settings far from the defaults.
fn coarse() -> HillClimbingSettings {
    HillClimbingSettings { population: 5, mutation_rate: 0.2, mutation_deviation: 2.0, ..Default::default() }
}

/// As the paper has it: from 0, and all directions used.
fn v1() -> ArsSettings {
    let initial_centre = Initialization::Uniform { limit: 0.0 };
    ArsSettings { population: 8, top_directions: 1.0, initial_centre, ..Default::default() }
}

#[test]
fn they_keep_the_promises_of_a_strategy() {
    fn keeps<S>(make: impl Fn(Topology) -> S)
    where
        S: Strategy<Genome: Genome> + serde::Serialize + serde::de::DeserializeOwned,
        S::Genome: serde::Serialize + serde::de::DeserializeOwned,
    {
        for topology in [Topology::from(dense()), Topology::from(recurrent())] {
            check_strategy(|| make(topology.clone()), &StrategyOptions::default()).expect("keeps its promises");
        }
    }
    keeps(|topology| RandomSearch::new(RandomSearchSettings::default(), topology).expect("valid"));
    for settings in [HillClimbingSettings::default(), coarse()] {
        keeps(|topology| HillClimbing::new(settings.clone(), topology).expect("valid"));
    }
    for settings in [ArsSettings::default(), v1()] {
        keeps(|topology| Ars::new(settings.clone(), topology).expect("valid"));
    }
}

#[test]
fn they_go_on_to_the_bit_after_a_save() {
    assert_resumes(random(), 4);
    assert_resumes(climber(HillClimbingSettings::default()), 6);
    assert_resumes(climber(coarse()), 6);
    assert_resumes(ars(ArsSettings::default()), 6);
    assert_resumes(ars(v1()), 6);
}

/// Golden: another digest changes every recorded run.
#[test]
fn runs_are_the_same_for_ever() {
    let digests = [
        digest(random(), 5),
        digest(climber(HillClimbingSettings::default()), 20),
        digest(climber(coarse()), 20),
        digest(ars(ArsSettings::default()), 20),
        digest(ars(v1()), 20),
    ];
    assert_eq!(
        digests,
        ["f623b6702e824a54", "471f492e5ec1c2b2", "2344e8377ad9c276", "f3ae2c8d3be13201", "a1e63dee7d0feb9c"]
    );
}

#[test]
fn errors_of_settings_name_the_field() {
    type Change<S> = (fn(&mut S), &'static str);
    fn check<S: Default>(changes: &[Change<S>], new: impl Fn(S) -> Option<String>) {
        for (change, message) in changes {
            let mut settings = S::default();
            change(&mut settings);
            assert_eq!(new(settings).as_deref(), Some(*message));
        }
    }
    check::<RandomSearchSettings>(
        &[
            (|s| s.population = 0, "population = 0: must be from 1 to 1000000"),
            (
                |s| s.initialization = Initialization::Uniform { limit: -1.0 },
                "initialization.uniform.limit = -1: must be from 0 to 1000",
            ),
        ],
        |settings| RandomSearch::new(settings, dense()).err().map(|error| error.to_string()),
    );
    check::<HillClimbingSettings>(
        &[
            (|s| s.population = 1, "population = 1: must be from 2 to 1000000"),
            (|s| s.mutation_rate = 2.0, "mutation_rate = 2: must be from 0 to 1"),
            (|s| s.mutation_deviation = f64::NAN, "mutation_deviation = NaN: must be from 0 to 1000"),
            (
                |s| s.initialization = Initialization::Uniform { limit: -1.0 },
                "initialization.uniform.limit = -1: must be from 0 to 1000",
            ),
        ],
        |settings| HillClimbing::new(settings, dense()).err().map(|error| error.to_string()),
    );
    check::<ArsSettings>(
        &[
            (|s| s.population = 7, "population = 7: must be even, from 2 to 1000000"),
            (|s| s.step_size = 0.0, "step_size = 0: must be above 0 and at most 1000"),
            (|s| s.noise = 0.0, "noise = 0: must be from 0.000001 to 1000"),
            (|s| s.top_directions = 1.5, "top_directions = 1.5: must be above 0 and at most 1"),
            (
                |s| s.initial_centre = Initialization::Uniform { limit: -1.0 },
                "initial_centre.uniform.limit = -1: must be from 0 to 1000",
            ),
        ],
        |settings| Ars::new(settings, dense()).err().map(|error| error.to_string()),
    );
}

#[test]
fn damaged_states_are_errors_that_name_the_field() {
    let mut strategy = climber(HillClimbingSettings::default());
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["settings"]["population"] = 1.into(), "population = 1: must be from 2"),
            (|s| s["parent"] = json!([1.0]), "parent[0].weights: found 1, a net of shape 3-4-2 has 26"),
            (|s| s["as_good"] = 16.into(), "as_good = 16: must be from 0 to 15"),
            (|s| s["asked"] = json!([[1.0]]), "asked: found 1 individuals, the settings say 16"),
        ],
    );
    let mut strategy = ars(ArsSettings::default());
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["settings"]["noise"] = json!(0.0), "noise = 0: must be from"),
            (|s| s["centre"] = json!([1.0]), "centre = 1 numbers: must be 26 numbers"),
            (|s| s["reward_deviation"] = json!(-1.0), "reward_deviation = -1: must be at least 0"),
            (|s| s["step_length"] = json!(-1.0), "step_length = -1: must be at least 0"),
            (
                |s| {
                    s["asked"] = json!(vec![[0.0; 26]; 33]);
                    s["centre"] = json!([]);
                },
                "centre = none: must be there when individuals were asked",
            ),
        ],
    );
    assert_damages_are_found(
        &random(),
        &[(|s| s["asked"] = json!([[1.0]]), "asked: found 1 individuals, the settings say 50")],
    );
}

#[test]
fn random_search_learns_nothing() {
    let told = |result: f64| {
        let mut strategy = random();
        generation_of(&mut strategy, 1, &Evaluation::new(result));
        strategy.ask(Seed::of_run(1).generation(2)).to_vec()
    };
    assert_eq!(told(1.0), told(-5.0));
    let fresh = random().ask(Seed::of_run(1).generation(2)).to_vec();
    assert_eq!(told(1.0), fresh);
    assert_ne!(fresh, random().ask(Seed::of_run(1).generation(3)).to_vec());
    let largest = fresh.iter().flat_map(|net| net.weights()).fold(0.0, |most: f32, weight| most.max(weight.abs()));
    assert!((0.99..=1.0).contains(&largest), "{largest}");
}

proptest! {
    /// The parent comes first in every generation, and is the best of the one before.
    #[test]
    fn the_parent_is_the_best_of_its_family(
        population in 2..30usize, mutation_rate in 0.0..1.0, mutation_deviation in 0.0..3.0, run: u64,
    ) {
        let settings = HillClimbingSettings { population, mutation_rate, mutation_deviation, ..Default::default() };
        let mut strategy = climber(settings);
        let mut last = None;
        for number in 1..=5 {
            let seed = Seed::of_run(run).generation(number);
            let family = strategy.ask(seed).to_vec();
            prop_assert_eq!(family.len(), population);
            if let Some(last) = last {
                prop_assert_eq!(&family[0], &last);
            }
            let evaluations = score(&family);
            strategy.tell(&evaluations, seed);
            let best = evaluations.iter().filter_map(Evaluation::fitness).max();
            let parent = strategy.parent().expect("there is one").clone();
            let place = family.iter().position(|net| *net == parent).expect("it is of the family");
            prop_assert_eq!(evaluations[place].fitness(), best);
            last = Some(parent);
        }
    }

    /// A step is made of the top directions, weighed by their differences and divided by the deviation of their rewards.
    #[test]
    fn the_centre_moves_as_step_7_says(top in 1..=8usize, step_size in 0.001..1.0, noise in 0.01..1.0, run: u64) {
        let top_directions = top as f64 / 8.0;
        let settings = ArsSettings { population: 16, step_size, noise, top_directions, ..Default::default() };
        let mut strategy = ars(settings);
        let seed = Seed::of_run(run).generation(1);
        let nets = strategy.ask(seed).to_vec();
        let reward = |net: &ne_fixed::WeightVector| -> f64 { net.weights().iter().map(|&weight| f64::from(weight).sin()).sum() };
        let rewards: Vec<f64> = nets.iter().map(reward).collect();
        let evaluations: Vec<_> = rewards.iter().map(|&reward| Evaluation::new(reward)).collect();
        strategy.tell(&evaluations, seed);
        let mut order: Vec<usize> = (0..8).collect();
        order.sort_by(|&one, &other| {
            let better = |k: usize| rewards[1 + 2 * k].max(rewards[2 + 2 * k]);
            better(other).total_cmp(&better(one))
        });
        let used: Vec<f64> = order[..top].iter().flat_map(|&k| [rewards[1 + 2 * k], rewards[2 + 2 * k]]).collect();
        let mean = used.iter().sum::<f64>() / used.len() as f64;
        let sigma = (used.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / used.len() as f64).sqrt();
        let moved = strategy.ask(seed.generation(2))[0].weights().to_vec();
        for (gene, &moved) in moved.iter().enumerate() {
            let weight = |place: usize| f64::from(nets[place].weights()[gene]);
            let sum: f64 = order[..top]
                .iter()
                .map(|&k| (rewards[1 + 2 * k] - rewards[2 + 2 * k]) * (weight(1 + 2 * k) - weight(0)) / noise)
                .sum();
            let expected = weight(0) + step_size / (top as f64 * sigma) * sum;
            prop_assert!((f64::from(moved) - expected).abs() < 1e-3 * (1.0 + expected.abs()), "{moved} {expected}");
        }
    }
}

#[test]
fn a_child_as_good_as_its_parent_takes_its_place() {
    let mut strategy = climber(HillClimbingSettings::default());
    generation(&mut strategy, 1);
    let parent = strategy.parent().expect("there is one").clone();
    generation_of(&mut strategy, 2, &Evaluation::new(3.0));
    assert_ne!(strategy.parent(), Some(&parent));
    assert_eq!(strategy.statistics()[0].value, 1.0);
}

#[test]
fn without_differences_the_centre_rests() {
    for result in [Evaluation::new(3.0), Evaluation::failed(Failure::Other { what: "test".into() })] {
        let mut strategy = ars(ArsSettings::default());
        let first = strategy.ask(Seed::of_run(1).generation(1))[0].clone();
        (1..4).for_each(|number| generation_of(&mut strategy, number, &result));
        assert_eq!(strategy.ask(Seed::of_run(1).generation(4))[0], first);
    }
}

#[test]
fn they_go_on_where_they_were_in_grown_nets() {
    let same = TopologyMap::none(26);
    let mut hill = climber(HillClimbingSettings::default());
    let mut random = ars(ArsSettings::default());
    (1..5).for_each(|number| {
        generation(&mut hill, number);
        generation(&mut random, number);
    });
    let seed = Seed::of_run(1).generation(5);
    let next = hill.clone().remapped(coarse(), dense(), &same).expect("goes on").ask(seed)[0].clone();
    assert_eq!(next, hill.ask(seed)[0]);
    let next = random.clone().remapped(v1(), dense(), &same).expect("goes on").ask(seed)[0].clone();
    assert_eq!(next, random.ask(seed)[0]);
    let champion = vec![0.25; 26];
    let mut begun = climber(coarse()).with_start(std::slice::from_ref(&champion)).expect("weights");
    assert_eq!(begun.ask(seed)[0].weights(), champion);
    let mut begun = ars(v1()).with_start(std::slice::from_ref(&champion)).expect("weights");
    assert_eq!(begun.ask(seed)[0].weights(), champion);
    assert!(climber(coarse()).with_start(&[vec![1.0]]).expect_err("too few").to_string().starts_with("start[0] = "));
    assert!(ars(v1()).with_start(&[vec![1.0]]).is_err());
}

#[test]
fn climbers_climb_a_sphere_and_random_search_does_not() {
    let distance = |x: &[f64]| x.iter().map(|x| (x - 0.5).powi(2)).sum();
    for run in 1..=3 {
        let hill = HillClimbing::new(HillClimbingSettings::default(), weights(20)).expect("valid");
        assert!(evaluations_to(hill, run, distance, 0.2, 5_000).is_some(), "hill climbing, run {run}");
        let settings = ArsSettings { step_size: 0.1, ..Default::default() };
        let ars = Ars::new(settings, weights(20)).expect("valid");
        assert!(evaluations_to(ars, run, distance, 0.2, 20_000).is_some(), "ars, run {run}");
        let random = RandomSearch::new(RandomSearchSettings::default(), weights(20)).expect("valid");
        assert_eq!(evaluations_to(random, run, distance, 0.2, 5_000), None);
    }
}
