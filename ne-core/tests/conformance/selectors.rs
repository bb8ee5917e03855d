use crate::{Cases, assert_caught};
use ne_core::{
    Fitness, RandomStream, Roulette, Seed, Selector, Tournament,
    conformance::{Violation, check_selector, selector::*},
};
use rand::RngExt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A selector by hand.
struct ByHand(fn(&[Option<Fitness>], usize, &mut RandomStream, &mut Vec<usize>));

impl Selector for ByHand {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        (self.0)(scores, count, stream, chosen);
    }
}

static CALLS: AtomicUsize = AtomicUsize::new(0);

#[test]
fn broken_selectors_are_caught() {
    fn check(select: fn(&[Option<Fitness>], usize, &mut RandomStream, &mut Vec<usize>)) -> Result<(), Violation> {
        check_selector(&ByHand(select), Seed::of_run(1))
    }
    let good = Tournament { size: 2 };
    assert_eq!(check_selector(&good, Seed::of_run(1)), Ok(()));
    let cases: Cases<'_> = vec![
        (
            COUNT,
            "one too few",
            check(|scores, count, stream, chosen| {
                Tournament::default().select(scores, count.saturating_sub(1), stream, chosen);
            }),
        ),
        (
            COUNT,
            "panics without scores",
            check(|scores, count, stream, chosen| {
                chosen.extend((0..count).map(|_| stream.random_range(0..scores.len())));
            }),
        ),
        (
            RANGE,
            "counts from 1",
            check(|scores, count, stream, chosen| {
                let first = chosen.len();
                Tournament::default().select(scores, count, stream, chosen);
                chosen[first..].iter_mut().for_each(|index| *index += 1);
            }),
        ),
        (
            APPENDS,
            "clears first",
            check(|scores, count, stream, chosen| {
                chosen.clear();
                Tournament::default().select(scores, count, stream, chosen);
            }),
        ),
        (
            APPENDS,
            "fills up to the count",
            check(|scores, count, stream, chosen| {
                Tournament::default().select(scores, count.saturating_sub(chosen.len()), stream, chosen);
            }),
        ),
        (
            DETERMINISTIC,
            "remembers its calls",
            check(|scores, count, _, chosen| {
                let alive: Vec<usize> = (0..scores.len()).filter(|&index| scores[index].is_some()).collect();
                let eligible = if alive.is_empty() { (0..scores.len()).collect() } else { alive };
                let next = || eligible[CALLS.fetch_add(1, Ordering::Relaxed) % eligible.len()];
                chosen.extend((0..if eligible.is_empty() { 0 } else { count }).map(|_| next()));
            }),
        ),
        (
            FAILURES_LAST,
            "uniform among all",
            check(|scores, count, stream, chosen| {
                let draws = if scores.is_empty() { 0 } else { count };
                chosen.extend((0..draws).map(|_| stream.random_range(0..scores.len())));
            }),
        ),
        (
            FAILURES_LAST,
            "takes a failure for a zero",
            check(|scores, count, stream, chosen| {
                let zero = Fitness::new(0.0).ok();
                let scores: Vec<_> = scores.iter().map(|score| score.or(zero)).collect();
                Roulette {}.select(&scores, count, stream, chosen);
            }),
        ),
        (
            PREFERS_BETTER,
            "takes the worst of three",
            check(|scores, count, stream, chosen| {
                let turned: Vec<_> =
                    scores.iter().map(|score| score.and_then(|fitness| Fitness::new(-fitness.get()).ok())).collect();
                Tournament::default().select(&turned, count, stream, chosen);
            }),
        ),
        (
            PREFERS_BETTER,
            "takes the magnitude for the fitness",
            check(|scores, count, stream, chosen| {
                let magnitudes: Vec<_> = scores
                    .iter()
                    .map(|score| score.and_then(|fitness| Fitness::new(fitness.get().abs()).ok()))
                    .collect();
                Tournament::default().select(&magnitudes, count, stream, chosen);
            }),
        ),
    ];
    assert_caught(&cases, PROMISES);
}
