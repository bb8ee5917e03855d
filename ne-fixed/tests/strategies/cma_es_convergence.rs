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

/// The mean evaluations of five runs to a cost of 1e-8, beginning at (`start`, `start`, …) with σ = 0.5.
fn mean_evaluations(settings: &CmaEsSettings, n: usize, start: f32, cost: impl Fn(&[f64]) -> f64) -> f64 {
    let settings = CmaEsSettings { least_deviation: 1e-9, ..settings.clone() };
    let evaluations = |run| {
        let strategy = CmaEs::new(settings.clone(), weights(n)).expect("valid").with_mean(&vec![start; n]).expect("n");
        evaluations_to(strategy, run, &cost, 1e-8, 100_000).expect("converges")
    };
    (1..=5).map(evaluations).sum::<usize>() as f64 / 5.0
}

#[test]
fn measured() {
    let full = CmaEsSettings::default();
    let separable = CmaEsSettings { covariance: CovarianceModel::Separable, ..full.clone() };
    for (name, settings) in [("full", &full), ("separable", &separable)] {
        for n in [10, 40] {
            println!("{name} sphere {n} {}", mean_evaluations(settings, n, 1.0, sphere));
            println!("{name} ellipsoid {n} {}", mean_evaluations(settings, n, 1.0, ellipsoid));
        }
    }
    println!("turned sphere {}", mean_evaluations(&full, 10, 1.0, |x| sphere(&turned(x))));
    println!("turned ellipsoid {}", mean_evaluations(&full, 10, 1.0, |x| ellipsoid(&turned(x))));
    println!("rosenbrock {}", mean_evaluations(&full, 10, 0.0, rosenbrock));
    for restart in [Restart::None, Restart::Ipop, Restart::Bipop] {
        let settings = CmaEsSettings { step_size: 2.0, restart, initial_mean: Initialization::Uniform { limit: 5.0 }, ..Default::default() };
        let r: Vec<_> = (1..=5).map(|run| evaluations_to(CmaEs::new(settings.clone(), weights(5)).expect("valid"), run, rastrigin, 1e-6, 100_000)).collect();
        println!("{restart:?} {r:?}");
    }
}
