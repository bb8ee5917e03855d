//! Parent selection: the contract and five selectors.

#[cfg(feature = "selection")]
mod rank;
#[cfg(feature = "selection")]
mod roulette;
#[cfg(feature = "selection")]
mod selection;
#[cfg(feature = "selection")]
mod stochastic_universal;
#[cfg(feature = "selection")]
mod tournament;
#[cfg(feature = "selection")]
mod truncation;

#[cfg(feature = "selection")]
pub use {
    rank::RankSelector, roulette::Roulette, selection::Selection, stochastic_universal::StochasticUniversal,
    tournament::Tournament, truncation::Truncation,
};

use crate::{Fitness, RandomStream};

/// Picks parents by their scores.
///
/// An implementor owes:
/// - exactly `count` indices are appended to `chosen`, each below `scores.len()`; none if `scores` is empty;
/// - `None` (a failed evaluation) is chosen only when there is nothing else;
/// - the choice depends on the scores and the stream alone.
///
/// Check yours with `check_selector` of the [conformance kit](crate::conformance).
pub trait Selector: Send + Sync {
    /// Appends the indices of `count` parents to `chosen`, with repetition.
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>);
}

/// The indices of the scores from worst to best: failures first, equals in order of index.
#[cfg(feature = "selection")]
fn ascending(scores: &[Option<Fitness>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by_key(|&index| scores[index]);
    order
}

/// A wheel with one slot for each score, as wide as its weight: what roulette, rank and stochastic universal sampling
/// spin.
#[cfg(feature = "selection")]
struct Wheel {
    /// The right edge of each slot; the last is the circumference.
    edges: Vec<f64>,
}

#[cfg(feature = "selection")]
impl Wheel {
    /// Slots as wide as `weights`, which must be finite and not negative; if all are zero every slot is equally wide.
    fn new(weights: impl Iterator<Item = f64> + Clone) -> Self {
        let even = weights.clone().all(|weight| weight == 0.0);
        let edges = weights
            .scan(0.0, |edge, weight| {
                *edge += if even { 1.0 } else { weight };
                Some(*edge)
            })
            .collect();
        Self { edges }
    }

    fn circumference(&self) -> f64 {
        self.edges.last().copied().unwrap_or(0.0)
    }

    /// The slot at `position`, which lies from 0 (included) to the circumference (excluded).
    fn slot(&self, position: f64) -> usize {
        let index = self.edges.partition_point(|&edge| edge <= position);
        // Rounding may put the position on the last edge; the last slot that has a width is meant.
        if index < self.edges.len() { index } else { self.edges.partition_point(|&edge| edge < self.circumference()) }
    }
}
