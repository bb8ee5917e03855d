//! The five selectors: properties on any scores, and frequencies against what their documentation says.
#![cfg(feature = "evolution")]

mod frequencies;
mod properties;

use ne_core::{Fitness, Purpose, RandomStream, Seed, Selector};

const DRAW: Purpose = Purpose::new("test draw");

fn stream(run: u64) -> RandomStream {
    Seed::of_run(run).stream(DRAW)
}

/// Scores; NaN stands for a failure.
fn scores(values: &[f64]) -> Vec<Option<Fitness>> {
    values.iter().map(|&value| Fitness::new(value).ok()).collect()
}

fn select(selector: &dyn Selector, scores: &[Option<Fitness>], count: usize, run: u64) -> Vec<usize> {
    let mut chosen = Vec::new();
    selector.select(scores, count, &mut stream(run), &mut chosen);
    chosen
}

/// How often each score is chosen.
fn tally(selector: &dyn Selector, scores: &[Option<Fitness>], count: usize, run: u64) -> Vec<usize> {
    let mut tally = vec![0; scores.len()];
    select(selector, scores, count, run).into_iter().for_each(|index| tally[index] += 1);
    tally
}
