//! What CMA-ES promises.

use crate::common::{
    assert_damages_are_found, assert_resumes, dense, digest, generation, generation_of, recurrent, weights,
};
use ne_core::{
    Evaluation, Failure, Seed, Strategy,
    conformance::{StrategyOptions, check_strategy},
};
use ne_fixed::{CmaEs, CmaEsSettings, CovarianceModel, Initialization, Restart};
use ne_net::TopologyMap;
use serde_json::json;

fn new(settings: CmaEsSettings) -> CmaEs {
    CmaEs::new(settings, dense()).expect("valid settings")
}

fn full() -> CmaEsSettings {
    CmaEsSettings { covariance: CovarianceModel::Full, ..Default::default() }
}

/// Searches that end after a few generations, since the deviation may not fall.
fn restarting(restart: Restart) -> CmaEsSettings {
    let initial_mean = Initialization::Uniform { limit: 1.0 };
    CmaEsSettings { population: Some(6), least_deviation: 0.45, restart, initial_mean, ..full() }
}

fn statistic(strategy: &CmaEs, name: &str) -> f64 {
    let statistics = strategy.statistics();
    statistics.iter().find(|statistic| statistic.name == name).expect("a statistic of this name").value
}

#[test]
fn keeps_the_promises_of_a_strategy() {
    let plain = StrategyOptions { generations: 12, ..Default::default() };
    for settings in [CmaEsSettings::default(), full()] {
        check_strategy(|| new(settings.clone()), &plain).expect("keeps its promises");
        let recurrent = || CmaEs::new(settings.clone(), recurrent()).expect("valid");
        check_strategy(recurrent, &plain).expect("keeps its promises on a graph");
    }
    let varying = StrategyOptions { generations: 40, size_varies: true, ..plain };
    for settings in [
        restarting(Restart::Ipop),
        restarting(Restart::Bipop),
        restarting(Restart::Returning),
        CmaEsSettings { starts: 3, start_generations: 4, ..restarting(Restart::Returning) },
        CmaEsSettings::pole_balancing(),
    ] {
        check_strategy(|| new(settings.clone()), &varying).expect("keeps its promises with restarts");
    }
}

#[test]
fn goes_on_to_the_bit_after_a_save() {
    assert_resumes(new(CmaEsSettings::default()), 8);
    assert_resumes(new(full()), 8);
    assert_resumes(new(CmaEsSettings::default()).with_start(&[vec![0.5; 26]]).expect("26 weights"), 3);
    let guessing = || new(CmaEsSettings::default()).with_guess(&[0.5; 26]).expect("26 weights");
    assert_resumes(guessing(), 3);
    // Before its first generation as well.
    let saved = serde_json::to_string(&guessing()).expect("it can be saved");
    let mut again: CmaEs = serde_json::from_str(&saved).expect("it can be read");
    let asked = |search: &mut CmaEs| search.ask(Seed::of_run(1)).to_vec();
    assert_eq!(asked(&mut again), asked(&mut guessing()));
    assert_resumes(new(restarting(Restart::Bipop)), 40);
    assert_resumes(new(CmaEsSettings { starts: 3, start_generations: 4, ..restarting(Restart::Returning) }), 60);
}

/// Golden: another digest changes every recorded run.
#[test]
fn runs_are_the_same_for_ever() {
    let digests = [
        digest(new(CmaEsSettings::default()), 20),
        digest(new(full()), 20),
        digest(new(restarting(Restart::Ipop)), 30),
        digest(new(restarting(Restart::Bipop)), 60),
        digest(new(CmaEsSettings { starts: 3, start_generations: 4, ..restarting(Restart::Returning) }), 60),
        digest(CmaEs::new(full(), recurrent()).expect("valid"), 20),
    ];
    assert_eq!(
        digests,
        [
            "1c8bccefe73f6211",
            "f4492fda2a66342e",
            "1c670bf21c98d74d",
            "2da1a24f6c673cfd",
            "ac848d177aedbbad",
            "4e82c75fb8364075"
        ]
    );
}

#[test]
fn errors_of_settings_name_the_field() {
    type Change = fn(&mut CmaEsSettings);
    let changes: [(Change, &str); 13] = [
        (|s| s.greatest_growth = 0.9, "greatest_growth = 0.9: must be from 1 to 10000"),
        (|s| s.greatest_growth = f64::INFINITY, "greatest_growth = inf: must be from 1 to 10000"),
        (|s| s.mean_decay = -0.1, "mean_decay = -0.1: must be from 0 to 0.5"),
        (|s| s.mean_decay = f64::NAN, "mean_decay = NaN: must be from 0 to 0.5"),
        (|s| s.population = Some(1), "population = 1: must be from 2 to 1000000"),
        (|s| s.population = Some(1_000_001), "population = 1000001: must be from 2 to 1000000"),
        (|s| s.step_size = 0.0, "step_size = 0: must be from 0.000001 to 1000"),
        (|s| s.step_size = f64::NAN, "step_size = NaN: must be from 0.000001 to 1000"),
        (|s| s.least_deviation = 0.6, "least_deviation = 0.6: must be from 0.000000001 to 0.5"),
        (|s| s.starts = 0, "starts = 0: must be from 1 to 1000"),
        (|s| s.start_generations = 0, "start_generations = 0: must be from 1 to 1000000"),
        (|s| s.least_deviation = 0.0, "least_deviation = 0: must be from 0.000000001 to 0.5"),
        (
            |s| s.initial_mean = Initialization::Uniform { limit: -1.0 },
            "initial_mean.uniform.limit = -1: must be from 0 to 1000",
        ),
    ];
    for (change, message) in changes {
        let mut settings = CmaEsSettings::default();
        change(&mut settings);
        let error = CmaEs::new(settings, dense()).expect_err("out of range");
        assert_eq!(error.to_string(), message);
    }
    let flat = ne_net::DenseShape::new(3, vec![0], 2);
    let error = CmaEs::new(CmaEsSettings::default(), flat).expect_err("no neuron").to_string();
    assert_eq!(error, "topology.hidden[0] = 0: must be from 1 to 4096");
    let wide = ne_net::DenseShape::new(3, vec![4096, 4000], 2);
    let error = CmaEs::new(CmaEsSettings::default(), wide).expect_err("3 GiB of weights").to_string();
    assert_eq!(error, "population = 53: must be at most 16 for nets of 16412386 weights");
    let error = new(CmaEsSettings::default()).with_start(&[vec![0.0; 3]]).expect_err("three weights").to_string();
    assert_eq!(error, "start[0] = weights: found 3, a net of shape 3-4-2 has 26: must be weights of the net");
}

#[test]
fn a_file_may_leave_settings_out() {
    let settings: CmaEsSettings =
        serde_json::from_value(json!({"covariance": "full", "restart": "bipop"})).expect("settings");
    assert_eq!(settings, CmaEsSettings { restart: Restart::Bipop, ..full() });
    let error = serde_json::from_value::<CmaEsSettings>(json!({"sigma": 1})).expect_err("unknown").to_string();
    assert!(error.contains("unknown field `sigma`"), "{error}");
}

#[test]
fn damaged_states_are_errors_that_name_the_field() {
    let mut strategy = new(full());
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["settings"]["step_size"] = 0.into(), "step_size = 0: must be from 0.000001 to 1000"),
            (|s| s["topology"]["dense"]["hidden"][0] = 0.into(), "hidden[0] = 0: must be from 1 to 4096"),
            (|s| s["start"] = json!([1.0]), "start[0] = weights: found 1, a net of shape 3-4-2 has 26"),
            (|s| s["restarts"]["population"] = 1.into(), "restarts.population = 1: must be from 2 to 1000000"),
            (
                |s| s["restarts"]["large_population"] = 0.into(),
                "restarts.large_population = 0: must be from 2 to 1000000",
            ),
            (|s| s["restarts"]["step_size"] = 0.into(), "restarts.step_size = 0: must be "),
            (|s| s["distribution"]["mean"] = json!([1.0]), "distribution.mean = 1 numbers: must be 26 numbers"),
            (|s| s["distribution"]["step_size"] = json!(-1.0), "distribution.step_size = -1: must be "),
            (|s| s["distribution"]["step_size_path"] = json!([]), "distribution.step_size_path = 0 numbers"),
            (|s| s["distribution"]["covariance_path"] = json!([]), "distribution.covariance_path = 0 numbers"),
            (
                |s| s["distribution"]["covariance"] = json!([]),
                "distribution.covariance = 0 numbers: must be 351 numbers",
            ),
            (
                |s| s["distribution"]["covariance"][0] = json!(-1.0),
                "distribution.covariance = a degenerate matrix: must be positive definite",
            ),
            (|s| s["asked"] = json!([[1.0]]), "asked: found 1 individuals, the settings say 13"),
            (|s| s["asked"] = json!(vec![[1.0]; 13]), "asked[0].weights: found 1, a net of shape 3-4-2 has 26"),
            (
                |s| {
                    s["asked"] = json!(vec![[0.0; 26]; 13]);
                    s["distribution"] = json!(null);
                },
                "distribution = none: must be there when individuals were asked",
            ),
        ],
    );
    let mut strategy = new(CmaEsSettings::default());
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["distribution"]["covariance"] = json!([1.0]), "distribution.covariance = 1 numbers: must be 26"),
            (
                |s| s["distribution"]["covariance"][7] = json!(0.0),
                "distribution.covariance = a degenerate matrix: must be positive definite",
            ),
        ],
    );
}

#[test]
fn damage_to_the_search_that_is_kept_is_found() {
    let mut strategy = new(CmaEsSettings { starts: 2, start_generations: 1, ..full() });
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["kept"]["population"] = 1.into(), "kept.population = 1: must be from 2 to 1000000"),
            (
                |s| s["kept"]["distribution"]["mean"] = json!([1.0]),
                "kept.distribution.mean = 1 numbers: must be 26 numbers",
            ),
        ],
    );
}

#[test]
fn the_population_follows_the_number_of_weights() {
    for (count, expected) in [(2, 6), (10, 10), (188, 19), (1000, 24)] {
        let mut strategy = CmaEs::new(CmaEsSettings::default(), weights(count)).expect("valid");
        assert_eq!(strategy.ask(Seed::of_run(1)).len(), expected, "{count} weights");
    }
}

#[test]
fn begins_where_it_is_told() {
    let settings = CmaEsSettings { step_size: 1e-3, ..Default::default() };
    let mut strategy = new(settings.clone()).with_start(&[vec![2.5; 26]]).expect("26 weights");
    assert_eq!((strategy.mean(), strategy.recommendation()), (None, None));
    let first = strategy.ask(Seed::of_run(1)).to_vec();
    assert_eq!(strategy.recommendation().expect("asked").weights(), [2.5; 26], "the mean");
    assert!(first.iter().flat_map(|genome| genome.weights()).all(|weight| (weight - 2.5).abs() < 0.01));
    let mut strategy = new(CmaEsSettings { initial_mean: Initialization::Uniform { limit: 1.0 }, ..settings });
    strategy.ask(Seed::of_run(1));
    let mean = strategy.mean().expect("asked");
    assert!(mean.iter().all(|weight| weight.abs() <= 1.0) && mean.iter().any(|weight| weight.abs() > 0.9));
}

#[test]
fn a_generation_of_failures_teaches_nothing() {
    let mut strategy = new(CmaEsSettings::default());
    generation(&mut strategy, 1);
    let before = (strategy.mean().expect("asked").to_vec(), statistic(&strategy, "step_size"));
    generation_of(&mut strategy, 2, &Evaluation::failed(Failure::Other { what: "test".into() }));
    assert_eq!((strategy.mean().expect("asked").to_vec(), statistic(&strategy, "step_size")), before);
    assert_eq!(statistic(&strategy, "evaluations_since_restart"), 26.0);
}

/// A place where every body explodes is left as well as one where none gets better.
#[test]
fn a_search_of_failures_alone_begins_anew() {
    let failed = Evaluation::failed(Failure::Other { what: "test".into() });
    let after = |restart, good: u64, generations: u64| {
        let mut strategy = new(CmaEsSettings { population: Some(6), restart, ..Default::default() });
        for number in 1..=good {
            generation(&mut strategy, number);
        }
        (good + 1..=good + generations).for_each(|number| {
            strategy = crate::common::reload(&strategy);
            generation_of(&mut strategy, number, &failed);
        });
        statistic(&strategy, "restarts")
    };
    // 10 + 30 · 26 / 6.
    for restart in [Restart::Ipop, Restart::Bipop, Restart::Returning, Restart::Anew] {
        assert_eq!([after(restart, 0, 139), after(restart, 3, 139), after(restart, 0, 140)], [0.0, 0.0, 1.0]);
    }
    assert_eq!(after(Restart::None, 0, 200), 0.0);
    let mut strategy = new(CmaEsSettings { population: Some(6), restart: Restart::Ipop, ..Default::default() });
    for number in 1..=200 {
        if number % 100 == 0 {
            generation(&mut strategy, number);
        } else {
            generation_of(&mut strategy, number, &failed);
        }
    }
    assert_eq!(statistic(&strategy, "restarts"), 0.0, "not in a row");
}

#[test]
fn the_step_grows_on_a_plain_and_is_bounded() {
    let mut strategy = new(CmaEsSettings::default());
    for number in 1..=200 {
        generation_of(&mut strategy, number, &Evaluation::new(1.0));
    }
    assert!((statistic(&strategy, "greatest_deviation") - 5000.0).abs() < 1e-6);
}

#[test]
fn the_deviation_stays_above_its_least() {
    let mut strategy = new(CmaEsSettings { least_deviation: 0.1, ..Default::default() });
    for number in 1..=400 {
        generation(&mut strategy, number);
        assert!(statistic(&strategy, "greatest_deviation") > 0.1 - 1e-9);
    }
    assert!(statistic(&strategy, "greatest_deviation") < 0.11);
}

#[test]
fn deviations_grow_no_further_than_is_said_whatever_restarts() {
    for restart in [Restart::None, Restart::Ipop, Restart::Returning] {
        let settings = CmaEsSettings { step_size: 0.35, greatest_growth: 2.0, restart, ..CmaEsSettings::default() };
        let mut strategy = new(settings);
        let mut reached = false;
        for number in 1..=300 {
            generation_of(&mut strategy, number, &Evaluation::new(1.0));
            let deviation = statistic(&strategy, "greatest_deviation");
            assert!(deviation < 0.7 + 1e-9, "{restart:?}: {deviation} in generation {number}");
            reached |= deviation > 0.7 - 1e-9;
        }
        assert!(reached, "{restart:?}");
    }
}

#[test]
fn weights_that_do_not_matter_decay() {
    let farthest = |mean_decay: f64| {
        let initial_mean = Initialization::Uniform { limit: 50.0 };
        let settings = CmaEsSettings { mean_decay, initial_mean, greatest_growth: 1.0, ..Default::default() };
        let mut strategy = new(settings);
        for number in 1..=300 {
            generation_of(&mut strategy, number, &Evaluation::new(1.0));
        }
        let mean = strategy.recommendation().expect("a mean");
        mean.weights().iter().map(|weight| weight.abs()).fold(0.0, f32::max)
    };
    assert!(farthest(0.0) > 20.0);
    // 50 × 0.98³⁰⁰ is 0.1; the rest is chance.
    assert!(farthest(0.02) < 5.0, "{}", farthest(0.02));
}

#[test]
fn populations_of_restarts_double_or_alternate() {
    let populations = |restart, searches| {
        let mut strategy = new(restarting(restart));
        let mut populations = vec![6.0];
        for number in 1.. {
            generation(&mut strategy, number);
            if statistic(&strategy, "restarts") as usize == populations.len() {
                populations.push(statistic(&strategy, "population"));
            }
            if populations.len() == searches {
                break;
            }
        }
        populations
    };
    let ipop = populations(Restart::Ipop, 6);
    assert!(ipop.windows(2).all(|pair| pair[1] == 2.0 * pair[0]), "{ipop:?}");
    let bipop = populations(Restart::Bipop, 12);
    let mut large = 6.0;
    let (mut small_searches, mut large_searches) = (0, 0);
    for &population in &bipop[1..] {
        if population == 2.0 * large {
            large = population;
            large_searches += 1;
        } else {
            assert!(population >= 6.0 && population <= large / 2.0 + 1.0, "{bipop:?}");
            small_searches += 1;
        }
    }
    assert!(large_searches > 1 && small_searches > 1, "{bipop:?}");
}

/// Searches far from each other, whose steps are small: a weight tells which one an individual is of.
fn far_apart(settings: CmaEsSettings) -> CmaEs {
    let initial_mean = Initialization::Uniform { limit: 100.0 };
    new(CmaEsSettings { population: Some(6), step_size: 1e-3, least_deviation: 1e-5, initial_mean, ..settings })
}

/// Which search each generation belongs to, counted in order of their first, if its individuals are worth what is said of its
/// search and of the generation.
fn searches(mut strategy: CmaEs, generations: u64, worth: impl Fn(usize, u64) -> f64) -> Vec<usize> {
    let mut places: Vec<f32> = Vec::new();
    let mut visited = Vec::new();
    for number in 1..=generations {
        let seed = Seed::of_run(3).generation(number);
        let population = strategy.ask(seed);
        let (place, size) = (population[0].weights()[0], population.len());
        let search = places.iter().position(|known| (known - place).abs() < 0.5).unwrap_or_else(|| {
            places.push(place);
            places.len() - 1
        });
        visited.push(search);
        let evaluations: Vec<_> =
            (0..size).map(|index| Evaluation::new(worth(search, number) + 1e-6 * index as f64)).collect();
        strategy.tell(&evaluations, seed);
    }
    visited
}

#[test]
fn of_several_starts_the_one_that_got_farthest_goes_on() {
    let settings = CmaEsSettings { starts: 3, start_generations: 2, ..Default::default() };
    let visited = searches(far_apart(settings.clone()), 9, |search, _| [1.0, 3.0, 2.0][search]);
    assert_eq!(visited, [0, 0, 1, 1, 2, 2, 1, 1, 1]);
    let mut begun = far_apart(settings.clone());
    generation(&mut begun, 1);
    let (place, growth) = (begun.mean().expect("a search")[0], TopologyMap::none(26));
    let grown = begun.remapped(settings.clone(), dense(), &growth).expect("grows by nothing");
    assert!(!grown.has_begun_anew());
    let visited = searches(grown.clone(), 5, |_, _| 1.0);
    assert_eq!(
        (visited, grown.mean().expect("carried")[0]),
        (vec![0; 5], place),
        "a search that is carried on has one start"
    );
    let told = far_apart(settings.clone()).with_start(&[vec![2.5; 26]]).expect("26 weights");
    assert_eq!(searches(told, 9, |_, _| 1.0), [0; 9], "a search that is told where to begin has one start");
    // Carried on after so many generations: one that had ended, or the present one where that has got farther.
    for (generations, worth, expected) in [(2, [1.0, 3.0, 2.0], 0), (3, [3.0, 1.0, 2.0], 0), (3, [1.0, 3.0, 2.0], 1)] {
        let mut begun = far_apart(settings.clone());
        let mut places = Vec::new();
        for number in 1..=generations {
            let seed = Seed::of_run(1).generation(number);
            let place = begun.ask(seed)[0].weights()[0];
            if places.last().is_none_or(|last: &f32| (last - place).abs() > 0.5) {
                places.push(place);
            }
            let worth = worth[places.len() - 1];
            let evaluations: Vec<_> =
                (0..begun.ask(seed).len()).map(|index| Evaluation::new(worth + 1e-6 * index as f64)).collect();
            begun.tell(&evaluations, seed);
        }
        let mut carried = begun.remapped(settings.clone(), dense(), &growth).expect("grows by nothing");
        let place = carried.ask(Seed::of_run(2).generation(1))[0].weights()[0];
        assert!((place - places[expected]).abs() < 0.5, "after {generations} generations: {place} of {places:?}");
    }
}

#[test]
fn after_a_search_elsewhere_the_best_so_far_goes_on() {
    let settings = CmaEsSettings { restart: Restart::Returning, ..Default::default() };
    // None gets any farther while it lasts, so each ends when it is known to stagnate.
    let mut visited = searches(far_apart(settings), 4000, |search, _| [2.0, 1.0, 3.0, 1.0, 1.0][search.min(4)]);
    visited.dedup();
    assert_eq!(visited[..7], [0, 1, 0, 2, 3, 2, 4], "from 2 on, which got farthest, it comes back to 2");
}

/// Otherwise as one that returns.
#[test]
fn a_search_that_goes_on_from_another_task_does_not_begin_anew() {
    let settings = CmaEsSettings { restart: Restart::Anew, ..Default::default() };
    let farthest = |search: usize, _| [2.0, 1.0, 3.0, 1.0, 1.0][search.min(4)];
    let mut visited = searches(far_apart(settings.clone()), 4000, farthest);
    visited.dedup();
    assert_eq!(visited[..7], [0, 1, 0, 2, 3, 2, 4], "what begins from nothing begins anew");
    let restarts = |mut search: CmaEs| {
        (1..=4000).for_each(|number| drop(generation(&mut search, number)));
        search.statistics().into_iter().find(|statistic| statistic.name == "restarts").map(|restarts| restarts.value)
    };
    assert!(restarts(far_apart(settings.clone())).is_some_and(|restarts| restarts > 0.0));
    let told = far_apart(settings.clone()).with_start(&[vec![2.5; 26]]).expect("26 weights");
    assert_eq!(restarts(told), Some(0.0), "what is told where to begin goes on");
    let mut begun = far_apart(settings.clone());
    generation(&mut begun, 1);
    let carried = begun.remapped(settings, dense(), &TopologyMap::none(26)).expect("grows by nothing");
    let saved = serde_json::to_string(&carried).expect("serialises");
    let carried: CmaEs = serde_json::from_str(&saved).expect("it was saved");
    assert_eq!(restarts(carried), Some(0.0), "what is carried goes on, saved or not");
}

/// The bytes of a checkpoint after so many generations.
fn saved_bytes(settings: &CmaEsSettings, generations: u64) -> usize {
    let mut strategy = new(settings.clone());
    (1..=generations).for_each(|number| drop(generation(&mut strategy, number)));
    serde_json::to_string(&strategy).expect("serialises").len()
}

#[test]
fn a_long_run_has_no_larger_checkpoint() {
    let settings = CmaEsSettings::default();
    let (short, long) = (saved_bytes(&settings, 100), saved_bytes(&settings, 10_000));
    assert!(long as f64 <= 1.2 * short as f64, "{short} bytes after 100 generations, {long} after 10,000");
}

/// A champion is not thrown away by the first generation; about a guess there is nothing to keep.
#[test]
fn a_search_that_begins_at_a_champion_begins_with_shorter_steps() {
    let begun = |mut search: CmaEs| -> Option<f64> {
        search.ask(Seed::of_run(1));
        search.statistics().into_iter().find(|statistic| statistic.name == "step_size").map(|step| step.value)
    };
    let first = CmaEsSettings::default().step_size;
    let at_champion = new(CmaEsSettings::default()).with_start(&[vec![0.5; 26]]).expect("26 weights");
    assert_eq!(begun(new(CmaEsSettings::default())), Some(first));
    assert_eq!(begun(at_champion), Some(0.3 * first));
    let about_a_guess = new(CmaEsSettings::default()).with_guess(&[0.5; 26]).expect("26 weights");
    assert_eq!(begun(about_a_guess.clone()), Some(first));
    // What the guess was is known: its first generation lies about it.
    let mut about_a_guess = about_a_guess;
    about_a_guess.ask(Seed::of_run(1));
    assert_eq!(about_a_guess.mean(), Some(&[0.5; 26][..]));
    let error = new(CmaEsSettings::default()).with_guess(&[0.0; 3]).expect_err("three weights").to_string();
    assert!(error.starts_with("start[0]"), "{error}");
}
