//! What NSGA-II promises.

use crate::common::{assert_damages_are_found, assert_resumes, dense, digest, generation, recurrent, weights};
use ne_core::{
    Evaluation, Failure, Fitness, Seed, Strategy,
    conformance::{StrategyOptions, check_strategy},
    pareto::{self, Point},
};
use ne_fixed::{
    CrossoverChoice, GaussianMutation, Initialization, MutationChoice, Nsga2, Nsga2Settings, OnePoint,
    SelfAdaptiveMutation, WeightVector,
};
use serde_json::json;

fn new(settings: Nsga2Settings) -> Nsga2 {
    Nsga2::new(settings, dense()).expect("valid settings")
}

/// As the paper has it: parents are not evaluated again. An odd population, and deviations that evolve.
fn as_in_the_paper() -> Nsga2Settings {
    Nsga2Settings {
        population: 21,
        parents_again: false,
        crossover_rate: 0.9,
        crossover: CrossoverChoice::OnePoint(OnePoint {}),
        mutation: MutationChoice::SelfAdaptive(SelfAdaptiveMutation::default()),
        ..Default::default()
    }
}

/// The problem ZDT1, negated, since objectives are maximised here; weights are cut to its range from 0 to 1. Every
/// eleventh evaluation fails. On the true front the second is √(the first cost) − 1.
///
/// Source: Zitzler, Deb & Thiele, *Comparison of Multiobjective Evolutionary Algorithms: Empirical Results*,
/// Evolutionary Computation 8(2), 2000.
fn zdt1(population: &[WeightVector]) -> Vec<Evaluation> {
    let evaluate = |(index, genome): (usize, &WeightVector)| {
        if index % 11 == 10 {
            return Evaluation::failed(Failure::Unstable { what: "speed".into() });
        }
        let x: Vec<f64> = genome.weights().iter().map(|&weight| f64::from(weight).clamp(0.0, 1.0)).collect();
        let g = 1.0 + 9.0 * x[1..].iter().sum::<f64>() / (x.len() - 1) as f64;
        let costs = [x[0], g * (1.0 - (x[0] / g).sqrt())];
        Evaluation { objectives: costs.map(|cost| -cost).to_vec(), ..Evaluation::new(-costs[0] - costs[1]) }
    };
    population.iter().enumerate().map(evaluate).collect()
}

/// ZDT1 with ten weights, so many generations long.
fn searched(settings: Nsga2Settings, run: u64, generations: u64) -> Nsga2 {
    let mut strategy = Nsga2::new(settings, weights(10)).expect("valid");
    for number in 1..=generations {
        let seed = Seed::of_run(run).generation(number);
        let evaluations = zdt1(strategy.ask(seed));
        strategy.tell(&evaluations, seed);
    }
    strategy
}

fn statistic(strategy: &Nsga2, name: &str) -> f64 {
    let found = strategy.statistics().into_iter().find(|statistic| statistic.name == name);
    found.expect("it is told").value
}

#[test]
fn keeps_the_promises_of_a_strategy() {
    for settings in [Nsga2Settings::default(), as_in_the_paper()] {
        check_strategy(|| new(settings.clone()), &StrategyOptions::default()).expect("keeps its promises");
        let recurrent = || Nsga2::new(settings.clone(), recurrent()).expect("valid");
        check_strategy(recurrent, &StrategyOptions::default()).expect("keeps its promises on a graph");
    }
}

#[test]
fn goes_on_to_the_bit_after_a_save() {
    assert_resumes(new(Nsga2Settings::default()), 5);
    assert_resumes(new(as_in_the_paper()), 5);
    for settings in [Nsga2Settings::default(), as_in_the_paper()] {
        let strategy = searched(settings, 1, 7);
        let reloaded = crate::common::reload(&strategy);
        assert_eq!(reloaded.front(), strategy.front());
        assert_eq!(reloaded.statistics(), strategy.statistics());
    }
}

/// Golden: another digest changes every recorded run.
#[test]
fn runs_are_the_same_for_ever() {
    let digests = [digest(new(Nsga2Settings::default()), 20), digest(new(as_in_the_paper()), 20)];
    assert_eq!(digests, ["9858a3adb1634c04", "eba00f5963c5cc8d"]);
}

#[test]
fn approaches_the_whole_front_of_zdt1() {
    for settings in [Nsga2Settings::default(), Nsga2Settings { parents_again: false, ..Default::default() }] {
        for run in 1..=3 {
            let strategy = searched(settings.clone(), run, 250);
            let front = strategy.front().expect("it keeps one");
            assert!(front.len() >= 30, "run {run}: {} points", front.len());
            for point in &front {
                let [first, second] = [0, 1].map(|objective| -point.objectives[objective].get());
                assert!(second - (1.0 - first.sqrt()) < 0.1, "run {run}: ({first}, {second})");
            }
            let points: Vec<Point<'_>> = front.iter().map(|point| Some(point.objectives)).collect();
            let reference = [-1.0, -1.0].map(|value| Fitness::new(value).expect("finite"));
            // Of the true front it is 2/3.
            let area = pareto::hypervolume(&points, &reference);
            assert!(area > 0.63, "run {run}: {area}");
        }
    }
}

#[test]
fn the_front_is_in_order_and_no_point_in_it_is_dominated() {
    for settings in [Nsga2Settings::default(), as_in_the_paper()] {
        for generations in [1, 2, 10] {
            let strategy = searched(settings.clone(), 1, generations);
            let front = strategy.front().expect("it keeps one");
            assert_eq!(front.len() as f64, statistic(&strategy, "front_size"));
            assert!(front.windows(2).all(|pair| pair[0].objectives[0] > pair[1].objectives[0]));
            assert!(front.windows(2).all(|pair| pair[0].objectives[1] < pair[1].objectives[1]));
            for point in &front {
                let [evaluation] = &zdt1(std::slice::from_ref(point.genome))[..] else { panic!("one for one") };
                assert_eq!(evaluation.fitness(), Some(point.fitness));
                assert_eq!(evaluation.objectives().as_deref(), Some(point.objectives));
                assert!((1..=generations).contains(&point.generation));
                assert!(point.generation == generations || !settings.parents_again);
            }
        }
    }
}

/// The elitism of the paper: nothing that was found is lost while it is not beaten.
#[test]
fn the_area_of_the_front_never_shrinks_where_parents_keep_their_scores() {
    let mut strategy = Nsga2::new(as_in_the_paper(), weights(10)).expect("valid");
    let (mut areas, mut sizes) = (Vec::new(), Vec::new());
    for number in 1..=60 {
        let seed = Seed::of_run(1).generation(number);
        let evaluations = zdt1(strategy.ask(seed));
        strategy.tell(&evaluations, seed);
        areas.push(statistic(&strategy, "hypervolume"));
        sizes.push(statistic(&strategy, "front_size"));
    }
    // Once the front is larger than the population, those with the least room have to go, and their corners with them.
    let grown = sizes.iter().position(|&size| size >= 21.0).unwrap_or(areas.len());
    assert!(grown > 5, "the front filled the population in generation {grown}");
    assert!(areas[..grown].is_sorted(), "{areas:?}");
    assert!(areas[59] > areas[0]);
}

#[test]
fn parents_are_asked_first_and_again_only_if_they_are_to_be() {
    for (settings, kept) in [(Nsga2Settings::default(), 50), (as_in_the_paper(), 0)] {
        let mut strategy = new(settings);
        generation(&mut strategy, 1);
        let front: Vec<WeightVector> =
            strategy.front().expect("it keeps one").iter().map(|point| point.genome.clone()).collect();
        let asked = strategy.ask(Seed::of_run(1).generation(2));
        assert_eq!(front.iter().all(|genome| asked[..kept].contains(genome)), kept > 0);
    }
}

#[test]
fn without_objectives_the_fitness_is_the_only_one() {
    let mut strategy = new(Nsga2Settings::default());
    let mut best = Vec::new();
    for number in 1..=40 {
        generation(&mut strategy, number);
        let front = strategy.front().expect("it keeps one");
        assert_eq!(front.len(), 1);
        assert_eq!(front[0].objectives, [front[0].fitness]);
        best.push(front[0].fitness);
    }
    // Parents are asked first, so that the seventh may fail; the best is the first of them.
    assert!(best.is_sorted(), "{best:?}");
    assert!(best[39].get() > 0.5 * best[0].get(), "{best:?}");
    assert_eq!(statistic(&strategy, "hypervolume"), 0.0);
}

#[test]
fn where_all_fail_the_front_is_empty_and_the_search_goes_on() {
    let mut strategy = new(Nsga2Settings::default());
    let failed = Evaluation::failed(Failure::Unstable { what: "speed".into() });
    crate::common::generation_of(&mut strategy, 1, &failed);
    assert_eq!(strategy.front().map(|front| front.len()), Some(0));
    let nonsense = Evaluation { objectives: vec![1.0, f64::NAN], ..Evaluation::new(1.0) };
    crate::common::generation_of(&mut strategy, 2, &nonsense);
    assert_eq!(strategy.front().map(|front| front.len()), Some(0));
    generation(&mut strategy, 3);
    assert_eq!(strategy.front().map(|front| front.len()), Some(1));
}

#[test]
fn errors_of_settings_name_the_field() {
    type Change = fn(&mut Nsga2Settings);
    let changes: [(Change, &str); 6] = [
        (|s| s.population = 3, "population = 3: must be from 4 to 10000"),
        (|s| s.population = 10_001, "population = 10001: must be from 4 to 10000"),
        (|s| s.crossover_rate = f64::NAN, "crossover_rate = NaN: must be from 0 to 1"),
        (
            |s| s.selection = ne_core::Selection::Tournament(ne_core::Tournament { size: 0 }),
            "selection.tournament.size = 0: must be from 1 to 1000",
        ),
        (
            |s| s.mutation = MutationChoice::Gaussian(GaussianMutation { rate: 2.0, deviation: 0.1 }),
            "mutation.gaussian.rate = 2: must be from 0 to 1",
        ),
        (
            |s| s.initialization = Initialization::Uniform { limit: -1.0 },
            "initialization.uniform.limit = -1: must be from 0 to 1000",
        ),
    ];
    for (change, message) in changes {
        let mut settings = Nsga2Settings::default();
        change(&mut settings);
        assert_eq!(Nsga2::new(settings, dense()).expect_err("out of range").to_string(), message);
    }
}

#[test]
fn damaged_states_are_errors_that_name_the_field() {
    let mut strategy = new(Nsga2Settings::default());
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["settings"]["population"] = 1.into(), "population = 1: must be from 4 to 10000"),
            (|s| s["settings"]["population"] = 52.into(), "parents: found 50 individuals, the settings say 26"),
            (|s| s["topology"]["dense"]["inputs"] = 0.into(), "inputs = 0: must be from 1 to 4096"),
            (
                |s| s["parents"][3]["genes"]["weights"] = json!([0.0]),
                "parents[3].weights: found 1, a net of shape 3-4-2 has 26",
            ),
            (
                |s| s["parents"][3]["scores"]["objectives"] = json!([0.0, 1.0]),
                "parents[3].scores.objectives = 2 numbers: must be 1 numbers, as the reference has",
            ),
            (|s| s["reference"] = json!(null), "reference = null: must be given if a parent has scores"),
            (|s| s["asked"] = json!([{ "mutation_deviation": 0.0, "weights": [1.0] }]), "asked: found 1 individuals"),
        ],
    );
}
