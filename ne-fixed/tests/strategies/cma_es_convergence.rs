//! CMA-ES on functions whose budgets are known.

use crate::common::{evaluations_to, weights};
use ne_fixed::{CmaEs, CmaEsSettings, CovarianceModel, Initialization, Restart};
use std::f64::consts::PI;

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

/// Condition number 1e6.
fn ellipsoid(x: &[f64]) -> f64 {
    let last = (x.len() - 1) as f64;
    x.iter().enumerate().map(|(index, x)| libm::pow(1e6, index as f64 / last) * x * x).sum()
}

fn cigar(x: &[f64]) -> f64 {
    x[0] * x[0] + 1e6 * sphere(&x[1..])
}

fn rosenbrock(x: &[f64]) -> f64 {
    let term = |pair: &[f64]| 100.0 * (pair[0] * pair[0] - pair[1]).powi(2) + (1.0 - pair[0]).powi(2);
    x.windows(2).map(term).sum()
}

fn rastrigin(x: &[f64]) -> f64 {
    x.iter().map(|x| 10.0 + x * x - 10.0 * libm::cos(2.0 * PI * x)).sum()
}

/// The point, turned so that no axis is one of the coordinates': a reflection at the plane across (1, 2, 3, …).
fn turned(x: &[f64]) -> Vec<f64> {
    let normal = |index: usize| (index + 1) as f64;
    let length: f64 = (0..x.len()).map(|index| normal(index).powi(2)).sum();
    let along = x.iter().enumerate().map(|(index, x)| normal(index) * x).sum::<f64>() / length;
    x.iter().enumerate().map(|(index, x)| x - 2.0 * along * normal(index)).collect()
}

fn full() -> CmaEsSettings {
    CmaEsSettings { covariance: CovarianceModel::Full, ..Default::default() }
}

/// The mean evaluations of five runs to a cost of 1e-8, beginning at (`start`, `start`, …) with σ = 0.5.
fn mean_evaluations(settings: &CmaEsSettings, n: usize, start: f32, cost: impl Fn(&[f64]) -> f64) -> f64 {
    let settings = CmaEsSettings { least_deviation: 1e-9, ..settings.clone() };
    let evaluations = |run| {
        let strategy =
            CmaEs::new(settings.clone(), weights(n)).expect("valid").with_start(&[vec![start; n]]).expect("n");
        evaluations_to(strategy, run, &cost, 1e-8, 100_000).expect("converges")
    };
    (1..=5).map(evaluations).sum::<usize>() as f64 / 5.0
}

/// pycma 4.5 needs 1,367, 3,967, 4,907 and 3,986 evaluations on average (seeds 1 to 5).
#[test]
fn needs_no_more_evaluations_than_the_reference() {
    let settings = full();
    for (name, evaluations, reference) in [
        ("sphere", mean_evaluations(&settings, 10, 1.0, sphere), 1_367.0),
        ("ellipsoid", mean_evaluations(&settings, 10, 1.0, ellipsoid), 3_967.0),
        ("Rosenbrock", mean_evaluations(&settings, 10, 0.0, rosenbrock), 4_907.0),
        ("cigar", mean_evaluations(&settings, 10, 1.0, cigar), 3_986.0),
    ] {
        assert!(evaluations < 1.15 * reference, "{name}: {evaluations} evaluations");
    }
}

/// pycma 4.5 with a diagonal covariance needs 1,133 and 2,137.
#[test]
fn separable_is_faster_where_weights_are_independent() {
    let settings = CmaEsSettings::default();
    let on_sphere = mean_evaluations(&settings, 10, 1.0, sphere);
    let on_ellipsoid = mean_evaluations(&settings, 10, 1.0, ellipsoid);
    assert!(on_sphere < 1.15 * 1_133.0 && on_ellipsoid < 1.15 * 2_137.0, "{on_sphere}, {on_ellipsoid}");
}

#[test]
fn full_does_not_mind_a_turned_function_and_separable_does() {
    let turned_ellipsoid = |x: &[f64]| ellipsoid(&turned(x));
    let turned = mean_evaluations(&full(), 10, 1.0, turned_ellipsoid);
    let straight = mean_evaluations(&full(), 10, 1.0, ellipsoid);
    assert!((turned / straight - 1.0).abs() < 0.1, "{turned} turned, {straight} straight");
    let settings = CmaEsSettings::default();
    let strategy = CmaEs::new(settings, weights(10)).expect("valid").with_start(&[vec![1.0; 10]]).expect("10 weights");
    assert_eq!(evaluations_to(strategy, 1, turned_ellipsoid, 1e-8, 20_000), None);
}

#[test]
fn restarts_solve_rastrigin_where_one_search_does_not() {
    let evaluations = |restart, run| {
        let initial_mean = Initialization::Uniform { limit: 5.0 };
        let settings = CmaEsSettings { step_size: 2.0, restart, initial_mean, ..full() };
        let strategy = CmaEs::new(settings, weights(5)).expect("valid");
        evaluations_to(strategy, run, rastrigin, 1e-6, 60_000)
    };
    for run in 1..=5 {
        assert_eq!(evaluations(Restart::None, run), None, "run {run}");
        assert!(evaluations(Restart::Ipop, run).is_some(), "run {run}");
        assert!(evaluations(Restart::Bipop, run).is_some(), "run {run}");
    }
}
