//! Comparisons with known answers, for tests.

use super::{Cell, Plan, Point, RunResult};
use gambol_runs::Registry;
use ne_core::StopConditions;

/// A plan with seeds from 1 on and a budget of 1,000 evaluations, in metres.
pub(crate) fn plan(methods: &[&str], scenarios: &[&str], seeds: u64) -> Plan {
    let mut config = Registry::default()
        .config("default", creatures::find("biped-1").expect("it is shipped"), "running")
        .expect("a preset");
    config.movement.terms.clear();
    let cell = |method: &str, scenario: &str| Cell {
        method: method.into(),
        scenario: scenario.into(),
        unit: "m".into(),
        config: config.clone(),
        provenance: Vec::new(),
    };
    let of_scenario = |scenario: &&str| methods.iter().map(|method| cell(method, scenario)).collect::<Vec<_>>();
    Plan {
        methods: methods.iter().map(|&name| name.into()).collect(),
        scenarios: scenarios.iter().map(|&name| name.into()).collect(),
        seeds: (1..=seeds).collect(),
        budget: StopConditions { evaluations: Some(1000), ..StopConditions::default() },
        cells: scenarios.iter().flat_map(of_scenario).collect(),
    }
}

/// A run with these best scores after these evaluations. Ten steps an evaluation, a hundred evaluations a second.
pub(crate) fn run(method: &str, scenario: &str, seed: u64, points: &[(u64, Option<f64>)]) -> RunResult {
    let point = |&(evaluations, best): &(u64, Option<f64>)| Point {
        evaluations,
        steps: 10 * evaluations,
        seconds: evaluations as f64 / 100.0,
        best,
    };
    let (method, scenario) = (method.into(), scenario.into());
    let points = points.iter().map(point).collect();
    RunResult { method, scenario, seed, settings: String::new(), points, bare: None, failure: None }
}

/// A plan and all its results: `score(method, scenario, seed)` from evaluation 500 on, half of it from 100 on.
pub(crate) fn comparison(
    methods: &[&str],
    scenarios: &[&str],
    seeds: u64,
    score: impl Fn(usize, usize, u64) -> f64,
) -> (Plan, Vec<RunResult>) {
    let plan = plan(methods, scenarios, seeds);
    let mut results = Vec::new();
    for seed in 1..=seeds {
        for (scenario, scenario_name) in scenarios.iter().enumerate() {
            for (method, method_name) in methods.iter().enumerate() {
                let score = score(method, scenario, seed);
                let points = [(100, Some(score / 2.0)), (500, Some(score)), (1000, Some(score))];
                results.push(run(method_name, scenario_name, seed, &points));
            }
        }
    }
    (plan, results)
}

/// Two methods on two scenarios with eight seeds: the first is better by 1 and more on the first scenario, on the second
/// the two take turns.
pub(crate) fn clear_and_open() -> (Plan, Vec<RunResult>) {
    comparison(&["strong", "weak"], &["biped running", "apod running"], 8, |method, scenario, seed| {
        let seed = seed as f64;
        match (scenario, method) {
            (0, 0) => 10.0 + 1.5 * seed,
            (0, _) => 9.0 + seed,
            (_, 0) => 4.0 + 0.25 * seed,
            _ => 4.0 + 0.25 * (9.0 - seed),
        }
    })
}
