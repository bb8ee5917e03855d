//! Comparing by several objectives at once: domination, fronts, crowding, hypervolume.
//!
//! All objectives are maximised. A point is what an evaluation came to in each of them, or `None` if it failed; every
//! point dominates a failed one, so failures come last without being a special case. A [`Fitness`] cannot be NaN, and
//! so no comparison is undecided.
//!
//! Source, unless a function names another: Deb, Pratap, Agarwal & Meyarivan, *A Fast and Elitist Multiobjective
//! Genetic Algorithm: NSGA-II*, IEEE Transactions on Evolutionary Computation 6(2), 2002, sections III.A and III.B.
//!
//! ```
//! use ne_core::{Fitness, pareto};
//! let vectors = [[3.0, 0.0], [1.0, 1.0], [0.0, 3.0], [0.0, 0.5]].map(|values| values.map(|v| Fitness::new(v).unwrap()));
//! let points: Vec<pareto::Point> = vectors.iter().map(|vector| Some(&vector[..])).chain([None]).collect();
//! assert_eq!(pareto::fronts(&points), [vec![0, 1, 2], vec![3], vec![4]]);
//! ```

use crate::Fitness;
use std::cmp::Ordering;

/// One value for each objective, or `None` for a failed evaluation. All points of a set have as many values.
pub type Point<'a> = Option<&'a [Fitness]>;

/// Whether `one` is at least as good in every objective and better in one.
pub fn dominates(one: Point<'_>, other: Point<'_>) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => {
            let mut pairs = one.iter().zip(other);
            pairs.clone().all(|(one, other)| one >= other) && pairs.any(|(one, other)| one > other)
        }
        (one, other) => one.is_some() && other.is_none(),
    }
}

/// Sorts points into fronts: the first holds those that none dominates, the next those that only points of the fronts
/// before dominate, and so on. Gives the indices of each front, in ascending order; failed points are the last front.
///
/// The fast non-dominated sort, in O(M N²) comparisons of N points with M objectives. Dominance is computed again
/// rather than remembered, so that memory stays in O(N).
pub fn fronts(points: &[Point<'_>]) -> Vec<Vec<usize>> {
    let dominators = |&point: &Point<'_>| points.iter().filter(|&&other| dominates(other, point)).count();
    // Of those in no front yet: how many others in no front yet dominate each.
    let mut left: Vec<(usize, usize)> = points.iter().map(dominators).enumerate().collect();
    let mut fronts = Vec::new();
    while !left.is_empty() {
        let (front, rest): (Vec<_>, Vec<_>) = left.into_iter().partition(|&(_, dominators)| dominators == 0);
        let front: Vec<usize> = front.into_iter().map(|(index, _)| index).collect();
        left = rest;
        for (index, dominators) in &mut left {
            *dominators -= front.iter().filter(|&&member| dominates(points[member], points[*index])).count();
        }
        fronts.push(front);
    }
    fronts
}

/// How much room each member of a front has to itself: for each objective the distance between its neighbours, as a
/// share of the front's range, summed; infinite at the ends of an objective. In the order of `front`.
///
/// Of members with equal values only the first counts; the others have distance 0, as failed points have. The paper
/// gives copies distances that depend on how they are sorted. Source: Fortin & Parizeau, *Revisiting the NSGA-II
/// Crowding-Distance Computation*, GECCO 2013.
///
/// # Panics
/// If an index is not one of `points`, or a point has fewer values than another.
pub fn crowding(points: &[Point<'_>], front: &[usize]) -> Vec<f64> {
    let mut distances = vec![0.0; front.len()];
    let mut members: Vec<(&[Fitness], usize)> =
        front.iter().enumerate().filter_map(|(place, &index)| Some((points[index]?, place))).collect();
    members.sort();
    members.dedup_by_key(|&mut (values, _)| values);
    let objectives = members.first().map_or(0, |(values, _)| values.len());
    for objective in 0..objectives {
        // Where an objective is equal the others decide, so that the order of the points does not count.
        members.sort_by_key(|&(values, place)| (values[objective], values, place));
        // Halves, since the difference of huge values would overflow.
        let half = |member: usize| 0.5 * members[member].0[objective].get();
        let last = members.len() - 1;
        let range = half(last) - half(0);
        distances[members[0].1] = f64::INFINITY;
        distances[members[last].1] = f64::INFINITY;
        for member in 1..last {
            if range > 0.0 {
                distances[members[member].1] += (half(member + 1) - half(member - 1)) / range;
            }
        }
    }
    distances
}

/// Where a point stands among others. The greater is the better: first by front, then by crowding distance (the paper's
/// crowded comparison).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rank {
    /// The number of its front, from 0.
    pub front: usize,
    /// Its [crowding] distance in that front; never NaN.
    pub crowding: f64,
}

impl Eq for Rank {}

impl Ord for Rank {
    fn cmp(&self, other: &Self) -> Ordering {
        other.front.cmp(&self.front).then(self.crowding.total_cmp(&other.crowding))
    }
}

impl PartialOrd for Rank {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Where each point stands among all of them.
pub fn ranks(points: &[Point<'_>]) -> Vec<Rank> {
    let mut ranks = vec![Rank { front: 0, crowding: 0.0 }; points.len()];
    for (number, front) in fronts(points).iter().enumerate() {
        for (&index, crowding) in front.iter().zip(crowding(points, front)) {
            ranks[index] = Rank { front: number, crowding };
        }
    }
    ranks
}

/// The area between a reference point and the points of two objectives that are better than it in both: the larger, the
/// better and the wider the front. At most `f64::MAX`; 0 for any other number of objectives.
///
/// Source: Zitzler & Thiele, *Multiobjective Evolutionary Algorithms: A Comparative Case Study and the Strength Pareto
/// Approach*, IEEE Transactions on Evolutionary Computation 3(4), 1999.
pub fn hypervolume(points: &[Point<'_>], reference: &[Fitness]) -> f64 {
    let &[left, bottom] = reference else { return 0.0 };
    let inside = |point: &Point<'_>| match *point {
        Some(&[x, y]) if x > left && y > bottom => Some((x, y)),
        _ => None,
    };
    let mut corners: Vec<(Fitness, Fitness)> = points.iter().filter_map(inside).collect();
    // From right to left; each adds what lies above the highest so far.
    corners.sort_unstable_by(|one, other| other.cmp(one));
    let (mut area, mut top) = (0.0, bottom);
    for (x, y) in corners {
        if y > top {
            area += (x.get() - left.get()) * (y.get() - top.get());
            top = y;
        }
    }
    f64::min(area, f64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Values = Option<Vec<Fitness>>;

    fn fitness(value: f64) -> Fitness {
        Fitness::new(value).expect("finite")
    }

    fn points(values: &[Values]) -> Vec<Point<'_>> {
        values.iter().map(Option::as_deref).collect()
    }

    /// Points of 1 to 4 objectives on a coarse grid, so that many are equal in something; some have failed.
    fn sets() -> impl Strategy<Value = Vec<Values>> {
        (1..5usize).prop_flat_map(|objectives| {
            let values = proptest::collection::vec((0..6i8).prop_map(|value| fitness(value.into())), objectives);
            proptest::collection::vec(proptest::option::weighted(0.9, values), 0..20)
        })
    }

    /// The definition: 0 if no point dominates it, else one more than the highest of those that do.
    fn front_by_definition(points: &[Point<'_>], index: usize) -> usize {
        let dominating = (0..points.len()).filter(|&other| dominates(points[other], points[index]));
        dominating.map(|other| front_by_definition(points, other) + 1).max().unwrap_or(0)
    }

    proptest! {
        #[test]
        fn domination_is_a_strict_order(set in sets()) {
            let points = points(&set);
            for &one in &points {
                prop_assert!(!dominates(one, one));
                for &other in &points {
                    prop_assert!(!(dominates(one, other) && dominates(other, one)));
                    for &third in &points {
                        prop_assert!(!dominates(one, other) || !dominates(other, third) || dominates(one, third));
                    }
                }
            }
        }

        #[test]
        fn fronts_are_those_of_the_definition(set in sets()) {
            let points = points(&set);
            let ranks = ranks(&points);
            for (index, rank) in ranks.iter().enumerate() {
                prop_assert_eq!(rank.front, front_by_definition(&points, index));
            }
            let fronts = fronts(&points);
            let mut all: Vec<usize> = fronts.iter().flatten().copied().collect();
            all.sort_unstable();
            prop_assert_eq!(all, (0..points.len()).collect::<Vec<_>>());
            for front in &fronts {
                prop_assert!(front.is_sorted());
                let among = |one: usize| front.iter().any(|&other| dominates(points[other], points[one]));
                prop_assert!(!front.iter().any(|&one| among(one)), "one of a front dominates another");
            }
        }

        #[test]
        fn failures_are_the_last_front(set in sets()) {
            let points = points(&set);
            let failed: Vec<usize> = (0..points.len()).filter(|&index| points[index].is_none()).collect();
            if !failed.is_empty() {
                prop_assert_eq!(fronts(&points).pop(), Some(failed));
            }
        }

        #[test]
        fn the_order_of_the_points_does_not_count(set in sets(), seed: u64) {
            let mut order: Vec<usize> = (0..set.len()).collect();
            order.sort_by_key(|&index| (index as u64 + 1).wrapping_mul(seed | 1));
            let shuffled: Vec<Values> = order.iter().map(|&index| set[index].clone()).collect();
            let known = |set: &[Values]| {
                let ranks = ranks(&points(set));
                // Which of equal points is the one that counts may change; how many there are may not.
                let mut all: Vec<_> = set.iter().cloned().zip(ranks).collect();
                all.sort();
                all
            };
            prop_assert_eq!(known(&set), known(&shuffled));
        }

        #[test]
        fn the_ends_of_every_objective_have_infinite_distance(set in sets()) {
            let points = points(&set);
            for front in fronts(&points) {
                let distances = crowding(&points, &front);
                prop_assert!(distances.iter().all(|&distance| distance >= 0.0));
                let values: Vec<&[Fitness]> = front.iter().filter_map(|&index| points[index]).collect();
                for objective in 0..values.first().map_or(0, |values| values.len()) {
                    let of_end = |end: Option<Fitness>| front.iter().zip(&distances).any(|(&index, &distance)| {
                        points[index].map(|values| values[objective]) == end && distance == f64::INFINITY
                    });
                    prop_assert!(of_end(values.iter().map(|values| values[objective]).min()));
                    prop_assert!(of_end(values.iter().map(|values| values[objective]).max()));
                }
            }
        }

        #[test]
        fn hypervolume_is_the_share_of_a_grid_that_is_dominated(set in proptest::collection::vec((0..8u8, 0..8u8), 0..12)) {
            let set: Vec<Values> =
                set.into_iter().map(|(x, y)| Some(vec![fitness(x.into()), fitness(y.into())])).collect();
            let reference = [fitness(2.0), fitness(1.0)];
            let covered = |x: u8, y: u8| set.iter().flatten().any(|point| {
                point[0] > fitness(x.into()) && point[1] > fitness(y.into())
            });
            let squares = (2..8).flat_map(|x| (1..8).map(move |y| (x, y))).filter(|&(x, y)| covered(x, y)).count();
            prop_assert_eq!(hypervolume(&points(&set), &reference), squares as f64);
        }
    }

    /// Worked by hand: (0, 4), (1, 3), (3, 1), (4, 0).
    #[test]
    fn crowding_is_the_room_between_neighbours() {
        let set = [[0.0, 4.0], [1.0, 3.0], [3.0, 1.0], [4.0, 0.0], [1.0, 3.0]].map(|v| Some(v.map(fitness).to_vec()));
        let distances = crowding(&points(&set), &[0, 1, 2, 3, 4]);
        assert_eq!(distances, [f64::INFINITY, 1.5, 1.5, f64::INFINITY, 0.0], "the copy has no room");
        let alone = crowding(&points(&set), &[2]);
        assert_eq!(alone, [f64::INFINITY]);
    }

    #[test]
    fn huge_values_give_numbers() {
        let set = [[f64::MAX, -f64::MAX], [0.0, 0.0], [-f64::MAX, f64::MAX]].map(|v| Some(v.map(fitness).to_vec()));
        let points = points(&set);
        assert_eq!(crowding(&points, &[0, 1, 2]), [f64::INFINITY, 2.0, f64::INFINITY]);
        assert_eq!(hypervolume(&points, &[fitness(-f64::MAX); 2]), f64::MAX);
    }

    #[test]
    fn a_front_is_better_than_a_later_one_and_room_better_than_none() {
        let rank = |front, crowding| Rank { front, crowding };
        assert!(rank(0, 0.0) > rank(1, f64::INFINITY));
        assert!(rank(1, f64::INFINITY) > rank(1, 3.0));
    }
}
