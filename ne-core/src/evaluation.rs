use crate::{Fitness, Measurements};
use serde::{Deserialize, Serialize};

/// The result of evaluating one phenotype on a [`Task`](crate::Task).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evaluation {
    /// The fitness, or why there is none.
    pub outcome: Result<Fitness, Failure>,
    /// The work done, in the task's smallest unit (for bodies: physics steps). Budgets count it.
    pub steps: u64,
    /// Several objectives, all to be maximised; empty if the task has only the fitness.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objectives: Vec<f64>,
    /// Named measurements, for reports; the task documents names and units.
    #[serde(default, skip_serializing_if = "Measurements::is_empty")]
    pub measurements: Measurements,
}

impl Evaluation {
    /// An evaluation with this fitness and no recorded work; NaN and infinities become [`Failure::NonFinite`].
    pub fn new(fitness: f64) -> Self {
        let outcome = Fitness::new(fitness).map_err(|_| Failure::NonFinite { what: "fitness".into() });
        Self { outcome, steps: 0, objectives: Vec::new(), measurements: Measurements::default() }
    }

    /// An evaluation that failed.
    pub fn failed(failure: Failure) -> Self {
        Self { outcome: Err(failure), ..Self::new(0.0) }
    }

    /// The same, with the work done.
    #[must_use]
    pub fn with_steps(self, steps: u64) -> Self {
        Self { steps, ..self }
    }

    /// The fitness, if the evaluation did not fail.
    ///
    /// `Option`s compare with `None` lowest, so failures rank below every fitness.
    pub fn fitness(&self) -> Option<Fitness> {
        self.outcome.as_ref().ok().copied()
    }

    /// The objectives, or the fitness as the only one if the task has no others; `None` if the evaluation failed or an
    /// objective is no finite number.
    pub fn objectives(&self) -> Option<Vec<Fitness>> {
        let fitness = self.fitness()?;
        if self.objectives.is_empty() {
            return Some(vec![fitness]);
        }
        self.objectives.iter().map(|&objective| Fitness::new(objective).ok()).collect()
    }
}

impl From<f64> for Evaluation {
    /// As [`Evaluation::new`].
    fn from(fitness: f64) -> Self {
        Self::new(fitness)
    }
}

/// Why an evaluation has no fitness.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Failure {
    /// A number that must be finite was not.
    #[error("{what} is not finite")]
    NonFinite {
        /// Which number: "fitness", "output 3", "position of left leg".
        what: String,
    },
    /// The simulation left the range in which it means anything.
    #[error("the simulation is unstable: {what}")]
    Unstable {
        /// What was seen.
        what: String,
    },
    /// The phenotype does not fit the task.
    #[error(
        "the phenotype has {found_inputs} inputs and {found_outputs} outputs, the task needs {inputs} and {outputs}"
    )]
    ShapeMismatch {
        /// Inputs of the phenotype.
        found_inputs: usize,
        /// Outputs of the phenotype.
        found_outputs: usize,
        /// Inputs of the task.
        inputs: usize,
        /// Outputs of the task.
        outputs: usize,
    },
    /// Anything else a task wants to say.
    #[error("{what}")]
    Other {
        /// The reason.
        what: String,
    },
}

impl Failure {
    /// What is not finite in a decision of a phenotype: the first output, or the first input if one was not finite before. `None`
    /// if all outputs are finite.
    pub fn of_decision(inputs: &[f32], outputs: &[f32]) -> Option<Self> {
        let not_finite = |numbers: &[f32]| numbers.iter().position(|number| !number.is_finite());
        let output = not_finite(outputs)?;
        let what = not_finite(inputs).map_or_else(|| format!("output {output}"), |input| format!("input {input}"));
        Some(Self::NonFinite { what })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_becomes_a_failure_and_ranks_last() {
        let failed = Evaluation::new(f64::NAN);
        assert_eq!(failed.outcome, Err(Failure::NonFinite { what: "fitness".into() }));
        assert!(failed.fitness() < Evaluation::new(-1e300).fitness());
    }

    #[test]
    fn the_fitness_is_the_only_objective_of_a_task_without() {
        let values =
            |evaluation: Evaluation| evaluation.objectives().map(|v| v.into_iter().map(Fitness::get).collect());
        let with = |objectives: Vec<f64>| Evaluation { objectives, ..Evaluation::new(1.0) };
        assert_eq!(values(with(vec![])), Some(vec![1.0]));
        assert_eq!(values(with(vec![2.0, -3.0])), Some(vec![2.0, -3.0]));
        assert_eq!(values(with(vec![2.0, f64::NAN])), None);
        assert_eq!(values(Evaluation { objectives: vec![2.0], ..Evaluation::new(f64::NAN) }), None);
    }

    #[test]
    fn what_is_not_finite_in_a_decision_is_its_input_before_its_output() {
        let what = |inputs: &[f32], outputs: &[f32]| Failure::of_decision(inputs, outputs).map(|it| it.to_string());
        assert_eq!(what(&[0.0, f32::NAN], &[1.0, f32::NAN]).as_deref(), Some("input 1 is not finite"));
        assert_eq!(what(&[0.0, 1.0], &[1.0, f32::INFINITY]).as_deref(), Some("output 1 is not finite"));
        // A net that does not hear the input goes on.
        assert_eq!(what(&[f32::NAN], &[1.0]), None);
    }

    #[test]
    fn survives_serialisation() {
        let mut evaluation = Evaluation::new(0.1).with_steps(2000);
        evaluation.measurements.insert("energy_j", 3.5);
        for evaluation in [evaluation, Evaluation::failed(Failure::Unstable { what: "speed".into() })] {
            let text = serde_json::to_string(&evaluation).expect("serialises");
            assert_eq!(serde_json::from_str::<Evaluation>(&text).expect("deserialises"), evaluation);
        }
    }
}
