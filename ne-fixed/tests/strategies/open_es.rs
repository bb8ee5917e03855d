//! What OpenAI-ES promises.

use crate::common::{
    assert_damages_are_found, assert_resumes, dense, digest, evaluations_to, generation, generation_of, recurrent,
    weights,
};
use ne_core::{
    Evaluation, Failure, Seed, Strategy,
    conformance::{StrategyOptions, check_strategy},
};
use ne_fixed::{Adam, Initialization, OpenEs, OpenEsSettings};
use serde_json::json;

fn new(settings: OpenEsSettings) -> OpenEs {
    OpenEs::new(settings, dense()).expect("valid settings")
}

fn decaying() -> OpenEsSettings {
    let initial_centre = Initialization::Uniform { limit: 1.0 };
    OpenEsSettings { population: 8, deviation_decay: 0.9, weight_decay: 0.0, initial_centre, ..Default::default() }
}

#[test]
fn keeps_the_promises_of_a_strategy() {
    for settings in [OpenEsSettings::default(), decaying()] {
        check_strategy(|| new(settings.clone()), &StrategyOptions::default()).expect("keeps its promises");
        let recurrent = || OpenEs::new(settings.clone(), recurrent()).expect("valid");
        check_strategy(recurrent, &StrategyOptions::default()).expect("keeps its promises on a graph");
    }
}

#[test]
fn goes_on_to_the_bit_after_a_save() {
    assert_resumes(new(OpenEsSettings::default()), 5);
    assert_resumes(new(decaying()), 5);
}

/// Golden: another digest changes every recorded run.
#[test]
fn runs_are_the_same_for_ever() {
    let graph = OpenEs::new(OpenEsSettings::default(), recurrent()).expect("valid");
    let digests = [digest(new(OpenEsSettings::default()), 20), digest(new(decaying()), 20), digest(graph, 20)];
    assert_eq!(digests, ["8c0e92a7efed706c", "a330a19c8f3588b6", "fd93d6a282229328"]);
}

#[test]
fn errors_of_settings_name_the_field() {
    type Change = fn(&mut OpenEsSettings);
    let changes: [(Change, &str); 10] = [
        (|s| s.population = 7, "population = 7: must be even, from 2 to 1000000"),
        (|s| s.population = 0, "population = 0: must be even, from 2 to 1000000"),
        (|s| s.population = 1_000_002, "population = 1000002: must be even, from 2 to 1000000"),
        (|s| s.deviation = 0.0, "deviation = 0: must be from 0.000001 to 1000"),
        (|s| s.deviation_decay = 1.5, "deviation_decay = 1.5: must be above 0 and at most 1"),
        (|s| s.least_deviation = 0.2, "least_deviation = 0.2: must be from 0.000001 to 0.1"),
        (|s| s.adam.learning_rate = 0.0, "adam.learning_rate = 0: must be above 0 and at most 1000"),
        (|s| s.adam.momentum = 1.0, "adam.momentum = 1: must be from 0 to below 1"),
        (|s| s.weight_decay = -1.0, "weight_decay = -1: must be from 0 to 1"),
        (
            |s| s.initial_centre = Initialization::Uniform { limit: -1.0 },
            "initial_centre.uniform.limit = -1: must be from 0 to 1000",
        ),
    ];
    for (change, message) in changes {
        let mut settings = OpenEsSettings::default();
        change(&mut settings);
        assert_eq!(OpenEs::new(settings, dense()).expect_err("out of range").to_string(), message);
    }
}

#[test]
fn damaged_states_are_errors_that_name_the_field() {
    let mut strategy = new(OpenEsSettings::default());
    generation(&mut strategy, 1);
    assert_damages_are_found(
        &strategy,
        &[
            (|s| s["settings"]["population"] = 3.into(), "population = 3: must be even"),
            (|s| s["topology"]["dense"]["inputs"] = 0.into(), "inputs = 0: must be from 1 to 4096"),
            (|s| s["centre"] = json!([1.0]), "centre = 1 numbers: must be 26 numbers"),
            (|s| s["deviation"] = json!(7.0), "deviation = 7: must be from 0.01 to 0.1"),
            (|s| s["adam"]["means"] = json!([]), "adam.means = 0 numbers: must be 26 numbers"),
            (|s| s["adam"]["squares"] = json!([]), "adam.squares = 0 numbers: must be 26 numbers"),
            (|s| s["adam"]["squares"][2] = json!(-1.0), "adam.squares[2] = -1: must be at least 0"),
            (|s| s["gradient_length"] = json!(-1.0), "gradient_length = -1: must be at least 0"),
            (|s| s["asked"] = json!([[1.0]]), "asked: found 1 individuals, the settings say 51"),
            (|s| s["asked"] = json!(vec![[1.0]; 51]), "asked[0].weights: found 1, a net of shape 3-4-2 has 26"),
            (
                |s| {
                    s["asked"] = json!(vec![[0.0; 26]; 51]);
                    s["centre"] = json!([]);
                },
                "centre = none: must be there when individuals were asked",
            ),
        ],
    );
}

#[test]
fn samples_lie_opposite_each_other_around_the_centre() {
    let mut strategy = new(OpenEsSettings { population: 1000, ..Default::default() });
    assert_eq!(strategy.recommendation(), None);
    let population = strategy.ask(Seed::of_run(1)).to_vec();
    assert_eq!(strategy.recommendation().as_ref(), Some(&population[0]), "the centre");
    assert_eq!(population.len(), 1001);
    let mut square = 0.0;
    for pair in population[1..].chunks_exact(2) {
        for (gene, centre) in population[0].weights().iter().enumerate() {
            let (plus, minus) = (pair[0].weights()[gene] - centre, pair[1].weights()[gene] - centre);
            assert!((plus + minus).abs() < 1e-6);
            square += f64::from(plus * plus);
        }
    }
    assert!(((square / 13_000.0).sqrt() - 0.1).abs() < 0.003, "{square}");
}

#[test]
fn the_deviation_decays_to_its_least() {
    let mut strategy = new(decaying());
    for number in 1..=30 {
        generation(&mut strategy, number);
        let expected = (0..number).fold(0.1_f64, |deviation, _| (deviation * 0.9).max(0.01));
        assert_eq!(strategy.statistics()[0].value, expected);
    }
}

#[test]
fn without_differences_only_the_weight_decays() {
    for result in [Evaluation::new(3.0), Evaluation::failed(Failure::Other { what: "test".into() })] {
        let mut still = new(OpenEsSettings { weight_decay: 0.0, ..Default::default() });
        let mut decays =
            new(OpenEsSettings { adam: Adam { learning_rate: 1e-3, ..Default::default() }, ..Default::default() });
        let length = |strategy: &OpenEs| strategy.statistics()[2].value;
        generation_of(&mut still, 1, &result);
        generation_of(&mut decays, 1, &result);
        let first = length(&decays);
        for number in 2..20 {
            generation_of(&mut still, number, &result);
            generation_of(&mut decays, number, &result);
        }
        let asked = still.ask(Seed::of_run(1).generation(20))[0].clone();
        assert_eq!(asked, new(OpenEsSettings::default()).ask(Seed::of_run(1).generation(1))[0]);
        assert!(length(&decays) < first);
    }
}

#[test]
fn climbs_a_sphere() {
    let settings = OpenEsSettings { deviation_decay: 0.99, weight_decay: 0.0, ..Default::default() };
    for run in 1..=5 {
        let strategy = OpenEs::new(settings.clone(), weights(50)).expect("valid");
        let distance = |x: &[f64]| x.iter().map(|x| (x - 0.5).powi(2)).sum();
        let evaluations = evaluations_to(strategy, run, distance, 0.5, 20_000);
        assert!(evaluations.is_some(), "run {run}");
    }
}
