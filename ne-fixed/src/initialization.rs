use crate::{Distribution, WeightVector, chance::symmetric, normal::Normal};
use ne_core::{RandomStream, SettingError};
use serde::{Deserialize, Serialize};

/// How the weights of the first generation are drawn.
///
/// In JSON the name with its settings: `{"uniform": {"limit": 1.0}}`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Initialization {
    /// Each weight uniform from `-limit` to `limit`.
    Uniform {
        /// From 0 to 1000.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        limit: f64,
    },
    /// Each weight normal with mean 0 and deviation `scale` / √n, where n is the number of weights that lead to its
    /// neuron: the sums then have a like spread in narrow and wide layers.
    ///
    /// Source: LeCun, Bottou, Orr & Müller, *Efficient BackProp*, 1998, section 4.6.
    ScaledGaussian {
        /// From 0 to 1000; 1 keeps the spread of sources that have deviation 1.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        scale: f64,
    },
    /// Each weight drawn from a [`Distribution`], whatever its neuron: `{"distributed": {"cauchy": {"scale": 0.2}}}`.
    Distributed(Distribution),
}

impl Initialization {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        match *self {
            Self::Uniform { limit } => SettingError::check_range("uniform.limit", limit, 0.0, 1000.0),
            Self::ScaledGaussian { scale } => SettingError::check_range("scaled-gaussian.scale", scale, 0.0, 1000.0),
            Self::Distributed(distribution) => distribution.validate().map_err(|error| error.within("distributed")),
        }
    }

    /// Draws the weights of an individual.
    pub(crate) fn draw(&self, individual: &mut WeightVector, stream: &mut RandomStream) {
        let topology = individual.topology().clone();
        let (mut weights, _) = individual.genes_mut();
        match *self {
            Self::Uniform { limit } => {
                let limit = limit as f32;
                weights.iter_mut().for_each(|weight| *weight = symmetric(stream) * limit);
            }
            Self::Distributed(distribution) => {
                weights.iter_mut().for_each(|weight| *weight = distribution.draw(stream));
            }
            Self::ScaledGaussian { scale } => {
                let normal = Normal::new();
                for count in topology.weights_of_neurons() {
                    let deviation = (scale / (count as f64).sqrt()) as f32;
                    let (neuron, rest) = weights.split_at_mut(count);
                    neuron.iter_mut().for_each(|weight| *weight = normal.next(stream) * deviation);
                    weights = rest;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};
    use ne_net::DenseShape;

    fn drawn(initialization: Initialization) -> Vec<f32> {
        let mut individual = WeightVector::zero(DenseShape::new(99, vec![100], 99).into());
        initialization.draw(&mut individual, &mut Seed::of_run(1).stream(Purpose::new("test")));
        individual.weights().to_vec()
    }

    fn deviation(weights: &[f32]) -> f64 {
        (weights.iter().map(|&weight| f64::from(weight).powi(2)).sum::<f64>() / weights.len() as f64).sqrt()
    }

    #[test]
    fn uniform_fills_its_range() {
        let weights = drawn(Initialization::Uniform { limit: 2.0 });
        assert!(weights.iter().all(|weight| weight.abs() <= 2.0));
        assert!((deviation(&weights) - 2.0 / 3.0_f64.sqrt()).abs() < 0.02);
    }

    #[test]
    fn scaled_gaussian_depends_on_the_layer() {
        let weights = drawn(Initialization::ScaledGaussian { scale: 2.0 });
        let (first, second) = weights.split_at(100 * 100);
        assert!((deviation(first) - 2.0 / 100_f64.sqrt()).abs() < 0.005);
        assert!((deviation(second) - 2.0 / 101_f64.sqrt()).abs() < 0.005);
    }

    #[test]
    fn weights_of_a_distribution_are_drawn_whatever_their_neuron() {
        let weights = drawn(Initialization::Distributed(Distribution::Exponential { mean: 0.5 }));
        let mean = weights.iter().map(|weight| f64::from(weight.abs())).sum::<f64>() / weights.len() as f64;
        assert!((mean - 0.5).abs() < 0.01, "{mean}");
    }

    #[test]
    fn errors_name_the_field() {
        for (initialization, message) in [
            (
                Initialization::Distributed(Distribution::Normal { deviation: f64::NAN }),
                "distributed.normal.deviation = NaN: must be from 0 to 1000",
            ),
            (Initialization::Uniform { limit: -1.0 }, "uniform.limit = -1: must be from 0 to 1000"),
            (Initialization::ScaledGaussian { scale: 1e4 }, "scaled-gaussian.scale = 10000: must be from 0 to 1000"),
        ] {
            assert_eq!(initialization.validate().expect_err("out of range").to_string(), message);
        }
    }
}
