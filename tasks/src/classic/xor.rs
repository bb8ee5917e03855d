use super::{Benchmark, OutputRange, number};
use ne_core::{Evaluation, Failure, Phenotype, Seed, Task};
use serde::{Deserialize, Serialize};

/// Inputs and the wanted output.
const PATTERNS: [([f32; 2], f64); 4] = [([0.0, 0.0], 0.0), ([0.0, 1.0], 1.0), ([1.0, 0.0], 1.0), ([1.0, 1.0], 0.0)];

/// The measurement that counts the outputs on the right side.
const RIGHT: &str = "right";

/// The settings of [`Xor`]. Every value is allowed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct XorSettings {
    /// Whether a constant 1 follows the two inputs, for nets without biases of their own; default no.
    pub bias_input: bool,
    /// The range of the controller's output; default 0 to 1.
    pub output_range: OutputRange,
}

/// Exclusive or: the smallest task that needs a hidden neuron.
///
/// | | |
/// |---|---|
/// | inputs | the two bits, 0 or 1, and a constant 1 if there is a bias input |
/// | output | the answer: 0 is no, 1 is yes (−1 and 1 for outputs of that range) |
/// | fitness | (4 − Σ abs(error))², from 0 to 16, over the four patterns, with outputs from 0 to 1 |
/// | solved | every output is on the right side of 0.5 |
/// | steps | 4 |
/// | measurements | `error`, the sum of the absolute errors, 0 to 4; `right`, the outputs on the right side, 0 to 4 |
///
/// The controller is reset before each pattern, and answers after one step. The seed changes nothing.
///
/// Source: Stanley & Miikkulainen, *Evolving Neural Networks through Augmenting Topologies*, Evolutionary Computation
/// 10(2), 2002.
#[derive(Clone, Debug)]
pub struct Xor {
    settings: XorSettings,
}

impl Xor {
    /// The task with these settings.
    pub fn new(settings: XorSettings) -> Self {
        Self { settings }
    }

    /// Its settings.
    pub fn settings(&self) -> &XorSettings {
        &self.settings
    }

    /// The output for two bits, from 0 to 1.
    fn answer(&self, phenotype: &mut dyn Phenotype, [one, other]: [f32; 2]) -> Result<f64, Failure> {
        let mut output = [0.0];
        phenotype.reset();
        phenotype.activate(&[one, other, 1.0][..self.inputs()], &mut output);
        Ok(self.settings.output_range.to_zero_to_one(number(output)?))
    }
}

impl Task for Xor {
    fn inputs(&self) -> usize {
        2 + usize::from(self.settings.bias_input)
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        let (mut error, mut right) = (0.0, 0_u8);
        for (step, (bits, wanted)) in (0..).zip(PATTERNS) {
            match self.answer(phenotype, bits) {
                Ok(answer) => {
                    error += (answer - wanted).abs();
                    right += u8::from((answer - wanted).abs() < 0.5);
                }
                Err(failure) => return Evaluation::failed(failure).with_steps(step),
            }
        }
        let mut evaluation = Evaluation::new((4.0 - error) * (4.0 - error)).with_steps(PATTERNS.len() as u64);
        evaluation.measurements.insert("error", error);
        evaluation.measurements.insert(RIGHT, right.into());
        evaluation
    }
}

impl Benchmark for Xor {
    fn name(&self) -> &str {
        "xor"
    }

    fn is_candidate(&self, evaluation: &Evaluation) -> bool {
        evaluation.outcome.is_ok() && evaluation.measurements.get(RIGHT) == Some(4.0)
    }
}
