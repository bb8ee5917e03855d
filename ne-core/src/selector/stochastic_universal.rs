use super::{Roulette, Selector};
use crate::{Fitness, RandomStream};
use rand::{RngExt, seq::SliceRandom};
use serde::{Deserialize, Serialize};

/// Stochastic universal sampling: one spin of the [`Roulette`] wheel under as many evenly spaced pointers as parents
/// are wanted.
///
/// Each parent is chosen at least ⌊e⌋ and at most ⌈e⌉ times, where e is its expected number: the least spread a
/// proportionate selection can have. The chosen are shuffled, since neighbours mate. Widths of slots, negative
/// fitnesses and failures as in [`Roulette`].
///
/// Source: Baker, *Reducing Bias and Inefficiency in the Selection Algorithm*, ICGA 1987.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct StochasticUniversal {}

impl Selector for StochasticUniversal {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        if scores.is_empty() || count == 0 {
            return;
        }
        let wheel = Roulette::wheel(scores);
        let distance = wheel.circumference() / count as f64;
        let offset: f64 = stream.random();
        let first = chosen.len();
        chosen.extend((0..count).map(|pointer| wheel.slot((pointer as f64 + offset) * distance)));
        chosen[first..].shuffle(stream);
    }
}
