use crate::{
    Curve,
    quantile::{quantile_of_sorted, sorted},
};
use serde::{Deserialize, Serialize};

/// The median and the quartiles of several runs at one point of their curves, with linear interpolation between
/// neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quartiles {
    /// A quarter of the runs are at most this.
    pub lower: f64,
    /// Half of the runs are at most this.
    pub median: f64,
    /// Three quarters of the runs are at most this.
    pub upper: f64,
}

/// The median and the quartiles of the runs' best scores at each x of `grid`: what to draw for a method.
///
/// `None` where a run has no score: before its first point or after its end. The quartiles of those that are left would
/// compare some runs here and others there. Without curves all are `None`.
pub fn pointwise_quartiles(curves: &[Curve], grid: &[f64]) -> Vec<Option<Quartiles>> {
    grid.iter().map(|&x| quartiles_at(curves, x)).collect()
}

fn quartiles_at(curves: &[Curve], x: f64) -> Option<Quartiles> {
    let values: Vec<f64> = curves.iter().map(|curve| curve.value_at(x)).collect::<Option<_>>()?;
    if values.is_empty() {
        return None;
    }
    let [lower, median, upper] = [0.25, 0.5, 0.75].map(|share| quantile_of_sorted(&sorted(&values), share));
    Some(Quartiles { lower, median, upper })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    fn curve(points: &[(f64, f64)], end: f64) -> Curve {
        Curve::new(points.to_vec(), end).expect("a valid curve")
    }

    #[test]
    fn are_taken_where_all_runs_have_a_score() {
        let curves = [
            curve(&[(1.0, 0.0), (3.0, 6.0)], 9.0),
            curve(&[(2.0, 2.0)], 5.0),
            curve(&[(1.0, 1.0), (2.0, 3.0), (5.0, 4.0)], 9.0),
        ];
        let quartiles = |lower, median, upper| Some(Quartiles { lower, median, upper });
        assert_eq!(
            pointwise_quartiles(&curves, &[1.0, 2.0, 3.0, 5.0, 6.0]),
            [None, quartiles(1.0, 2.0, 2.5), quartiles(2.5, 3.0, 4.5), quartiles(3.0, 4.0, 5.0), None]
        );
        assert_eq!(pointwise_quartiles(&[], &[1.0]), [None]);
    }

    #[test]
    fn survive_a_file() {
        let quartiles = Quartiles { lower: 1.0, median: 2.0, upper: 2.5 };
        let text = serde_json::to_string(&quartiles).expect("serialises");
        assert_eq!(text, r#"{"lower":1.0,"median":2.0,"upper":2.5}"#);
        assert_eq!(serde_json::from_str::<Quartiles>(&text).expect("deserialises"), quartiles);
    }

    proptest! {
        /// Each run only gets better, so the quartiles do, and they stand in order.
        #[test]
        fn rise_and_stand_in_order(rises in vec(vec(0..9i32, 5), 1..8)) {
            let rising = |rises: &Vec<i32>| {
                let mut best = 0;
                let points = rises.iter().enumerate().map(|(x, rise)| {
                    best += rise;
                    (x as f64, f64::from(best))
                });
                Curve::new(points.collect(), 4.0).expect("a valid curve")
            };
            let curves: Vec<Curve> = rises.iter().map(rising).collect();
            let grid = [0.0, 0.5, 1.0, 2.0, 3.0, 4.0];
            let quartiles: Option<Vec<Quartiles>> = pointwise_quartiles(&curves, &grid).into_iter().collect();
            let quartiles = quartiles.expect("every run has a score from 0 to 4");
            prop_assert!(quartiles.iter().all(|at| at.lower <= at.median && at.median <= at.upper));
            for of in [|at: &Quartiles| at.lower, |at: &Quartiles| at.median, |at: &Quartiles| at.upper] {
                prop_assert!(quartiles.is_sorted_by_key(of));
            }
        }
    }
}
