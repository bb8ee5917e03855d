use crate::sample::{LARGEST, is_usable};
use ne_core::RandomStream;
use rand::RngExt;

/// The scores of one method: a table with a row for each task and a column for each run. Larger is better.
///
/// Every task has the same number of runs. A run that failed has no score; what to put in its place (the worst score a
/// task can give, say) is the caller's decision, and belongs into the text beside the figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Scores {
    runs: usize,
    /// Task by task.
    values: Vec<f64>,
}

/// The error of [`Scores::new`]. Tasks and runs are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScoresError {
    /// No tasks at all.
    #[error("no tasks: scores need at least one task")]
    NoTasks,
    /// A task without runs.
    #[error("task {task} has no runs: every task needs at least one")]
    NoRuns {
        /// Which task.
        task: usize,
    },
    /// A task with another number of runs than the first.
    #[error("task {task} has {found} runs, task 0 has {expected}: every task needs equally many")]
    Runs {
        /// Which task.
        task: usize,
        /// How many runs it has.
        found: usize,
        /// How many runs the first task has.
        expected: usize,
    },
    /// A score is NaN, infinite or too large.
    #[error("task {task}, run {run}: score {value:e} must be a finite number, at most {LARGEST:e} in size")]
    Value {
        /// Which task.
        task: usize,
        /// Which run.
        run: usize,
        /// The score found.
        value: f64,
    },
}

impl Scores {
    /// The scores `rows[task][run]`.
    ///
    /// # Errors
    /// [`ScoresError`] if there are no tasks, a task has no runs or another number of runs than the first, or a score is
    /// not finite or larger than [`LARGEST`] in size.
    pub fn new(rows: &[Vec<f64>]) -> Result<Self, ScoresError> {
        let expected = rows.first().ok_or(ScoresError::NoTasks)?.len();
        for (task, row) in rows.iter().enumerate() {
            if row.is_empty() {
                return Err(ScoresError::NoRuns { task });
            }
            if row.len() != expected {
                return Err(ScoresError::Runs { task, found: row.len(), expected });
            }
            if let Some(run) = row.iter().position(|&value| !is_usable(value)) {
                return Err(ScoresError::Value { task, run, value: row[run] });
            }
        }
        Ok(Self { runs: expected, values: rows.concat() })
    }

    /// How many tasks (rows), at least 1.
    pub fn tasks(&self) -> usize {
        self.values.len() / self.runs
    }

    /// How many runs (columns), at least 1.
    pub fn runs(&self) -> usize {
        self.runs
    }

    /// The scores of one task, a score for each run; `None` if there is no such task.
    pub fn task(&self, task: usize) -> Option<&[f64]> {
        self.rows().nth(task)
    }

    /// The scores of each task in turn.
    pub fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.values.chunks_exact(self.runs)
    }

    /// All scores, task by task.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Fills `resample`, of the same shape, with runs drawn with replacement, for each task anew.
    pub(crate) fn resample(&self, resample: &mut Self, stream: &mut RandomStream) {
        for (from, to) in self.rows().zip(resample.values.chunks_exact_mut(self.runs)) {
            to.fill_with(|| from[stream.random_range(0..from.len())]);
        }
    }

    /// The same with `other`, which has the same shape, for pairs of runs: what is drawn for one is drawn for the other.
    pub(crate) fn resample_paired(&self, other: &Self, resamples: [&mut Self; 2], stream: &mut RandomStream) {
        let [own, others] = resamples;
        for task in 0..self.tasks() {
            let first = task * self.runs;
            for to in first..first + self.runs {
                let from = first + stream.random_range(0..self.runs);
                own.values[to] = self.values[from];
                others.values[to] = other.values[from];
            }
        }
    }
}

/// What the tests of all statistics need.
#[cfg(test)]
pub(crate) mod testing {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    /// These scores, known to be valid.
    pub(crate) fn scores(rows: &[&[f64]]) -> Scores {
        Scores::new(&rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>()).expect("valid scores")
    }

    /// Any scores of `tasks` tasks and `runs` runs: small whole numbers, so that there are ties and sums are exact.
    pub(crate) fn any_scores(tasks: usize, runs: usize) -> impl Strategy<Value = Scores> {
        vec(vec((-9..10).prop_map(f64::from), runs), tasks).prop_map(|rows| Scores::new(&rows).expect("valid scores"))
    }

    /// The same scores, each changed by `change`.
    pub(crate) fn mapped(scores: &Scores, change: impl Fn(f64) -> f64) -> Scores {
        let rows: Vec<Vec<f64>> = scores.rows().map(|row| row.iter().map(|&value| change(value)).collect()).collect();
        Scores::new(&rows).expect("valid scores")
    }
}

#[cfg(test)]
mod tests {
    use super::{testing::*, *};

    #[test]
    fn errors_name_task_and_run() {
        let message = |rows: &[Vec<f64>]| Scores::new(rows).expect_err("not a table of scores").to_string();
        assert_eq!(message(&[]), "no tasks: scores need at least one task");
        assert_eq!(message(&[vec![], vec![]]), "task 0 has no runs: every task needs at least one");
        assert_eq!(message(&[vec![1.0], vec![]]), "task 1 has no runs: every task needs at least one");
        assert_eq!(
            message(&[vec![1.0, 2.0], vec![1.0]]),
            "task 1 has 1 runs, task 0 has 2: every task needs equally many"
        );
        assert_eq!(
            message(&[vec![1.0, 2.0], vec![1.0, f64::NAN]]),
            "task 1, run 1: score NaN must be a finite number, at most 1e300 in size"
        );
        assert_eq!(
            message(&[vec![-1e301]]),
            "task 0, run 0: score -1e301 must be a finite number, at most 1e300 in size"
        );
    }

    #[test]
    fn rows_are_tasks_and_columns_are_runs() {
        let scores = scores(&[&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0]]);
        assert_eq!((scores.tasks(), scores.runs()), (2, 3));
        assert_eq!(scores.task(1), Some([4.0, 5.0, 6.0].as_slice()));
        assert_eq!(scores.task(2), None);
        assert_eq!(scores.values(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }
}
