use ne_core::Fitness;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The fitnesses of one search, generation by generation: by them it is known to have ended.
///
/// Source: Hansen, *The CMA Evolution Strategy: A Tutorial*, arXiv 1604.00772, appendix B.3.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct History {
    /// The best and the median of each of the last generations that did not fail as a whole.
    generations: VecDeque<[Fitness; 2]>,
}

/// The most generations that are kept.
const LONGEST: usize = 20_000;

/// In worlds that vary the best of one generation is luck: so many generations tell how far a search has got.
const LAST: usize = 10;

/// A best fitness that differs by no more than this has not changed.
const EQUAL: f64 = 1e-12;

impl History {
    /// Adds a generation, scores best first; `updates` is the number of generations of the search so far, this one
    /// included.
    pub(super) fn push(&mut self, ranked: &[Option<Fitness>], n: usize, updates: u64) {
        let Some(best) = ranked[0] else { return };
        // If half of them failed, the median is the worst there is.
        let succeeded = ranked.iter().flatten().count();
        let median = ranked[(ranked.len() / 2).min(succeeded - 1)].unwrap_or(best);
        self.generations.push_back([best, median]);
        let length = (updates / 5).max(stagnation_length(n, ranked.len()) as u64).min(LONGEST as u64);
        while self.generations.len() as u64 > length {
            self.generations.pop_front();
        }
    }

    /// Forgets all but what [`level`](Self::level) looks at.
    pub(super) fn shorten(&mut self) {
        let first = self.generations.len().saturating_sub(LAST);
        self.generations.drain(..first);
    }

    /// How far the search has got: the median of the best fitnesses of the last generations; `None` before the first.
    pub(super) fn level(&self) -> Option<Fitness> {
        let mut bests: Vec<Fitness> = self.generations.iter().rev().take(LAST).map(|[best, _]| *best).collect();
        bests.sort_unstable();
        bests.get(bests.len() / 2).copied()
    }

    /// Whether the search makes no progress any more: the best has been the same for 10 + ⌈30 n / λ⌉ generations
    /// (EqualFunValues), or neither best nor median have been better in the last 30 % of at least 120 + 30 n / λ
    /// generations, and of the last fifth of all, than in the first 30 % of them (Stagnation).
    pub(super) fn stagnates(&self, n: usize, population: usize) -> bool {
        let equal_length = equal_length(n, population);
        let bests = || self.generations.iter().rev().take(equal_length).map(|[best, _]| best.get());
        let range = bests().fold(f64::MIN, f64::max) - bests().fold(f64::MAX, f64::min);
        if self.generations.len() >= equal_length && range <= EQUAL {
            return true;
        }
        if self.generations.len() < stagnation_length(n, population) {
            return false;
        }
        let part = self.generations.len() * 3 / 10;
        let median = |which: usize, skipped: usize| {
            let mut values: Vec<Fitness> =
                self.generations.iter().skip(skipped).take(part).map(|pair| pair[which]).collect();
            values.sort_unstable();
            values[part / 2]
        };
        let last = self.generations.len() - part;
        (0..2).all(|which| median(which, last) <= median(which, 0))
    }
}

/// A search whose best fitness stays the same, or which has none, ends after so many generations.
pub(super) fn equal_length(n: usize, population: usize) -> usize {
    10 + (30 * n).div_ceil(population)
}

fn stagnation_length(n: usize, population: usize) -> usize {
    (120 + 30 * n / population).min(LONGEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// After how many generations of these values a search of 10 weights with a population of 10 stagnates.
    fn generations(value: impl Fn(u64) -> f64) -> Option<u64> {
        let mut history = History::default();
        (1..=1000).find(|&number| {
            let fitness = Fitness::new(value(number)).ok();
            history.push(&[fitness; 10], 10, number);
            history.stagnates(10, 10)
        })
    }

    #[test]
    fn ends_after_equal_values_or_without_progress() {
        assert_eq!(generations(|_| 3.0), Some(40));
        assert_eq!(generations(|number| number as f64), None);
        // Neither equal nor better.
        assert_eq!(generations(|number| (number % 7) as f64), Some(150));
        assert_eq!(generations(|number| if number < 100 { number as f64 } else { 99.0 }), Some(138));
        assert_eq!(generations(|number| f64::MAX * if number % 2 == 0 { 1.0 } else { -1.0 }), Some(151));
    }

    #[test]
    fn failures_are_no_generations_and_count_for_the_median() {
        let mut history = History::default();
        history.push(&[None; 4], 10, 1);
        assert_eq!(history, History::default());
        let fitness = |value| Fitness::new(value).ok();
        history.push(&[fitness(3.0), fitness(1.0), None, None], 10, 1);
        assert_eq!(serde_json::to_string(&history).expect("serialises"), "[[3.0,1.0]]");
    }
}
