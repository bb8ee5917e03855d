//! Pole balancing: the evaluations until a task is solved, against the means of Gomez, Schmidhuber & Miikkulainen (2008).
//!
//! The nets are those for which the settings are recommended. They have a constant input, as in the programs of that
//! time, and no other bias: [`single_neuron`] for tasks with velocities, [`fully_recurrent`] with two neurons for those
//! without. Evaluations are counted up to the first that solves the task, in the order asked; a test of 100,000 decisions
//! after a damped one is not counted.
//!
//! `cargo test --release -p ne-fixed --test strategies poles -- --include-ignored --nocapture`

use crate::common::{fully_recurrent, single_neuron};
use ne_core::{Evaluation, Genome, Seed, Strategy};
use ne_fixed::{CmaEs, CmaEsSettings, Cosyne, CosyneSettings, WeightVector};
use ne_net::GraphShape;
use tasks::{Benchmark, CartPole, CartPoleSettings, DoublePole, DoublePoleSettings};

fn one_pole() -> CartPole {
    CartPole::new(CartPoleSettings { bias_input: true, ..Default::default() }).expect("valid")
}

fn two_poles(settings: DoublePoleSettings) -> DoublePole {
    DoublePole::new(DoublePoleSettings { bias_input: true, ..settings }).expect("valid")
}

fn cma_es(shape: GraphShape) -> CmaEs {
    CmaEs::new(CmaEsSettings::pole_balancing(), shape).expect("valid")
}

fn cosyne(shape: GraphShape) -> Cosyne {
    Cosyne::new(CosyneSettings::pole_balancing(), shape).expect("valid")
}

/// The evaluations to a solution; none if it takes more than 100,000.
fn evaluations<S: Strategy<Genome = WeightVector>>(mut strategy: S, task: &dyn Benchmark, run: u64) -> Option<u32> {
    let mut count = 0;
    for number in 1.. {
        let seed = Seed::of_run(run).generation(number);
        let mut evaluations = Vec::new();
        for genome in strategy.ask(seed) {
            let mut net = genome.express();
            let evaluation = task.evaluate(&mut net, seed);
            count += 1;
            if task.is_solved(&mut net, &evaluation) {
                return Some(count);
            }
            evaluations.push(evaluation);
        }
        if count > 100_000 {
            break;
        }
        strategy.tell(&evaluations, seed);
    }
    None
}

/// Solves the task with each of the seeds 1 to `runs`, and checks the mean of the evaluations.
#[expect(clippy::print_stdout, reason = "the figures are what these tests are run for")]
fn check<S: Strategy<Genome = WeightVector>>(strategy: impl Fn() -> S, task: &dyn Benchmark, runs: u64, most: f64) {
    let solved: Option<Vec<u32>> = (1..=runs).map(|run| evaluations(strategy(), task, run)).collect();
    let mut solved = solved.expect("every seed solves the task");
    let mean = f64::from(solved.iter().sum::<u32>()) / runs as f64;
    solved.sort_unstable();
    let (name, task) = (strategy().name().to_string(), task.name());
    let (median, worst) = (solved[solved.len() / 2], solved[solved.len() - 1]);
    println!("{task}, {name}: {runs} of {runs} solved, evaluations {mean:.0} mean, {median} median, {worst} worst");
    assert!(mean <= most, "{task}, {name}: {mean} evaluations");
}

/// Quick enough for every run of the tests.
#[test]
fn one_pole_is_balanced() {
    let shape = single_neuron(5);
    check(|| cma_es(shape.clone()), &one_pole(), 2, 283.0);
    check(|| cosyne(shape.clone()), &one_pole(), 2, 283.0);
}

#[test]
#[ignore = "dozens of runs: cargo test --release -p ne-fixed --test strategies poles -- --include-ignored"]
fn one_pole_as_fast_as_published() {
    let shape = single_neuron(5);
    check(|| cma_es(shape.clone()), &one_pole(), 50, 283.0);
    check(|| cosyne(shape.clone()), &one_pole(), 50, 98.0);
}

#[test]
#[ignore = "dozens of runs: cargo test --release -p ne-fixed --test strategies poles -- --include-ignored"]
fn two_poles_as_fast_as_published() {
    let (shape, task) = (single_neuron(7), two_poles(DoublePoleSettings::with_velocities()));
    check(|| cma_es(shape.clone()), &task, 50, 895.0);
    check(|| cosyne(shape.clone()), &task, 50, 954.0);
}

#[test]
#[ignore = "dozens of runs: cargo test --release -p ne-fixed --test strategies poles -- --include-ignored"]
fn two_poles_without_velocities_as_fast_as_published() {
    let (shape, task) = (fully_recurrent(4, 2, false), two_poles(DoublePoleSettings::without_velocities()));
    check(|| cma_es(shape.clone()), &task, 20, 3_416.0);
    check(|| cosyne(shape.clone()), &task, 20, 3_416.0);
}

/// As [`evaluations`], but of each generation only the best is tested, as papers have it; the evaluations are those up to the
/// end of its generation.
fn evaluations_by_generations<S: Strategy<Genome = WeightVector>>(
    mut strategy: S,
    task: &dyn Benchmark,
    run: u64,
) -> Option<usize> {
    let mut count = 0;
    for number in 1.. {
        let seed = Seed::of_run(run).generation(number);
        let genomes = strategy.ask(seed);
        let evaluations: Vec<Evaluation> =
            genomes.iter().map(|genome| task.evaluate(&mut genome.express(), seed)).collect();
        count += evaluations.len();
        // Reversed, since of equals `max_by_key` takes the last.
        let best = genomes.iter().zip(&evaluations).rev().max_by_key(|(_, evaluation)| evaluation.fitness());
        let (genome, evaluation) = best.expect("there are individuals");
        if task.is_solved(&mut genome.express(), evaluation) {
            return Some(count);
        }
        if count > 100_000 {
            break;
        }
        strategy.tell(&evaluations, seed);
    }
    None
}

/// Checks the mean of the evaluations of 50 runs on seeds that no setting was chosen on.
fn check_by_generations<S: Strategy<Genome = WeightVector>>(
    strategy: impl Fn() -> S,
    task: &dyn Benchmark,
    most: usize,
) {
    let counts = (1001..=1050).map(|run| evaluations_by_generations(strategy(), task, run));
    let solved: Option<Vec<usize>> = counts.collect();
    let mean = solved.expect("every seed solves the task").iter().sum::<usize>() / 50;
    assert!(mean <= most, "{}, {}: {mean} evaluations", task.name(), strategy().name());
}

#[test]
#[ignore = "dozens of runs: cargo test --release -p ne-fixed --test strategies poles -- --include-ignored"]
fn two_poles_without_velocities_by_the_best_of_a_generation() {
    let (shape, task) = (fully_recurrent(4, 2, false), two_poles(DoublePoleSettings::without_velocities()));
    check_by_generations(|| cma_es(shape.clone()), &task, 1_900);
    check_by_generations(|| cosyne(shape.clone()), &task, 5_000);
}
