use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The optimiser Adam: steps along a gradient, of like size for each weight however large its gradient is.
///
/// Source: Kingma & Ba, *Adam: A Method for Stochastic Optimization*, ICLR 2015, algorithm 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Adam {
    /// α, about how far a weight moves in a step, above 0 and at most 1000; default 0.05.
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0)))]
    pub learning_rate: f64,
    /// β₁, how slowly the mean gradient is forgotten, from 0 to below 1; default 0.9.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0), extend("exclusiveMaximum" = 1.0)))]
    pub momentum: f64,
    /// β₂, how slowly the mean square of the gradient is forgotten, from 0 to below 1; default 0.999.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0), extend("exclusiveMaximum" = 1.0)))]
    pub square_decay: f64,
    /// ε, what is added to the root of the mean square, above 0 and at most 1; default 1e-8.
    #[cfg_attr(feature = "schema", schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0)))]
    pub epsilon: f64,
}

impl Default for Adam {
    fn default() -> Self {
        Self { learning_rate: 0.05, momentum: 0.9, square_decay: 0.999, epsilon: 1e-8 }
    }
}

impl Adam {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let below_1 = |field, value| {
            let fits = (0.0..1.0).contains(&value);
            if fits { Ok(()) } else { Err(SettingError::new(field, value, "from 0 to below 1")) }
        };
        SettingError::check_above_0("learning_rate", self.learning_rate, 1000.0)?;
        below_1("momentum", self.momentum)?;
        below_1("square_decay", self.square_decay)?;
        SettingError::check_above_0("epsilon", self.epsilon, 1.0)
    }

    /// Moves `weights` up the gradient.
    pub(super) fn step(&self, memory: &mut AdamMemory, gradient: &[f64], weights: &mut [f64]) {
        memory.steps += 1;
        let unbiased = |decay: f64| 1.0 - libm::pow(decay, memory.steps as f64);
        let (mean_scale, square_scale) = (unbiased(self.momentum), unbiased(self.square_decay));
        let moments = memory.means.iter_mut().zip(&mut memory.squares);
        for ((weight, gradient), (mean, square)) in weights.iter_mut().zip(gradient).zip(moments) {
            *mean = self.momentum * *mean + (1.0 - self.momentum) * gradient;
            *square = self.square_decay * *square + (1.0 - self.square_decay) * gradient * gradient;
            let root = (*square / square_scale).sqrt();
            *weight += self.learning_rate * (*mean / mean_scale) / (root + self.epsilon);
        }
    }
}

/// What [`Adam`] remembers of the gradients so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AdamMemory {
    pub(super) steps: u64,
    pub(super) means: Vec<f64>,
    pub(super) squares: Vec<f64>,
}

impl AdamMemory {
    /// Of no gradients.
    pub(super) fn new(count: usize) -> Self {
        Self { steps: 0, means: vec![0.0; count], squares: vec![0.0; count] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_those_computed_by_hand() {
        let adam = Adam { learning_rate: 0.1, momentum: 0.9, square_decay: 0.99, epsilon: 1e-8 };
        let (mut memory, mut weights) = (AdamMemory::new(2), [1.0, -1.0]);
        // The first step is the learning rate in the direction of the gradient, whatever its size.
        adam.step(&mut memory, &[2.0, -0.5], &mut weights);
        assert!((weights[0] - 1.1).abs() < 1e-8 && (weights[1] + 1.1).abs() < 1e-8, "{weights:?}");
        // m = 0.9 · 0.2 + 0.1 · (−1) = 0.08, m̂ = 0.08 / 0.19; v = 0.99 · 0.04 + 0.01 = 0.0496, v̂ = 0.0496 / 0.0199.
        adam.step(&mut memory, &[-1.0, 0.0], &mut weights);
        let expected = 1.1 + 0.1 * (0.08 / 0.19) / (0.0496_f64 / 0.0199).sqrt();
        assert!((weights[0] - expected).abs() < 1e-8, "{weights:?}");
        // m = 0.9 · (−0.05) = −0.045; v = 0.99 · 0.0025 = 0.002475.
        let expected = -1.1 - 0.1 * (0.045 / 0.19) / (0.002475_f64 / 0.0199).sqrt();
        assert!((weights[1] - expected).abs() < 1e-7, "{weights:?}");
    }

    #[test]
    fn errors_name_the_field() {
        let error = |adam: Adam| adam.validate().expect_err("out of range").to_string();
        let default = Adam::default();
        assert_eq!(default.validate(), Ok(()));
        for (adam, message) in [
            (Adam { learning_rate: 0.0, ..default }, "learning_rate = 0: must be above 0 and at most 1000"),
            (Adam { momentum: 1.0, ..default }, "momentum = 1: must be from 0 to below 1"),
            (Adam { square_decay: -0.1, ..default }, "square_decay = -0.1: must be from 0 to below 1"),
            (Adam { epsilon: f64::NAN, ..default }, "epsilon = NaN: must be above 0 and at most 1"),
        ] {
            assert_eq!(error(adam), message);
        }
    }
}
