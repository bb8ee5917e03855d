use ne_core::{RandomStream, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// How numbers around 0 are drawn, in units of the weights.
///
/// In JSON: `{"uniform": {"limit": 1}}` or `{"gaussian": {"deviation": 0.5}}`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Noise {
    /// All between -limit (included) and limit (excluded) alike.
    Uniform {
        /// From 0 to 1000.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        limit: f64,
    },
    /// A bell curve.
    Gaussian {
        /// Its standard deviation, from 0 to 1000.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        deviation: f64,
    },
}

impl Noise {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        match *self {
            Self::Uniform { limit } => SettingError::check_range("uniform.limit", limit, 0.0, 1000.0),
            Self::Gaussian { deviation } => SettingError::check_range("gaussian.deviation", deviation, 0.0, 1000.0),
        }
    }

    /// The next number.
    #[inline]
    pub(crate) fn draw(self, stream: &mut RandomStream) -> f32 {
        match self {
            Self::Uniform { limit } => limit as f32 * symmetric(stream),
            Self::Gaussian { deviation } => deviation as f32 * normal(stream),
        }
    }
}

/// How a new weight is drawn: as the noise has it, but no greater than weights can become.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NewWeights {
    pub(crate) noise: Noise,
    pub(crate) limit: f32,
}

impl NewWeights {
    /// The next weight.
    #[inline]
    pub(crate) fn draw(self, stream: &mut RandomStream) -> f32 {
        self.noise.draw(stream).clamp(-self.limit, self.limit)
    }
}

/// Uniform from -1 (included) to 1 (excluded).
#[inline]
fn symmetric(stream: &mut RandomStream) -> f32 {
    2.0 * stream.random::<f32>() - 1.0
}

/// Normally distributed with mean 0 and deviation 1.
///
/// Source: Marsaglia & Bray, *A Convenient Method for Generating Normal Variables*, SIAM Review 6(3), 1964. The
/// logarithm is `libm`'s, the same on every platform.
fn normal(stream: &mut RandomStream) -> f32 {
    loop {
        let (x, y) = (symmetric(stream), symmetric(stream));
        let square = x * x + y * y;
        if square > 0.0 && square < 1.0 {
            return x * (-2.0 * libm::logf(square) / square).sqrt();
        }
    }
}

/// Whether something happens that has this probability.
#[inline]
pub(crate) fn happens(probability: f64, stream: &mut RandomStream) -> bool {
    // What is certain or impossible takes no number.
    probability > 0.0 && (probability >= 1.0 || stream.random::<f64>() < probability)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};

    #[test]
    fn numbers_have_the_spread_asked_for() {
        for (noise, deviation, most) in
            [(Noise::Uniform { limit: 2.0 }, 2.0 / 3.0_f64.sqrt(), 2.0), (Noise::Gaussian { deviation: 0.5 }, 0.5, 3.5)]
        {
            let mut stream = Seed::of_run(1).stream(Purpose::new("test"));
            let numbers: Vec<f64> = (0..200_000).map(|_| noise.draw(&mut stream).into()).collect();
            let mean = numbers.iter().sum::<f64>() / 200_000.0;
            let square = numbers.iter().map(|x| x * x).sum::<f64>() / 200_000.0;
            assert!(mean.abs() < 0.01 * most && (square.sqrt() - deviation).abs() < 0.01 * deviation, "{noise:?}");
            assert!(numbers.iter().all(|x| x.abs() <= most), "{noise:?}");
        }
    }

    /// Shares of a bell curve beyond 1 and 2 deviations.
    #[test]
    fn gaussian_numbers_are_normal() {
        let mut stream = Seed::of_run(2).stream(Purpose::new("test"));
        let numbers: Vec<f32> = (0..200_000).map(|_| normal(&mut stream)).collect();
        for (bound, share) in [(1.0, 0.3173), (2.0, 0.0455)] {
            let found = numbers.iter().filter(|x| x.abs() > bound).count() as f64 / 200_000.0;
            assert!((found - share).abs() < 0.004, "{bound}: {found}");
        }
    }

    #[test]
    fn errors_name_the_field() {
        let error = |noise: Noise| noise.validate().expect_err("out of range").to_string();
        assert_eq!(error(Noise::Uniform { limit: -1.0 }), "uniform.limit = -1: must be from 0 to 1000");
        assert_eq!(error(Noise::Gaussian { deviation: 1e4 }), "gaussian.deviation = 10000: must be from 0 to 1000");
    }
}
