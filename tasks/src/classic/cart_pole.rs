use super::{
    Benchmark, Dynamics, OutputRange, State,
    balancing::{Balancing, SOLVED, check_start_angle, has_held},
};
use ne_core::{Evaluation, Phenotype, Seed, SettingError, Task};
use serde::{Deserialize, Serialize};

/// The pole must not lean further, degrees.
const FAILURE_ANGLE: f64 = 12.0;

/// The settings of [`CartPole`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CartPoleSettings {
    /// How far the pole leans at the start, degrees, from 0.1 to 12; default 4.
    pub start_angle: f64,
    /// Whether a constant input follows the others, for nets without biases of their own; default no. Without any bias
    /// a net of odd activations is an odd function, and the task far easier.
    pub bias_input: bool,
    /// The range of the controller's output; default 0 to 1.
    pub output_range: OutputRange,
}

impl Default for CartPoleSettings {
    fn default() -> Self {
        Self { start_angle: 4.0, bias_input: false, output_range: OutputRange::default() }
    }
}

impl CartPoleSettings {
    /// Checks the ranges.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        check_start_angle(self.start_angle, FAILURE_ANGLE)
    }
}

/// One pole of 1 m on a cart, to be kept upright by pushing the cart.
///
/// | | |
/// |---|---|
/// | inputs | x / 4.8 m, ẋ / 2 m/s, θ / 0.52 rad, θ̇ / 2 rad/s, and a constant 0.5 if there is a bias input |
/// | output | the force, −10 to 10 N over the output's range |
/// | failure | the cart is more than 2.4 m from the middle, or the pole leans by more than 12° |
/// | fitness | decisions held, 0 to 100,000 |
/// | solved | 100,000 decisions are held, which is the whole evaluation |
/// | steps | decisions made |
/// | measurements | `held`, decisions held |
///
/// A decision lasts 0.02 s. The cart starts at rest in the middle. The seed changes nothing. The equations of motion
/// are at [`Dynamics`].
///
/// Source: Gomez, Schmidhuber & Miikkulainen, *Accelerated Neural Evolution through Cooperatively Coevolved Synapses*,
/// JMLR 9, 2008. The scales of the inputs are those of the programs published with such papers.
#[derive(Clone, Debug)]
pub struct CartPole {
    settings: CartPoleSettings,
    balancing: Balancing<1>,
}

impl CartPole {
    /// The task with these settings.
    ///
    /// # Errors
    /// If a setting is out of range.
    pub fn new(settings: CartPoleSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        let balancing = Balancing {
            dynamics: Dynamics::ONE_POLE,
            failure_angle: FAILURE_ANGLE.to_radians(),
            velocities: true,
            bias_input: settings.bias_input,
            output_range: settings.output_range,
        };
        Ok(Self { settings, balancing })
    }

    /// Its settings.
    pub fn settings(&self) -> &CartPoleSettings {
        &self.settings
    }
}

impl Task for CartPole {
    fn inputs(&self) -> usize {
        self.balancing.inputs()
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        let start = State::leaning(self.settings.start_angle);
        let balanced = self.balancing.balance(phenotype, start, SOLVED, |_| ());
        let fitness = balanced.held.into();
        balanced.evaluation(fitness)
    }
}

impl Benchmark for CartPole {
    fn name(&self) -> &str {
        "cart-pole"
    }

    fn is_candidate(&self, evaluation: &Evaluation) -> bool {
        has_held(evaluation, SOLVED)
    }
}
