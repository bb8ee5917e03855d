//! What a selector owes.

use super::{Promise, Violation};
use crate::{Fitness, Purpose, Seed, Selector};

/// As many as asked.
pub const COUNT: Promise = Promise::new("selector", "exactly `count` parents are chosen, none from no scores");
/// Each is there.
pub const RANGE: Promise = Promise::new("selector", "every index is below the number of scores");
/// What is there stays.
pub const APPENDS: Promise = Promise::new("selector", "the choice is appended, and does not depend on what was there");
/// The same again.
pub const DETERMINISTIC: Promise = Promise::new("selector", "the choice depends on the scores and the stream alone");
/// Failures last.
pub const FAILURES_LAST: Promise = Promise::new("selector", "a failure is chosen only when there is nothing else");
/// Better is not worse.
pub const PREFERS_BETTER: Promise =
    Promise::new("selector", "over many draws a better score is chosen at least about as often as a worse one");

/// All of them.
pub const PROMISES: &[Promise] = &[COUNT, RANGE, APPENDS, DETERMINISTIC, FAILURES_LAST, PREFERS_BETTER];

const CHECK: Purpose = Purpose::new("conformance selector");

/// Checks a selector on ordinary, equal, negative, huge, tiny, failed and missing scores. `seed` gives the draws.
///
/// Whether better scores win is judged on 20,000 draws, at five standard deviations: a selector that keeps its promises
/// fails about once in a million seeds.
///
/// # Errors
/// The first promise that is not kept.
pub fn check_selector(selector: &dyn Selector, seed: Seed) -> Result<(), Violation> {
    let draw = |scores: &[Option<Fitness>], count: usize, place: u64| {
        let mut chosen = Vec::new();
        selector.select(scores, count, &mut seed.individual(place).stream(CHECK), &mut chosen);
        chosen
    };
    for (name, scores) in &score_lists() {
        for count in [0, 1, 2, 7, 64] {
            let expected = if scores.is_empty() { 0 } else { count };
            let chosen = COUNT.check(|| match draw(scores, count, 0) {
                chosen if chosen.len() == expected => Ok(chosen),
                chosen => {
                    Err(format!("{} parents, {count} asked, from {name} ({} scores)", chosen.len(), scores.len()))
                }
            })?;
            RANGE.check(|| match chosen.iter().find(|&&index| index >= scores.len()) {
                Some(index) => Err(format!("index {index} from {name} ({} scores)", scores.len())),
                None => Ok(()),
            })?;
            let survivors = scores.iter().flatten().count();
            FAILURES_LAST.check(|| match chosen.iter().find(|&&index| survivors > 0 && scores[index].is_none()) {
                Some(index) => Err(format!("index {index}, a failure, from {name} with {survivors} survivors")),
                None => Ok(()),
            })?;
            DETERMINISTIC.check(|| {
                draw(&some(&[1.0, 2.0]), 3, 1);
                match draw(scores, count, 0) {
                    again if again == chosen => Ok(()),
                    again => Err(format!("{again:?} the second time, {chosen:?} the first, from {name}")),
                }
            })?;
            APPENDS.check(|| {
                let before = [usize::MAX, 0, 1];
                let mut found = before.to_vec();
                selector.select(scores, count, &mut seed.individual(0).stream(CHECK), &mut found);
                match found.strip_prefix(&before) {
                    Some(rest) if rest == chosen => Ok(()),
                    _ => Err(format!("{before:?} became {found:?}, the choice from nothing was {chosen:?}")),
                }
            })?;
        }
    }
    PREFERS_BETTER.check(|| {
        for scores in [some(&[0.3, 4.0, 1.0, 2.5, 0.0]), some(&[-1.0, -30.0, 2.0, -4.0]), some(&[1e300, -1e300, 0.0])] {
            let mut tally = vec![0_u32; scores.len()];
            (0..400).flat_map(|place| draw(&scores, 50, place)).for_each(|index| tally[index] += 1);
            let mut order: Vec<usize> = (0..scores.len()).collect();
            order.sort_by_key(|&index| scores[index]);
            for pair in order.windows(2) {
                let (worse, better) = (tally[pair[0]], tally[pair[1]]);
                // The difference of two counts has about the variance of their sum.
                let tolerance = 5.0 * f64::from(worse + better).sqrt();
                if f64::from(better) + tolerance < f64::from(worse) {
                    let fitness = |index: usize| scores[index].map_or(f64::NAN, Fitness::get);
                    let (low, high) = (fitness(pair[0]), fitness(pair[1]));
                    return Err(format!("of 20,000 draws fitness {high} got {better}, the worse {low} got {worse}"));
                }
            }
        }
        Ok(())
    })
}

fn some(values: &[f64]) -> Vec<Option<Fitness>> {
    values.iter().map(|&value| Fitness::new(value).ok()).collect()
}

/// Lists of scores with their names; what is not finite is a failure.
fn score_lists() -> Vec<(&'static str, Vec<Option<Fitness>>)> {
    const FAILED: f64 = f64::NAN;
    vec![
        ("no scores", some(&[])),
        ("a single score", some(&[1.0])),
        ("a single failure", some(&[FAILED])),
        ("ordinary scores", some(&[0.5, 3.0, 2.0, 0.1, 2.0])),
        ("equal scores", some(&[2.0; 6])),
        ("zeros", some(&[0.0; 4])),
        ("negative scores", some(&[-3.0, -1.0, -2.0])),
        ("scores of both signs", some(&[-3.0, 1.0, 0.0, 2.0])),
        ("huge scores", some(&[1e300, -1e300, 5e299, f64::MAX, f64::MIN])),
        ("tiny scores", some(&[1e-300, f64::MIN_POSITIVE, 5e-324, 0.0])),
        ("one above many", some(&[0.0, 0.0, 1e300, 0.0])),
        ("scores and failures", some(&[FAILED, 1.0, FAILED, 2.0, FAILED])),
        ("negative scores and failures", some(&[-5.0, FAILED, -5.0, FAILED])),
        ("zeros and failures", some(&[FAILED, 0.0, FAILED])),
        ("tiny scores and failures", some(&[FAILED, 5e-324, FAILED, 0.0])),
        ("huge scores and failures", some(&[FAILED, f64::MAX, f64::MIN])),
        ("failures alone", some(&[FAILED; 5])),
    ]
}
