//! Comparisons with known answers, for tests.

use super::{Cell, Plan, Point, RunResult};
use crate::config::preset;
use ne_core::StopConditions;

/// A plan with seeds from 1 on and a budget of 1,000 evaluations, in metres.
pub(super) fn plan(methods: &[&str], scenarios: &[&str], seeds: u64) -> Plan {
    let config = preset("default").expect("there is one").config(creatures::shipped()[0].creature(), "running");
    let cell = |method: &str, scenario: &str| Cell {
        method: method.into(),
        scenario: scenario.into(),
        unit: "m".into(),
        config: config.clone(),
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
pub(super) fn run(method: &str, scenario: &str, seed: u64, points: &[(u64, Option<f64>)]) -> RunResult {
    let point = |&(evaluations, best): &(u64, Option<f64>)| Point {
        evaluations,
        steps: 10 * evaluations,
        seconds: evaluations as f64 / 100.0,
        best,
    };
    let (method, scenario) = (method.into(), scenario.into());
    RunResult { method, scenario, seed, points: points.iter().map(point).collect() }
}

/// A plan and all its results: `score(method, scenario, seed)` from evaluation 500 on, half of it from 100 on.
pub(super) fn comparison(
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
pub(super) fn clear_and_open() -> (Plan, Vec<RunResult>) {
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

#[cfg(test)]
mod scratch {
    use super::*;
    use crate::compare::{analyse, page, table};
    use ne_core::{Purpose, Seed};
    use rand::RngExt;

    fn fake(methods: &[&str], scenarios: &[&str], seeds: u64) -> (Plan, Vec<RunResult>) {
        let mut plan = plan(methods, scenarios, seeds);
        plan.budget.evaluations = Some(20_000);
        let mut results = Vec::new();
        for seed in 1..=seeds {
            for (s, scenario) in scenarios.iter().enumerate() {
                for (m, method) in methods.iter().enumerate() {
                    let mut stream = Seed::of_run(seed).individual((s * 10 + m) as u64).stream(Purpose::new("x"));
                    let mut u = || {
                        let r: f64 = stream.random();
                        r
                    };
                    let top = [8.0, 0.9, 21.0, 3.3][s % 4]
                        * ([0.72, 0.95, 0.9, 0.6, 0.5, 0.8, 0.7, 0.65, 0.4][m]
                            + 0.25 * (u() - 0.5)
                            + if s == 1 && m == 1 { -0.3 } else { 0.0 });
                    let speed = [0.0009, 0.0016, 0.0006, 0.001, 0.0012, 0.0005, 0.0008, 0.001, 0.001][m] * (0.5 + u());
                    let pop = [150u64, 100, 24, 50, 60, 70, 80, 90, 100][m];
                    let steps_each = [420.0, 500.0, 380.0, 500.0, 500.0, 500.0, 500.0, 450.0, 430.0][m];
                    let (mut best, mut e, mut points) = (0.05 * top, 0, vec![]);
                    let mut secs = 0.0;
                    while e < 20_000 {
                        e += pop;
                        secs += pop as f64 * 0.004 * (0.8 + 0.4 * u());
                        let target = top * (1.0 - 1.0 / (1.0 + e as f64 * speed));
                        if target > best && u() < 0.25 {
                            best = target;
                        }
                        let fails = s == 3 && m == 2 && seed == 4;
                        let p = Point {
                            evaluations: e,
                            steps: (e as f64 * steps_each) as u64,
                            seconds: secs,
                            best: if fails { None } else { Some(best) },
                        };
                        if points.last().is_none_or(|l: &Point| l.best != p.best) || e >= 20_000 {
                            points.push(p);
                        }
                    }
                    results.push(RunResult { method: (*method).into(), scenario: (*scenario).into(), seed, points });
                }
            }
        }
        (plan, results)
    }

    #[test]
    fn dump() {
        let all = ["biped-1 running", "apod jumping", "biped-2 running", "hopper jumping"];
        let dump = |name: &str, (plan, results): (Plan, Vec<RunResult>)| {
            let t = std::time::Instant::now();
            let a = analyse(&plan, &results);
            let took = t.elapsed();
            std::fs::write(format!("/tmp/page/{name}.json"), serde_json::to_string(&a).expect("j")).expect("w");
            std::fs::write(format!("/tmp/page/{name}.html"), page::render(&a)).expect("w");
            std::fs::write(format!("/tmp/page/{name}.txt"), table::render(&a) + &format!("{took:?}")).expect("w");
        };
        dump("main", fake(&["ga", "neat", "cma-es"], &all, 10));
        dump("one-seed", fake(&["ga", "neat"], &all[..1], 1));
        dump("one-method", fake(&["ga"], &all[..2], 5));
        dump("many", fake(&["ga", "neat", "cma-es", "thesis", "snes", "de", "pso", "x-large", "random"], &all, 12));
        dump("clear", clear_and_open());
    }
}
