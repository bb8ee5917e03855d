//! Numbers and their ranges.

use crate::{Bounds, Problem};

/// Checks one number.
pub(super) fn check(path: impl FnOnce() -> String, found: f32, bounds: Bounds, problems: &mut Vec<Problem>) -> bool {
    if !found.is_finite() {
        problems.push(Problem::NotFinite { path: path(), found });
    } else if !bounds.contains(found) {
        let Bounds { min, max, unit } = bounds;
        problems.push(Problem::OutOfRange { path: path(), found, min, max, unit });
    } else {
        return true;
    }
    false
}

/// Checks both numbers of a pair.
pub(super) fn check_pair(path: &str, pair: [f32; 2], bounds: Bounds, problems: &mut Vec<Problem>) -> bool {
    let mut good = true;
    for (index, found) in pair.into_iter().enumerate() {
        good &= check(|| format!("{path}[{index}]"), found, bounds, problems);
    }
    good
}

/// Checks the length of a list.
pub(super) fn check_count(
    path: impl FnOnce() -> String,
    what: &'static str,
    count: usize,
    (fewest, most): (usize, usize),
    problems: &mut Vec<Problem>,
) -> bool {
    let good = (fewest..=most).contains(&count);
    if !good {
        problems.push(Problem::Count { path: path(), what, fewest, most, count });
    }
    good
}
