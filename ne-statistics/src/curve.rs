use crate::sample::{LARGEST, is_usable};

/// The score of one run, as a step function of what was spent: evaluations, steps or hours.
///
/// The curve holds a point for each change and the end of the run. It mostly rises. It falls where a champion is replaced by
/// one that is better in another respect, such as a gait that is usable. Before its first point nothing has a score yet,
/// after its end nothing is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    points: Vec<(f64, f64)>,
    end: f64,
}

/// The error of [`Curve::new`]. Points are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// A coordinate is NaN, infinite or too large.
    #[error("point {point} is ({x}, {y}): must be finite numbers, at most {LARGEST:e} in size")]
    Value {
        /// Which point.
        point: usize,
        /// What was spent.
        x: f64,
        /// The score.
        y: f64,
    },
    /// A point does not lie after the one before it.
    #[error("point {point}: x = {x} must be above {before}, that of the point before")]
    Order {
        /// Which point.
        point: usize,
        /// Where it lies.
        x: f64,
        /// Where the point before it lies.
        before: f64,
    },
    /// The end lies before the last point, or is not finite or too large.
    #[error("end = {end}: must be a finite number, at most {LARGEST:e} in size and not before the last point")]
    End {
        /// The end found.
        end: f64,
    },
}

impl Curve {
    /// The curve through `points` (what was spent, score from there on), observed until `end`.
    ///
    /// No points at all are a run in which every evaluation failed.
    ///
    /// # Errors
    /// [`CurveError`] if the points do not rise strictly in x, or lie after the end, or a number is not finite
    /// or larger than [`LARGEST`] in size.
    pub fn new(points: Vec<(f64, f64)>, end: f64) -> Result<Self, CurveError> {
        for (point, &(x, y)) in points.iter().enumerate() {
            if !(is_usable(x) && is_usable(y)) {
                return Err(CurveError::Value { point, x, y });
            }
        }
        for (index, pair) in points.windows(2).enumerate() {
            let (point, before, after) = (index + 1, pair[0], pair[1]);
            if after.0 <= before.0 {
                return Err(CurveError::Order { point, x: after.0, before: before.0 });
            }
        }
        if !is_usable(end) || points.last().is_some_and(|last| end < last.0) {
            return Err(CurveError::End { end });
        }
        Ok(Self { points, end })
    }

    /// Until where the run was observed.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// The score when `x` was spent; `None` before the first point and after the end.
    pub fn value_at(&self, x: f64) -> Option<f64> {
        let points = self.points.partition_point(|point| point.0 <= x);
        if x <= self.end { Some(self.points[..points].last()?.1) } else { None }
    }

    /// What was spent when the score first was at least `threshold`; `None` if that did not happen until the end.
    pub fn first_reaching(&self, threshold: f64) -> Option<f64> {
        self.points.iter().find(|point| point.1 >= threshold).map(|point| point.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    #[test]
    fn is_a_step_function_until_its_end() {
        let curve = Curve::new(vec![(10.0, 1.0), (20.0, 1.0), (30.0, 5.0), (35.0, 4.0)], 40.0).expect("a valid curve");
        let values = [9.0, 10.0, 29.0, 30.0, 40.0, 41.0, f64::NAN].map(|x| curve.value_at(x));
        assert_eq!(values, [None, Some(1.0), Some(1.0), Some(5.0), Some(4.0), None, None]);
        let reached = [0.0, 1.0, 1.5, 5.0, 5.1, f64::NAN].map(|threshold| curve.first_reaching(threshold));
        assert_eq!(reached, [Some(10.0), Some(10.0), Some(30.0), Some(30.0), None, None]);
        let failed = Curve::new(vec![], 40.0).expect("a valid curve");
        assert_eq!((failed.value_at(20.0), failed.first_reaching(-1e9), failed.end()), (None, None, 40.0));
    }

    #[test]
    fn errors_name_the_point() {
        let message = |points: &[(f64, f64)], end| Curve::new(points.to_vec(), end).expect_err("no curve").to_string();
        assert_eq!(
            message(&[(0.0, 1.0), (1.0, f64::NAN)], 2.0),
            "point 1 is (1, NaN): must be finite numbers, at most 1e300 in size"
        );
        assert_eq!(message(&[(0.0, 1.0), (0.0, 2.0)], 2.0), "point 1: x = 0 must be above 0, that of the point before");
        for end in [0.5, f64::NAN, f64::INFINITY] {
            assert_eq!(
                message(&[(1.0, 1.0)], end),
                format!("end = {end}: must be a finite number, at most 1e300 in size and not before the last point")
            );
        }
    }

    proptest! {
        /// Before the threshold is reached a curve that rises is below it, from there on it is not.
        #[test]
        fn reaching_and_value_agree(rises in vec((1..9i32, 0..9i32), 1..10), threshold in 0..40i32) {
            let threshold = f64::from(threshold);
            let (mut x, mut y) = (0, 0);
            let mut points = vec![];
            for (step, rise) in rises {
                (x, y) = (x + step, y + rise);
                points.push((f64::from(x), f64::from(y)));
            }
            let curve = Curve::new(points, f64::from(x + 3)).expect("a valid curve");
            let reached = curve.first_reaching(threshold).unwrap_or(f64::INFINITY);
            for x in (0..=x + 3).map(f64::from) {
                let is_reached = curve.value_at(x).is_some_and(|value| value >= threshold);
                prop_assert_eq!(is_reached, x >= reached);
            }
        }
    }
}
