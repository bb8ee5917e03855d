//! Poles on a cart. The figures to beat are those of NEAT in Gomez, Schmidhuber & Miikkulainen, *Accelerated Neural
//! Evolution through Cooperatively Coevolved Synapses*, JMLR 9, 2008, and without velocities in the paper of NEAT.

use crate::runs::{mean, solve, solve_by_generations};
use ne_neat::NeatSettings;
use ne_net::GraphNet;
use tasks::{Benchmark, CartPole, CartPoleSettings, DoublePole, DoublePoleSettings};

/// The mean number of evaluations to a solution; every seed must find one.
fn evaluations(task: &dyn Benchmark, settings: &NeatSettings, seeds: u64) -> f64 {
    mean((1..=seeds).map(|seed| solve(task, settings, seed, 300_000).expect("solved").evaluations))
}

#[test]
fn a_pole_is_balanced() {
    let task = CartPole::new(CartPoleSettings::default()).expect("valid");
    assert!(evaluations(&task, &NeatSettings::pole_balancing(), 2) <= 2_000.0);
}

#[test]
#[ignore = "hundreds of runs: cargo test --release -p ne-neat --test classic -- --ignored"]
fn runs_are_no_longer_than_published() {
    let one = CartPole::new(CartPoleSettings::default()).expect("valid");
    let two = DoublePole::new(DoublePoleSettings::with_velocities()).expect("valid");
    let blind = DoublePole::new(DoublePoleSettings::without_velocities()).expect("valid");
    let (paper, ours) = (NeatSettings::stanley_2002(), NeatSettings::pole_balancing());
    let cases: [(&dyn Benchmark, &NeatSettings, u64, f64); 6] = [
        (&one, &paper, 50, 743.0),
        (&one, &ours, 50, 743.0),
        (&two, &paper, 50, 3_600.0),
        (&two, &ours, 50, 3_600.0),
        (&blind, &NeatSettings::stanley_2002_double_pole(), 20, 33_184.0),
        (&blind, &ours, 20, 6_929.0),
    ];
    for (task, settings, seeds, published) in cases {
        let found = evaluations(task, settings, seeds);
        assert!(found <= published, "{}, population {}: {found}", task.name(), settings.population);
    }
}

/// With the best of each generation alone tested, on seeds that no setting was chosen on.
#[test]
#[ignore = "dozens of runs: cargo test --release -p ne-neat --test classic -- --ignored"]
fn poles_without_velocities_are_balanced_by_the_best_of_a_generation() {
    let blind = DoublePole::new(DoublePoleSettings::without_velocities()).expect("valid");
    let solve = |is_general: bool, seed| {
        let is_enough =
            |net: &mut GraphNet| !is_general || blind.generalization(net).is_ok_and(|starts| starts.is_general());
        solve_by_generations(&blind, is_enough, &NeatSettings::pole_balancing(), seed, 200_000).expect("solved")
    };
    let found = mean((1001..=1050).map(|seed| solve(false, seed)));
    assert!(found <= 8_000.0, "{found}");
    let found = mean((1001..=1020).map(|seed| solve(true, seed)));
    assert!(found <= 20_000.0, "general solutions: {found}");
}
