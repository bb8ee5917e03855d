//! Operators of the library keep their promises, and broken ones are caught.

use ne_core::{
    RandomStream, Seed,
    conformance::{Promise, Violation},
};
use ne_fixed::{
    Arithmetic, Crossover, DistributedMutation, Distribution, GaussianMutation, Mutation, OnePoint,
    SelfAdaptiveMutation, Setting, TwoPoint, UniformCrossover, UniformMutation,
    conformance::{check_crossover, check_mutation, crossover, mutation},
};
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU32, Ordering};

const SEED: Seed = Seed::of_run(7);

#[test]
fn operators_of_the_library_keep_their_promises() {
    let crossovers = [
        check_crossover(&OnePoint {}, SEED),
        check_crossover(&TwoPoint {}, SEED),
        check_crossover(&UniformCrossover {}, SEED),
        check_crossover(&Arithmetic {}, SEED),
    ];
    let distribution = Distribution::Cauchy { scale: 0.3 };
    let mutations = [
        check_mutation(&UniformMutation::default(), SEED),
        check_mutation(&GaussianMutation::default(), SEED),
        check_mutation(&SelfAdaptiveMutation::default(), SEED),
        check_mutation(&DistributedMutation { distribution, ..Default::default() }, SEED),
        // Nothing changes.
        check_mutation(&GaussianMutation { rate: 0.0, deviation: 1.0 }, SEED),
    ];
    for checked in crossovers.into_iter().chain(mutations) {
        assert_eq!(checked, Ok(()));
    }
}

/// An operator with one flaw.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Flawed {
    LeavesGenes,
    Drifts,
    CountsCalls,
    Overflows,
    Panics,
    ForgetsTheDeviation,
    MoreOften,
    Less,
}

static CALLS: AtomicU32 = AtomicU32::new(0);

impl Setting for Flawed {}

impl Crossover for Flawed {
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream) {
        assert!(*self != Self::Panics || first.len() < 3, "too long");
        let last = child.len() - 1;
        let kept = child[last];
        for (gene, (first, second)) in child.iter_mut().zip(first.iter().zip(second)) {
            *gene = if stream.random::<bool>() { *first } else { *second };
        }
        match self {
            Self::LeavesGenes => child[last] = kept,
            Self::Drifts => child.iter_mut().for_each(|gene| *gene *= 0.5),
            Self::CountsCalls => child[0] = CALLS.fetch_add(1, Ordering::Relaxed) as f32,
            Self::Overflows if first != second => child.iter_mut().for_each(|gene| *gene *= 4.0),
            _ => {}
        }
    }
}

impl Mutation for Flawed {
    fn mutate(&self, weights: &mut [f32], deviation: &mut f32, strength: f32, stream: &mut RandomStream) {
        let rate = if *self == Self::MoreOften { 0.1 * f64::from(strength) } else { 0.1 };
        let size = if *self == Self::Less { 1.0 / strength } else { strength };
        for weight in weights {
            if stream.random::<f64>() < rate {
                *weight += size * stream.random_range(-1.0..1.0_f32);
            }
            if *self == Self::Overflows {
                *weight *= 2.0;
            }
            if *self == Self::CountsCalls {
                *weight = CALLS.fetch_add(1, Ordering::Relaxed) as f32;
            }
        }
        if *self == Self::ForgetsTheDeviation {
            *deviation = -1.0;
        }
    }
}

fn assert_caught(cases: &[(Promise, Result<(), Violation>)], promises: &[Promise]) {
    for (promise, checked) in cases {
        let violation = checked.as_ref().expect_err(promise.text());
        assert_eq!(violation.promise, *promise, "{violation}");
    }
    for promise in promises {
        assert!(cases.iter().any(|(broken, _)| broken == promise), "no case breaks {promise:?}");
    }
}

#[test]
fn broken_crossovers_are_caught() {
    let cases = [
        (crossover::WRITES, check_crossover(&Flawed::LeavesGenes, SEED)),
        (crossover::WRITES, check_crossover(&Flawed::Panics, SEED)),
        (crossover::WRITES, check_crossover(&Flawed::CountsCalls, SEED)),
        (crossover::EQUALS, check_crossover(&Flawed::Drifts, SEED)),
        (crossover::FINITE, check_crossover(&Flawed::Overflows, SEED)),
        (crossover::DETERMINISTIC, check_crossover(&CountsEveryThird, SEED)),
    ];
    assert_caught(&cases, crossover::PROMISES);
}

/// Another child at every third call.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct CountsEveryThird;

impl Setting for CountsEveryThird {}

impl Crossover for CountsEveryThird {
    fn cross(&self, first: &[f32], _: &[f32], child: &mut [f32], _: &mut RandomStream) {
        static CALLS: AtomicU32 = AtomicU32::new(0);
        child.copy_from_slice(first);
        child[0] += (CALLS.fetch_add(1, Ordering::Relaxed) / 3) as f32;
    }
}

#[test]
fn broken_mutations_are_caught() {
    let cases = [
        (mutation::DETERMINISTIC, check_mutation(&Flawed::CountsCalls, SEED)),
        (mutation::FINITE, check_mutation(&Flawed::Overflows, SEED)),
        (mutation::FINITE, check_mutation(&Flawed::ForgetsTheDeviation, SEED)),
        (mutation::STRENGTH, check_mutation(&Flawed::MoreOften, SEED)),
        (mutation::STRENGTH, check_mutation(&Flawed::Less, SEED)),
    ];
    assert_caught(&cases, mutation::PROMISES);
}
