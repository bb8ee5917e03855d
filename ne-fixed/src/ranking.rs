use ne_core::Fitness;
use std::cmp::Reverse;

/// The indices of all individuals, best first: failed ones last, of equals those with the lower index first.
pub(crate) fn best_first(scores: &[Option<Fitness>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_unstable_by_key(|&index| (Reverse(scores[index]), index));
    order
}
