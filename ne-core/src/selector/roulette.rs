use super::{Selector, Wheel};
use crate::{Fitness, RandomStream};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Fitness-proportionate selection: each parent's chance is its share of the total fitness.
///
/// A wheel cannot have slots of negative width. If any fitness is negative, the lowest fitness is subtracted from all
/// of them (windowing): the worst then has no chance, and adding a constant to every fitness changes nothing. Without
/// negative fitnesses the wheel is the textbook one. If every width is zero the choice is uniform. Failures have width
/// zero, unless all failed.
///
/// Source: Holland, *Adaptation in Natural and Artificial Systems*, 1975; Goldberg, *Genetic Algorithms*, 1989.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Roulette {}

impl Roulette {
    /// The wheel of these scores.
    pub(super) fn wheel(scores: &[Option<Fitness>]) -> Wheel {
        let lowest = scores.iter().flatten().min().map_or(0.0, |fitness| fitness.get().min(0.0));
        let highest = scores.iter().flatten().max().map_or(0.0, |fitness| fitness.get());
        // Scaled to at most 1, so that no sum overflows; halved first where a difference would (only there: halving the
        // smallest numbers gives zero).
        let half = if (highest - lowest).is_finite() { 1.0 } else { 0.5 };
        let span = highest * half - lowest * half;
        let weight = move |fitness: Fitness| (fitness.get() * half - lowest * half) / span;
        if highest == lowest {
            // All survivors equal (then zero or negative): equal chances among them, none for failures.
            return Wheel::new(scores.iter().map(|score| f64::from(u8::from(score.is_some()))));
        }
        Wheel::new(scores.iter().map(move |score| score.map_or(0.0, weight)))
    }
}

impl Selector for Roulette {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        if scores.is_empty() {
            return;
        }
        let wheel = Self::wheel(scores);
        chosen.extend((0..count).map(|_| wheel.slot(stream.random::<f64>() * wheel.circumference())));
    }
}
