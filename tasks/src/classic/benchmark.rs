use ne_core::{Evaluation, Phenotype, Task};

/// A task with a notion of "solved", on which strategies are compared by the evaluations they need.
///
/// Whether a task is solved is not a level of fitness: it may take a test that is too long to be part of every
/// evaluation. So it is asked in two steps. A runner evaluates, counts the evaluation, and asks
/// [`is_candidate`](Self::is_candidate) of the result, which costs nothing; of a candidate it asks
/// [`is_solved`](Self::is_solved), which may test the phenotype. The test is not counted as an evaluation, as in the
/// literature.
///
/// ```
/// use ne_core::{Phenotype, Seed, Task};
/// use tasks::{Benchmark, Xor, XorSettings};
///
/// /// x + y − 2 x y
/// struct Answer;
/// impl Phenotype for Answer {
///     fn inputs(&self) -> usize { 2 }
///     fn outputs(&self) -> usize { 1 }
///     fn reset(&mut self) {}
///     fn activate(&mut self, x: &[f32], y: &mut [f32]) { y[0] = x[0] + x[1] - 2.0 * x[0] * x[1] }
/// }
///
/// let xor = Xor::new(XorSettings::default());
/// let evaluation = xor.evaluate(&mut Answer, Seed::of_run(1));
/// assert!(xor.is_candidate(&evaluation) && xor.is_solved(&mut Answer, &evaluation));
/// ```
pub trait Benchmark: Task {
    /// The name, in lower case, words joined by hyphens.
    fn name(&self) -> &str;

    /// Whether a phenotype with this evaluation may have solved the task; never true of a failed evaluation.
    fn is_candidate(&self, evaluation: &Evaluation) -> bool;

    /// Whether the phenotype has solved the task; `evaluation` is what [`evaluate`](Task::evaluate) gave for it.
    ///
    /// Unless told otherwise, every candidate has.
    fn is_solved(&self, phenotype: &mut dyn Phenotype, evaluation: &Evaluation) -> bool {
        let _ = phenotype;
        self.is_candidate(evaluation)
    }
}
