//! What CoSyNE promises.

use crate::common::{
    assert_damages_are_found, assert_resumes, dense, digest, evaluations_to, generation, generation_of, recurrent,
    reload, score, weights,
};
use ne_core::{
    Evaluation, Seed, Strategy,
    conformance::{StrategyOptions, check_strategy},
};
use ne_fixed::{Cosyne, CosyneSettings, CrossoverChoice, Initialization, Permutation, UniformCrossover, WeightVector};
use proptest::prelude::*;
use serde_json::json;

fn new(settings: CosyneSettings) -> Cosyne {
    Cosyne::new(settings, dense()).expect("valid settings")
}

fn permuting_all() -> CosyneSettings {
    CosyneSettings {
        population: 21,
        parents: 0.5,
        offspring: 0.3,
        crossover: CrossoverChoice::Uniform(UniformCrossover {}),
        mutation_rate: 0.5,
        permutation: Permutation::All,
        ..Default::default()
    }
}

/// The genes of one subpopulation, in ascending order.
fn subpopulation(nets: &[WeightVector], gene: usize) -> Vec<f32> {
    let mut members: Vec<f32> = nets.iter().map(|net| net.weights()[gene]).collect();
    members.sort_unstable_by(f32::total_cmp);
    members
}

#[test]
fn keeps_the_promises_of_a_strategy() {
    for settings in [CosyneSettings::default(), CosyneSettings::pole_balancing(), permuting_all()] {
        check_strategy(|| new(settings.clone()), &StrategyOptions::default()).expect("keeps its promises");
        let recurrent = || Cosyne::new(settings.clone(), recurrent()).expect("valid");
        check_strategy(recurrent, &StrategyOptions::default()).expect("keeps its promises on a graph");
    }
}

#[test]
fn goes_on_to_the_bit_after_a_save() {
    assert_resumes(new(CosyneSettings::default()), 5);
    assert_resumes(new(permuting_all()), 5);
    assert_resumes(new(CosyneSettings { restart: Some(1), ..permuting_all() }), 12);
}

#[test]
fn a_search_without_progress_begins_anew() {
    let settings = CosyneSettings { restart: Some(3), ..CosyneSettings::default() };
    let mut strategy = new(settings.clone());
    (1..=4).for_each(|number| generation_of(&mut strategy, number, &Evaluation::new(1.0)));
    assert!(!strategy.has_begun_anew());
    let seed = Seed::of_run(1).generation(5);
    assert_eq!(reload(&strategy).ask(seed), new(settings.clone()).ask(seed), "drawn as a first generation is");
    generation_of(&mut strategy, 5, &Evaluation::new(0.5));
    assert!(reload(&strategy).has_begun_anew());
    let next = Seed::of_run(1).generation(6);
    assert_ne!(strategy.ask(next), new(settings).ask(next), "and goes on from it");
}

/// Golden: another digest changes every recorded run.
#[test]
fn runs_are_the_same_for_ever() {
    let graph = Cosyne::new(CosyneSettings::default(), recurrent()).expect("valid");
    let digests = [digest(new(CosyneSettings::default()), 20), digest(new(permuting_all()), 20), digest(graph, 20)];
    assert_eq!(digests, ["45f1cf295c2c02d8", "ee65ae040afd00b2", "ffab3611a942b5b0"]);
}

#[test]
fn errors_of_settings_name_the_field() {
    type Change = fn(&mut CosyneSettings);
    let changes: [(Change, &str); 9] = [
        (|s| s.population = 1, "population = 1: must be from 2 to 1000000"),
        (|s| s.parents = 0.0, "parents = 0: must be above 0 and at most 1"),
        (|s| s.parents = 1.1, "parents = 1.1: must be above 0 and at most 1"),
        (|s| s.offspring = 1.0, "offspring = 1: must be from 0 to below 1"),
        (|s| s.offspring = f64::NAN, "offspring = NaN: must be from 0 to below 1"),
        (|s| s.mutation_rate = 2.0, "mutation_rate = 2: must be from 0 to 1"),
        (|s| s.mutation_scale = -1.0, "mutation_scale = -1: must be from 0 to 1000"),
        (
            |s| s.initialization = Initialization::Uniform { limit: -1.0 },
            "initialization.uniform.limit = -1: must be from 0 to 1000",
        ),
        (|s| s.restart = Some(0), "restart = 0: must be at least 1"),
    ];
    for (change, message) in changes {
        let mut settings = CosyneSettings::default();
        change(&mut settings);
        assert_eq!(Cosyne::new(settings, dense()).expect_err("out of range").to_string(), message);
    }
}

#[test]
fn damaged_states_are_errors_that_name_the_field() {
    let mut strategy = new(CosyneSettings::default());
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["settings"]["population"] = 1.into(), "population = 1: must be from 2 to 1000000"),
            (|s| s["settings"]["population"] = 51.into(), "parents: found 50 individuals, the settings say 51"),
            (|s| s["topology"]["dense"]["inputs"] = 0.into(), "inputs = 0: must be from 1 to 4096"),
            (|s| s["parents"][3]["weights"] = json!([0.0]), "parents[3].weights: found 1, a net of shape 3-4-2 has 26"),
            (|s| s["parents"][3]["weights"][5] = json!(1e39), "parents[3].weights[5] = inf: must be finite"),
            (|s| s["asked"] = json!([[1.0]]), "asked: found 1 individuals, the settings say 50"),
            (|s| s["asked"] = json!(vec![[1.0]; 50]), "asked[0].weights: found 1, a net of shape 3-4-2 has 26"),
        ],
    );
}

proptest! {
    #[test]
    fn subpopulations_keep_their_members_without_offspring(population in 2..40usize, all: bool, generations in 1..5u64) {
        let permutation = if all { Permutation::All } else { Permutation::ByFitness };
        let mut strategy = new(CosyneSettings { population, offspring: 0.0, permutation, ..Default::default() });
        let first = generation(&mut strategy, 1);
        for number in 2..2 + generations {
            let nets = generation(&mut strategy, number);
            (0..26).for_each(|gene| assert_eq!(subpopulation(&nets, gene), subpopulation(&first, gene)));
        }
    }
}

/// The nets that children replace are marked most, and are not there any more.
#[test]
fn the_share_of_marked_weights_is_that_of_the_nets_that_are_kept() {
    let mut strategy = new(CosyneSettings { population: 40, offspring: 0.75, ..Default::default() });
    let seed = Seed::of_run(1).generation(1);
    strategy.ask(seed);
    // The best are never marked.
    let evaluations: Vec<Evaluation> =
        (0..40).map(|index| Evaluation::new(f64::from(u8::from(index % 4 == 0)))).collect();
    strategy.tell(&evaluations, seed);
    let statistics = strategy.statistics();
    let marked = statistics.iter().find(|statistic| statistic.name == "marked_share").expect("it is told");
    assert_eq!(marked.value, 0.0);
}

#[test]
fn the_best_net_stays_whole_and_children_replace_the_worst() {
    let mut strategy = new(CosyneSettings { population: 40, offspring: 0.25, ..Default::default() });
    for number in 1..10 {
        let parents = generation(&mut strategy, number);
        let scores: Vec<_> = score(&parents).iter().map(Evaluation::fitness).collect();
        let mut order: Vec<usize> = (0..40).collect();
        order.sort_by_key(|&index| (std::cmp::Reverse(scores[index]), index));
        let children = strategy.ask(Seed::of_run(1).generation(number + 1));
        assert_eq!(children[0], parents[order[0]]);
        let kept: Vec<WeightVector> = order[..30].iter().map(|&index| parents[index].clone()).collect();
        (0..26).for_each(|gene| assert_eq!(subpopulation(&children[..30], gene), subpopulation(&kept, gene)));
    }
}

#[test]
fn with_all_permuted_no_net_stays_whole() {
    let mut strategy = new(permuting_all());
    let parents = generation(&mut strategy, 1);
    let children = strategy.ask(Seed::of_run(1).generation(2));
    assert!(children.iter().all(|child| !parents.contains(child)));
}

#[test]
fn solves_a_sphere() {
    for permutation in [Permutation::All, Permutation::ByFitness] {
        let settings = CosyneSettings { permutation, ..Default::default() };
        for run in 1..=5 {
            let strategy = Cosyne::new(settings.clone(), weights(10)).expect("valid");
            let distance = |x: &[f64]| x.iter().map(|x| (x - 0.5).powi(2)).sum();
            let evaluations = evaluations_to(strategy, run, distance, 0.05, 20_000);
            assert!(evaluations.is_some(), "run {run}, {permutation:?}");
        }
    }
}
