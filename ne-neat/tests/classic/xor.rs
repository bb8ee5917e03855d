//! Exclusive or, the paper's test whether NEAT is implemented right.

use crate::runs::{Solution, mean, solve};
use ne_neat::NeatSettings;
use tasks::{Xor, XorSettings};

fn solve_xor(seed: u64) -> Solution {
    solve(&Xor::new(XorSettings::default()), &NeatSettings::stanley_2002(), seed, 60_000).expect("solved")
}

#[test]
fn ten_seeds_solve_it() {
    for seed in 1..=10 {
        let solution = solve_xor(seed);
        assert!(solution.genome.hidden_count() > 0, "seed {seed}: no net without hidden neurons can");
    }
}

/// The paper: all of 100 runs, 4,755 evaluations on average (deviation 2,553, at most 13,459), 2.35 hidden neurons, 7.48
/// enabled connections.
#[test]
#[ignore = "a hundred runs: cargo test --release -p ne-neat --test classic -- --ignored"]
fn a_hundred_seeds_are_no_slower_than_the_papers() {
    let solutions: Vec<_> = (1..=100).map(solve_xor).collect();
    let evaluations = mean(solutions.iter().map(|solution| solution.evaluations));
    let hidden = mean(solutions.iter().map(|solution| solution.genome.hidden_count()));
    let connections = mean(solutions.iter().map(|solution| solution.genome.enabled_count()));
    let figures = format!("{evaluations} evaluations, {hidden} hidden neurons, {connections} enabled connections");
    assert!(evaluations <= 4755.0, "{figures}");
    assert!((1.0..=4.0).contains(&hidden) && connections <= 12.0, "{figures}");
}
