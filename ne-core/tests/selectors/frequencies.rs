use crate::{scores, tally};
use ne_core::{RankSelector, Roulette, Selector, StochasticUniversal, Tournament, Truncation};

const DRAWS: usize = 100_000;
const FAILED: f64 = f64::NAN;

/// The frequencies of many draws are the expected ones, within five standard deviations.
fn assert_frequencies(selector: &dyn Selector, values: &[f64], expected: &[f64]) {
    let tally = tally(selector, &scores(values), DRAWS, 1);
    for (index, (&times, &share)) in tally.iter().zip(expected).enumerate() {
        let deviation = (DRAWS as f64 * share * (1.0 - share)).sqrt();
        let distance = (times as f64 - DRAWS as f64 * share).abs();
        assert!(distance <= 5.0 * deviation, "index {index}: {times} of {DRAWS}, expected share {share}; {tally:?}");
    }
}

#[test]
fn roulette_is_proportional_to_fitness() {
    assert_frequencies(&Roulette {}, &[1.0, 2.0, 3.0, 4.0], &[0.1, 0.2, 0.3, 0.4]);
    assert_frequencies(&Roulette {}, &[0.0, 1.0, FAILED, 3.0], &[0.0, 0.25, 0.0, 0.75]);
}

#[test]
fn roulette_subtracts_the_lowest_if_any_is_negative() {
    assert_frequencies(&Roulette {}, &[-1.0, 0.0, 2.0], &[0.0, 0.25, 0.75]);
    assert_frequencies(&Roulette {}, &[-5.0, -4.0, -3.0, FAILED, -5.0], &[0.0, 1.0 / 3.0, 2.0 / 3.0, 0.0, 0.0]);
}

#[test]
fn roulette_is_uniform_among_equals_and_among_failures() {
    assert_frequencies(&Roulette {}, &[0.0, FAILED, 0.0], &[0.5, 0.0, 0.5]);
    assert_frequencies(&Roulette {}, &[-7.0, -7.0, FAILED, -7.0], &[1.0 / 3.0, 1.0 / 3.0, 0.0, 1.0 / 3.0]);
    assert_frequencies(&Roulette {}, &[FAILED; 4], &[0.25; 4]);
}

#[test]
fn roulette_keeps_proportions_of_huge_and_tiny_fitnesses() {
    assert_frequencies(&Roulette {}, &[1e308, 1e308, 0.0], &[0.5, 0.5, 0.0]);
    assert_frequencies(&Roulette {}, &[f64::MIN, 0.0, f64::MAX], &[0.0, 1.0 / 3.0, 2.0 / 3.0]);
    let least = 5e-324;
    assert_frequencies(&Roulette {}, &[FAILED, least, 3.0 * least, 0.0], &[0.0, 0.25, 0.75, 0.0]);
}

#[test]
fn stochastic_universal_expects_what_roulette_does() {
    assert_frequencies(&StochasticUniversal {}, &[1.0, 2.0, 3.0, 4.0], &[0.1, 0.2, 0.3, 0.4]);
    assert_frequencies(&StochasticUniversal {}, &[-1.0, 0.0, FAILED, 2.0], &[0.0, 0.25, 0.0, 0.75]);
    // Few pointers, many spins: the expectation holds for each spin, not only for many pointers.
    let mut total = [0_usize; 3];
    for run in 0..20_000 {
        let once = tally(&StochasticUniversal {}, &scores(&[1.0, 2.0, 5.0]), 3, run);
        total.iter_mut().zip(once).for_each(|(sum, times)| *sum += times);
    }
    for (times, share) in total.into_iter().zip([0.125, 0.25, 0.625]) {
        assert!((times as f64 / 60_000.0 - share).abs() < 0.01, "{times} of 60000, expected share {share}");
    }
}

/// Neighbours mate, so the order of the chosen must not follow the order of the population.
#[test]
fn stochastic_universal_shuffles() {
    let mut first_is_best = 0;
    for run in 0..1000 {
        first_is_best += usize::from(crate::select(&StochasticUniversal {}, &scores(&[1.0, 1.0]), 2, run)[0] == 1);
    }
    assert!((400..600).contains(&first_is_best), "{first_is_best} of 1000");
}

#[test]
fn rank_pressure_is_what_the_best_can_expect() {
    // Weights (2 - s) + 2 (s - 1) r / (n - 1), over n.
    let expected = |s: f64| [0.0, 1.0, 2.0, 3.0].map(|rank| ((2.0 - s) + 2.0 * (s - 1.0) * rank / 3.0) / 4.0);
    for pressure in [1.0, 1.5, 2.0] {
        let [worst, low, high, best] = expected(pressure);
        assert_frequencies(&RankSelector { pressure }, &[1e9, -3.0, 0.0, 0.1], &[best, worst, low, high]);
    }
    assert_frequencies(&RankSelector { pressure: 2.0 }, &[FAILED, 1.0, 2.0, FAILED], &[0.0, 0.0, 1.0, 0.0]);
    assert_frequencies(&RankSelector { pressure: 2.0 }, &[FAILED, 1.0], &[0.0, 1.0]);
    assert_frequencies(&RankSelector { pressure: 1.0 }, &[FAILED; 4], &[0.25; 4]);
}

#[test]
fn tournament_frequencies_are_those_of_the_best_of_k() {
    // The one of rank r among n wins with ((r + 1)^k - r^k) / n^k.
    for size in [1, 2, 3, 7] {
        let win = |rank: i32| {
            let (n, k) = (5.0_f64, size as i32);
            (f64::from(rank + 1).powi(k) - f64::from(rank).powi(k)) / n.powi(k)
        };
        let expected = [win(4), win(0), win(3), win(1), win(2)];
        assert_frequencies(&Tournament { size }, &[9.0, -2.0, 4.0, 0.0, 0.5], &expected);
    }
}

#[test]
fn tournament_gives_draws_of_failures_to_the_best() {
    // Both drawn are failures in 4 of 9; the better of two survivors wins otherwise as usual.
    assert_frequencies(&Tournament { size: 2 }, &[FAILED, 1.0, FAILED], &[0.0, 1.0, 0.0]);
    let (failures, low) = (0.25, 5.0 / 16.0);
    assert_frequencies(&Tournament { size: 2 }, &[FAILED, 1.0, 2.0, FAILED], &[0.0, low, failures + 7.0 / 16.0, 0.0]);
}

#[test]
fn truncation_is_uniform_among_the_best() {
    let values = [5.0, 1.0, 4.0, 2.0, 3.0];
    assert_frequencies(&Truncation { share: 0.4 }, &values, &[0.5, 0.0, 0.5, 0.0, 0.0]);
    assert_frequencies(&Truncation { share: 0.41 }, &values, &[1.0 / 3.0, 0.0, 1.0 / 3.0, 0.0, 1.0 / 3.0]);
    assert_frequencies(&Truncation { share: 1.0 }, &values, &[0.2; 5]);
    assert_frequencies(&Truncation { share: 1.0 }, &[FAILED, 1.0, 2.0], &[0.0, 0.5, 0.5]);
    assert_frequencies(&Truncation { share: 0.01 }, &[FAILED, FAILED, FAILED], &[0.0, 0.0, 1.0]);
}

/// 0.07 of 100 is 7.000000000000001 in floating point, and means 7.
#[test]
fn truncation_counts_parents_as_people_do() {
    let values: Vec<f64> = (0..100).map(f64::from).collect();
    for percent in 1..=100 {
        let share = percent as f64 / 100.0;
        let tally = tally(&Truncation { share }, &scores(&values), 20_000, 1);
        assert_eq!(tally.iter().filter(|&&times| times > 0).count(), percent, "share {share}");
    }
}

#[test]
fn ranks_of_failures_alone_are_none() {
    for pressure in [1.0, 1.8, 2.0] {
        assert_frequencies(&RankSelector { pressure }, &[FAILED; 5], &[0.2; 5]);
    }
}
