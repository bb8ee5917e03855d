//! Cheaper evaluations before the whole one, of which only the best individuals get it.

use crate::{Evaluation, Evaluator, Failure, Fitness, Genome, Seed, Task, share_rounded_up};
use std::{cmp::Reverse, fmt, sync::Arc};

/// Spends the whole evaluation on the promising individuals: all are evaluated on a cheaper task first, and only the
/// best go on to the next rung, or to the task itself.
///
/// This is successive halving (Karnin, Koren & Somekh 2013; Jamieson & Talwalkar 2016) within a generation, with a share
/// and a task of your own for each rung.
///
/// - An individual that reaches the end has the evaluation that the inner evaluator gives.
/// - An individual that is left behind keeps the evaluation of the last rung it ran. If the best of those left behind
///   in a rung has not less fitness than the lowest of those that went on, the fitness of all that were left behind
///   there is lowered by the same amount, so that it has. Their order stays, and so do their differences, as far as
///   `f64` can tell. Each of several objectives is lowered in the same way, so that each individual that went on
///   [dominates](crate::pareto::dominates) all that were left behind: a cheaper evaluation may cost less energy, for one. Measurements
///   stay as they are.
/// - A failed evaluation ranks lowest, and of equals the first goes on first.
/// - If all individuals that went on have failed, as many of the next in rank go on too, until one succeeds or all have
///   been evaluated whole. So the best of a generation is never an individual that was left behind.
/// - The steps of an evaluation are those of all the rungs its individual ran.
///
/// Without rungs it is the inner evaluator.
#[derive(Clone, Debug)]
pub struct SuccessiveHalving<E> {
    inner: E,
    rungs: Arc<[Rung]>,
}

/// A cheaper evaluation that comes before the whole one.
pub struct Rung {
    /// What is evaluated in this rung, for phenotypes of the same shape.
    pub task: Box<dyn Task>,
    /// The share of the individuals of this rung that goes on, above 0 and below 1; rounded up, and at least one.
    pub share: f64,
}

impl fmt::Debug for Rung {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Rung").field("share", &self.share).finish_non_exhaustive()
    }
}

impl<E> SuccessiveHalving<E> {
    /// Evaluates in these rungs, the first one first. Shares are used as they are.
    pub fn new(inner: E, rungs: Vec<Rung>) -> Self {
        Self { inner, rungs: rungs.into() }
    }

    /// The rungs, the first one first.
    pub fn rungs(&self) -> &[Rung] {
        &self.rungs
    }

    /// In the same rungs, with another inner evaluator.
    pub fn with_inner<F>(&self, inner: F) -> SuccessiveHalving<F> {
        SuccessiveHalving { inner, rungs: Arc::clone(&self.rungs) }
    }
}

impl<E: Evaluator> Evaluator for SuccessiveHalving<E> {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        self.evaluate_from(&self.rungs, task, genomes, seed)
    }
}

impl<E: Evaluator> SuccessiveHalving<E> {
    /// Evaluates these genomes in these rungs, and those that get so far on the task. Either one of them succeeds
    /// there, or all have failed there.
    fn evaluate_from<G: Genome>(&self, rungs: &[Rung], task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        let Some((rung, later)) = rungs.split_first() else { return self.inner.evaluate(task, genomes, seed) };
        let mut evaluations = self.inner.evaluate(&*rung.task, genomes, seed);
        if evaluations.len() != genomes.len() {
            // It is unknown which evaluation belongs to which genome; the caller sees that some are missing.
            return Vec::new();
        }
        let (ranking, places) = (ranking(&evaluations), places(rung.share, genomes.len()));
        let mut behind = &ranking[..];
        let mut lowest = Vec::new();
        while lowest.is_empty() && !behind.is_empty() {
            let (group, next) = behind.split_at(places.min(behind.len()));
            behind = next;
            // In the order of the generation again, so that of equals the first goes on first in the next rung too.
            let mut group = group.to_vec();
            group.sort_unstable();
            let promoted: Vec<G> = group.iter().map(|&index| genomes[index].clone()).collect();
            let further = self.evaluate_from(later, task, &promoted, seed);
            if further.len() != group.len() {
                return Vec::new();
            }
            lowest = lowest_of(&further);
            for (&index, evaluation) in group.iter().zip(further) {
                let steps = evaluations[index].steps + evaluation.steps;
                evaluations[index] = evaluation.with_steps(steps);
            }
        }
        put_below(&lowest, behind, &mut evaluations);
        evaluations
    }
}

/// How many of `count` go on: this share of them, rounded up, and at least one.
fn places(share: f64, count: usize) -> usize {
    share_rounded_up(share, count).clamp(1, count.max(1))
}

/// The indices of all, the best first, of equals the first; failures last.
fn ranking(evaluations: &[Evaluation]) -> Vec<usize> {
    let mut ranking: Vec<usize> = (0..evaluations.len()).collect();
    // A stable sort leaves equals in their order.
    ranking.sort_by_key(|&index| Reverse(evaluations[index].fitness()));
    ranking
}

/// The fitness, in place 0, or an objective, in the places after it; `None` if the evaluation failed or the objective is not finite.
fn value(evaluation: &Evaluation, place: usize) -> Option<f64> {
    let fitness = evaluation.fitness()?.get();
    match place.checked_sub(1) {
        None => Some(fitness),
        Some(objective) => evaluation.objectives.get(objective).copied().filter(|value| value.is_finite()),
    }
}

/// The lowest fitness, and the lowest of each objective; empty if all have failed.
fn lowest_of(evaluations: &[Evaluation]) -> Vec<f64> {
    let lowest = |place| evaluations.iter().filter_map(|evaluation| value(evaluation, place)).min_by(f64::total_cmp);
    (0..).map_while(lowest).collect()
}

/// Lowers fitness and objectives of the individuals left behind, each by one constant, so that the best of them is strictly below
/// the lowest of those that went on. Those that have failed are below already.
fn put_below(lowest: &[f64], behind: &[usize], evaluations: &mut [Evaluation]) {
    for (place, &lowest) in lowest.iter().enumerate() {
        let (indices, found): (Vec<usize>, Vec<f64>) =
            behind.iter().filter_map(|&index| Some((index, value(&evaluations[index], place)?))).unzip();
        for (index, lowered) in indices.into_iter().zip(lowered(lowest, &found)) {
            let evaluation = &mut evaluations[index];
            match (lowered.and_then(|value| Fitness::new(value).ok()), place.checked_sub(1)) {
                (Some(fitness), None) => evaluation.outcome = Ok(fitness),
                (Some(value), Some(objective)) => evaluation.objectives[objective] = value.get(),
                (None, _) => {
                    let what = "left behind in a rung, where no number is low enough".into();
                    evaluation.outcome = Err(Failure::Other { what });
                }
            }
        }
    }
}

/// These values lowered by one constant, so that the greatest is strictly below `lowest`; as they are if it is so already.
///
/// Where rounding would make two different ones equal, the lower one goes down to the next number. Below the lowest number of all
/// there is none.
fn lowered(lowest: f64, values: &[f64]) -> Vec<Option<f64>> {
    let best = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if best < lowest {
        return values.iter().copied().map(Some).collect();
    }
    let mut falling: Vec<usize> = (0..values.len()).collect();
    falling.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    let top = lowest.next_down();
    let (mut above, mut found) = ((best, top), vec![None; values.len()]);
    for index in falling {
        let value = values[index];
        if value < above.0 {
            // In this order the differences are exact wherever they can be, and the best comes to `top` itself.
            let lowered = ((value - best) + top).max(f64::MIN);
            above = (value, lowered.min(above.1.next_down()));
        }
        found[index] = Some(above.1).filter(|lowered| lowered.is_finite());
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{num, prelude::*};

    fn fitnesses(evaluations: &[Evaluation]) -> Vec<Option<f64>> {
        evaluations.iter().map(|evaluation| evaluation.fitness().map(Fitness::get)).collect()
    }

    fn below(lowest: f64, fitness: &[f64]) -> Vec<Option<f64>> {
        let mut evaluations: Vec<Evaluation> = fitness.iter().map(|&fitness| Evaluation::new(fitness)).collect();
        let ranked = ranking(&evaluations);
        put_below(&[lowest], &ranked, &mut evaluations);
        fitnesses(&evaluations)
    }

    fn with_objectives(fitness: f64, objectives: &[f64]) -> Evaluation {
        Evaluation { objectives: objectives.to_vec(), ..Evaluation::new(fitness) }
    }

    /// A shorter run needs less energy: in the second objective all that were left behind were better.
    #[test]
    fn those_left_behind_are_dominated_by_all_that_went_on() {
        let whole = [with_objectives(9.0, &[9.0, -40.0]), with_objectives(7.0, &[7.0, -50.0])];
        let left = [with_objectives(4.0, &[4.0, -3.0]), with_objectives(3.0, &[3.0, -1.0]), Evaluation::new(f64::NAN)];
        let mut all = left.to_vec();
        put_below(&lowest_of(&whole), &[0, 1, 2], &mut all);
        let top = (-50.0_f64).next_down();
        assert_eq!(all[..2], [with_objectives(4.0, &[4.0, top - 2.0]), with_objectives(3.0, &[3.0, top])]);
        assert_eq!(all[2].fitness(), None);
        let objectives = |evaluation: &Evaluation| evaluation.objectives().expect("finite");
        for (one, other) in whole.iter().flat_map(|one| all[..2].iter().map(move |other| (one, other))) {
            assert!(crate::pareto::dominates(Some(&objectives(one)), Some(&objectives(other))));
        }
        let mut impossible = left.to_vec();
        put_below(&[7.0, 7.0, f64::MIN], &[0, 1, 2], &mut impossible);
        assert!(impossible.iter().all(|evaluation| evaluation.objectives().is_none()), "{impossible:?}");
    }

    #[test]
    fn a_fitness_that_is_below_already_stays_where_it_is() {
        assert_eq!(below(3.0, &[1.0, f64::NAN, 2.5, 1.0]), [Some(1.0), None, Some(2.5), Some(1.0)]);
    }

    #[test]
    fn all_are_lowered_alike() {
        let top = 2.0_f64.next_down();
        assert_eq!(below(2.0, &[4.0, 8.0, f64::NAN, 8.0]), [Some(top - 4.0), Some(top), None, Some(top)]);
        assert_eq!(below(2.0, &[2.0]), [Some(top)]);
        assert_eq!(below(0.0, &[0.0, -1.0]), [Some(0.0_f64.next_down()), Some(-1.0 + 0.0_f64.next_down())]);
    }

    #[test]
    fn the_order_survives_where_differences_do_not() {
        // At 10¹⁵ neighbours are 0.125 apart.
        let found = below(-1e15, &[0.3, 0.29, 0.29, 0.28]);
        let top = (-1e15_f64).next_down();
        assert_eq!(found, [Some(top), Some(top - 0.125), Some(top - 0.125), Some(top - 0.25)]);
        assert_eq!(below(-1e308, &[1e308, -1e308])[1], Some(f64::MIN));
        // Below the lowest number there is none.
        assert_eq!(below(f64::MIN.next_up(), &[2.0, 1.0, 2.0]), [Some(f64::MIN), None, Some(f64::MIN)]);
        assert_eq!(below(f64::MIN, &[1.0]), [None]);
    }

    #[test]
    fn shares_are_rounded_up_and_never_zero() {
        for (share, count, expected) in
            [(0.5, 10, 5), (0.5, 11, 6), (0.07, 100, 7), (0.55, 100, 55), (0.01, 3, 1), (0.99, 3, 3), (0.5, 1, 1)]
        {
            assert_eq!(places(share, count), expected, "{share} of {count}");
        }
    }

    proptest! {
        #[test]
        fn strictly_below_and_in_order_whatever_the_numbers(
            lowest in num::f64::NORMAL | num::f64::SUBNORMAL | num::f64::ZERO,
            left in prop::collection::vec(
                prop_oneof![num::f64::NORMAL | num::f64::SUBNORMAL | num::f64::ZERO, (-3..3).prop_map(f64::from)], 1..12),
        ) {
            let found = below(lowest, &left);
            for (old, new) in left.iter().zip(&found) {
                prop_assert!(new.is_none_or(|new| new < lowest));
                for (other, others) in left.iter().zip(&found) {
                    // Individuals without a number low enough are all failures.
                    prop_assert!(new.partial_cmp(others) == old.partial_cmp(other) || (*new, *others) == (None, None));
                }
            }
            // Room there is for all but the most extreme.
            prop_assert!(lowest < -1e300 || found.iter().all(Option::is_some));
        }

        #[test]
        fn differences_are_kept(lowest in -100.0..100.0_f64, left in prop::collection::vec(-100.0..100.0_f64, 1..12)) {
            let found = below(lowest, &left);
            for (old, new) in left.iter().zip(&found) {
                let (first, firsts) = (left[0], found[0].expect("room"));
                prop_assert!(((new.expect("room") - firsts) - (old - first)).abs() < 1e-12);
            }
        }
    }
}
