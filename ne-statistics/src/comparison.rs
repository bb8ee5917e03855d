use crate::Scores;
use ne_core::RandomStream;

/// Two methods, x and y, on the same tasks, and whether their runs are pairs.
///
/// Runs are pairs if run *i* of x and run *i* of y on a task share what chance decides (the seed, say), so that their
/// scores go up and down together. Then a bootstrap draws them together, and the interval of a difference is narrower.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    x: Scores,
    y: Scores,
    is_paired: bool,
}

/// The error of making a [`Comparison`]: the two methods' scores do not fit together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComparisonError {
    /// Different numbers of tasks.
    #[error("x has {x} tasks and y has {y}: methods are compared on the same tasks")]
    Tasks {
        /// How many tasks x has.
        x: usize,
        /// How many tasks y has.
        y: usize,
    },
    /// Pairs were promised, but the numbers of runs differ.
    #[error("x has {x} runs a task and y has {y}: pairs need equally many")]
    Runs {
        /// How many runs x has.
        x: usize,
        /// How many runs y has.
        y: usize,
    },
}

impl Comparison {
    /// Run *i* of x and run *i* of y are a pair, on every task.
    ///
    /// # Errors
    /// [`ComparisonError`] if the numbers of tasks or of runs differ.
    pub fn paired(x: Scores, y: Scores) -> Result<Self, ComparisonError> {
        if x.runs() != y.runs() {
            return Err(ComparisonError::Runs { x: x.runs(), y: y.runs() });
        }
        Ok(Self { is_paired: true, ..Self::unpaired(x, y)? })
    }

    /// All runs are independent of each other. The methods may have different numbers of runs.
    ///
    /// # Errors
    /// [`ComparisonError::Tasks`] if the numbers of tasks differ.
    pub fn unpaired(x: Scores, y: Scores) -> Result<Self, ComparisonError> {
        if x.tasks() != y.tasks() {
            return Err(ComparisonError::Tasks { x: x.tasks(), y: y.tasks() });
        }
        Ok(Self { x, y, is_paired: false })
    }

    /// The scores of method x.
    pub fn x(&self) -> &Scores {
        &self.x
    }

    /// The scores of method y.
    pub fn y(&self) -> &Scores {
        &self.y
    }

    pub(crate) fn is_paired(&self) -> bool {
        self.is_paired
    }

    /// Fills `resample`, of the same shape, with runs drawn with replacement: pairs together, others independently.
    pub(crate) fn resample(&self, resample: &mut Self, stream: &mut RandomStream) {
        if self.is_paired {
            self.x.resample_paired(&self.y, [&mut resample.x, &mut resample.y], stream);
        } else {
            self.x.resample(&mut resample.x, stream);
            self.y.resample(&mut resample.y, stream);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scores::testing::scores;
    use ne_core::{Purpose, Seed};

    #[test]
    fn errors_say_what_differs() {
        let (two_runs, three_runs) = (scores(&[&[1.0, 2.0]]), scores(&[&[1.0, 2.0, 3.0]]));
        let two_tasks = scores(&[&[1.0, 2.0], &[1.0, 2.0]]);
        let error = Comparison::paired(two_runs.clone(), three_runs.clone()).expect_err("runs differ");
        assert_eq!(error.to_string(), "x has 2 runs a task and y has 3: pairs need equally many");
        let tasks = "x has 1 tasks and y has 2: methods are compared on the same tasks";
        let error = Comparison::unpaired(two_runs.clone(), two_tasks.clone()).expect_err("tasks differ");
        assert_eq!(error.to_string(), tasks);
        let error = Comparison::paired(two_runs.clone(), two_tasks).expect_err("tasks differ");
        assert_eq!(error.to_string(), tasks);
        assert!(Comparison::unpaired(two_runs, three_runs).is_ok());
    }

    /// A resample keeps every score in its task, and pairs together if they are pairs.
    #[test]
    fn resampling_respects_tasks_and_pairs() {
        let x = scores(&[&[0.0, 1.0, 2.0, 3.0], &[10.0, 11.0, 12.0, 13.0]]);
        let y = scores(&[&[100.0, 101.0, 102.0, 103.0], &[110.0, 111.0, 112.0, 113.0]]);
        let mut stream = Seed::of_run(1).stream(Purpose::new("test"));
        for is_paired in [true, false] {
            let comparison = Comparison { x: x.clone(), y: y.clone(), is_paired };
            let mut resample = comparison.clone();
            let mut torn = 0;
            for _ in 0..100 {
                comparison.resample(&mut resample, &mut stream);
                for (table, from) in [(&resample.x, &x), (&resample.y, &y)] {
                    for (drawn, task) in table.rows().zip(from.rows()) {
                        assert!(drawn.iter().all(|score| task.contains(score)));
                    }
                }
                let pairs = resample.x.values().iter().zip(resample.y.values());
                torn += pairs.filter(|(x, y)| *y - *x != 100.0).count();
            }
            assert_eq!(torn == 0, is_paired);
        }
    }
}
