use crate::{Scores, ScoresError};
use serde::{Deserialize, Serialize};

/// Two scores of a task that fix its scale: a low one becomes 0, a high one 1.
///
/// For example what a creature earns that does not move, and what the best champion known earns. Both must be fixed
/// before the comparison, not taken from the scores that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// The score that becomes 0.
    pub low: f64,
    /// The score that becomes 1; above `low`.
    pub high: f64,
}

/// The error of [`normalize`]. Tasks are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NormalizationError {
    /// Not one reference for each task.
    #[error("{references} references for {tasks} tasks: each task needs one")]
    Count {
        /// How many references there are.
        references: usize,
        /// How many tasks there are.
        tasks: usize,
    },
    /// A reference whose ends are not finite or not in order.
    #[error("reference of task {task}: low {low} and high {high} must be finite numbers, low below high")]
    Reference {
        /// Which task.
        task: usize,
        /// The low end.
        low: f64,
        /// The high end.
        high: f64,
    },
    /// The normalised scores are too large.
    #[error("normalised scores: {0}")]
    Scores(#[from] ScoresError),
}

/// Brings the scores of all tasks to one scale, for tasks have different units: (score − low) / (high − low), with the
/// reference of each task.
///
/// Scores are not clipped: below `low` they are negative, above `high` larger than 1.
///
/// # Errors
/// [`NormalizationError`] if there is not one reference for each task, a reference's ends are not finite or not in
/// order, or a normalised score would be larger than [`LARGEST`](crate::LARGEST) in size.
pub fn normalize(scores: &Scores, references: &[Reference]) -> Result<Scores, NormalizationError> {
    if references.len() != scores.tasks() {
        return Err(NormalizationError::Count { references: references.len(), tasks: scores.tasks() });
    }
    for (task, &Reference { low, high }) in references.iter().enumerate() {
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(NormalizationError::Reference { task, low, high });
        }
    }
    let rows: Vec<Vec<f64>> = scores
        .rows()
        .zip(references)
        .map(|(row, reference)| {
            row.iter().map(|score| (score - reference.low) / (reference.high - reference.low)).collect()
        })
        .collect();
    Ok(Scores::new(&rows)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scores::testing::{any_scores, mapped, scores};
    use proptest::prelude::*;

    #[test]
    fn maps_low_to_0_and_high_to_1_task_by_task() {
        let table = scores(&[&[10.0, 20.0, 40.0], &[-1.0, 0.0, 0.5]]);
        let references = [Reference { low: 10.0, high: 20.0 }, Reference { low: 0.0, high: 0.5 }];
        let normalized = normalize(&table, &references).expect("valid references");
        assert_eq!(normalized, scores(&[&[0.0, 1.0, 3.0], &[-2.0, 0.0, 1.0]]));
    }

    #[test]
    fn errors_name_the_task() {
        let table = scores(&[&[1.0], &[2.0]]);
        let good = Reference { low: 0.0, high: 1.0 };
        let message = |references: &[Reference]| normalize(&table, references).expect_err("invalid").to_string();
        assert_eq!(message(&[good]), "1 references for 2 tasks: each task needs one");
        assert_eq!(
            message(&[good, Reference { low: 1.0, high: 1.0 }]),
            "reference of task 1: low 1 and high 1 must be finite numbers, low below high"
        );
        assert_eq!(
            message(&[Reference { low: f64::NAN, high: 1.0 }, good]),
            "reference of task 0: low NaN and high 1 must be finite numbers, low below high"
        );
        assert_eq!(
            message(&[good, Reference { low: 0.0, high: 1e-309 }]),
            "normalised scores: task 1, run 0: score inf must be a finite number, at most 1e300 in size"
        );
    }

    proptest! {
        /// Whatever unit a task is measured in, the normalised score is the same.
        #[test]
        fn units_do_not_count(table in any_scores(1, 5), scale in 1..100i32, shift in -9..9i32) {
            let unit = |score: f64| score * f64::from(scale) + f64::from(shift);
            let one = normalize(&table, &[Reference { low: -2.0, high: 6.0 }]).expect("valid");
            let reference = Reference { low: unit(-2.0), high: unit(6.0) };
            let other = normalize(&mapped(&table, unit), &[reference]).expect("valid");
            for (one, other) in one.values().iter().zip(other.values()) {
                prop_assert!((one - other).abs() < 1e-12);
            }
        }
    }
}
