use crate::normal::Normal;
use ne_core::{RandomStream, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// A distribution of changes, or of first weights; symmetric about 0.
///
/// In JSON the name with its settings: `{"cauchy": {"scale": 0.2}}`.
///
/// The bits are the same on every platform: logarithm, exponential and tangent come from `libm`. (Those of the crate
/// `rand_distr` are not: they come from the platform as soon as any crate of a program asks `num-traits` for `std`. Of 20,000
/// blocks of 1,000 draws 24 differed between the two for the normal distribution, 69 for the exponential one, and all for the
/// Cauchy and the log-normal distribution. It is the measure of the tests here.)
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Distribution {
    /// The normal distribution: hardly ever beyond three deviations.
    Normal {
        /// The standard deviation, from 0 to 1000.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        deviation: f64,
    },
    /// The Cauchy distribution: most numbers are small, a few very large; it leaves local optima from far away. Numbers beyond
    /// 1000 scales are cut.
    ///
    /// Source: Yao, Liu & Lin, *Evolutionary Programming Made Faster*, IEEE Transactions on Evolutionary Computation 3(2),
    /// 1999.
    Cauchy {
        /// Half of the numbers are nearer to 0 than this; from 0 to 1000.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        scale: f64,
    },
    /// The exponential distribution to both sides (Laplace): between the normal and the Cauchy distribution.
    Exponential {
        /// The mean distance from 0; from 0 to 1000.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        mean: f64,
    },
    /// Numbers whose logarithm is normal, to both sides: over several orders of magnitude, and hardly any at 0. Numbers beyond
    /// 1000 medians are cut.
    LogNormal {
        /// Half of the numbers are nearer to 0 than this; from 0 to 1000.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        median: f64,
        /// The standard deviation of the natural logarithm, from 0 to 10.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
        spread: f64,
    },
}

/// Numbers are at most so many scales, or medians, from 0.
const FARTHEST: f64 = 1000.0;

impl Distribution {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let check = |field, value, most| SettingError::check_range(field, value, 0.0, most);
        match *self {
            Self::Normal { deviation } => check("normal.deviation", deviation, 1000.0),
            Self::Cauchy { scale } => check("cauchy.scale", scale, 1000.0),
            Self::Exponential { mean } => check("exponential.mean", mean, 1000.0),
            Self::LogNormal { median, spread } => {
                check("log-normal.median", median, 1000.0)?;
                check("log-normal.spread", spread, 10.0)
            }
        }
    }

    /// The next number.
    pub(crate) fn draw(&self, stream: &mut RandomStream) -> f32 {
        match *self {
            Self::Normal { deviation } => Normal::new().next(stream) * deviation as f32,
            Self::Cauchy { scale } => {
                // From -1/2 to 1/2, whose tangents are the ends of the line.
                let turn = stream.random::<f64>() - 0.5;
                (libm::tan(std::f64::consts::PI * turn).clamp(-FARTHEST, FARTHEST) * scale) as f32
            }
            Self::Exponential { mean } => {
                let distance = -libm::log(1.0 - stream.random::<f64>());
                to_either_side(distance * mean, stream)
            }
            Self::LogNormal { median, spread } => {
                let factor = libm::exp(spread * f64::from(Normal::new().next(stream)));
                to_either_side(factor.min(FARTHEST) * median, stream)
            }
        }
    }
}

fn to_either_side(distance: f64, stream: &mut RandomStream) -> f32 {
    (if stream.random::<bool>() { distance } else { -distance }) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};
    use rand_distr::{Cauchy, Distribution as _, Exp, LogNormal, StandardNormal};

    const DRAWS: usize = 100_000;

    fn stream(seed: u64) -> RandomStream {
        Seed::of_run(seed).stream(Purpose::new("test"))
    }

    fn drawn(distribution: Distribution) -> Vec<f64> {
        let mut stream = stream(1);
        (0..DRAWS).map(|_| f64::from(distribution.draw(&mut stream))).collect()
    }

    /// The largest distance of two empirical distribution functions: the statistic of Kolmogorov and Smirnov.
    fn distance(mut one: Vec<f64>, mut other: Vec<f64>) -> f64 {
        one.sort_by(f64::total_cmp);
        other.sort_by(f64::total_cmp);
        let share = |sorted: &[f64], x: f64| sorted.partition_point(|&value| value <= x) as f64 / sorted.len() as f64;
        one.iter().map(|&x| (share(&one, x) - share(&other, x)).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn numbers_are_distributed_as_those_of_rand_distr() {
        let reference = |draw: &dyn Fn(&mut RandomStream) -> f64, both_sides: bool| -> Vec<f64> {
            let (mut stream, mut sides) = (stream(2), stream(3));
            let side = |sides: &mut RandomStream| if both_sides && sides.random::<bool>() { -1.0 } else { 1.0 };
            (0..DRAWS).map(|_| draw(&mut stream) * side(&mut sides)).collect()
        };
        let normal = |stream: &mut RandomStream| {
            let number: f64 = StandardNormal.sample(stream);
            0.3 * number
        };
        let cauchy = Cauchy::new(0.0, 0.2).expect("a scale");
        let exponential = Exp::new(2.0).expect("a rate");
        let log_normal = LogNormal::new(libm::log(0.1), 1.5).expect("a spread");
        // 0.1 % of pairs of samples of this size are farther apart, if they are from one distribution.
        let limit = 1.95 * (2.0 / DRAWS as f64).sqrt();
        for (distribution, reference) in [
            (Distribution::Normal { deviation: 0.3 }, reference(&normal, false)),
            (Distribution::Cauchy { scale: 0.2 }, reference(&|stream| cauchy.sample(stream), false)),
            (Distribution::Exponential { mean: 0.5 }, reference(&|stream| exponential.sample(stream), true)),
            (
                Distribution::LogNormal { median: 0.1, spread: 1.5 },
                reference(&|stream| log_normal.sample(stream), true),
            ),
        ] {
            let found = distance(drawn(distribution), reference);
            assert!(found < limit, "{distribution:?}: {found} of {limit}");
        }
        // Were it another distribution, it would be seen.
        let other =
            distance(drawn(Distribution::Cauchy { scale: 0.2 }), drawn(Distribution::Exponential { mean: 0.3 }));
        assert!(other > limit);
    }

    #[test]
    fn numbers_stay_finite_whatever_the_settings() {
        for distribution in [
            Distribution::Normal { deviation: 1000.0 },
            Distribution::Cauchy { scale: 1000.0 },
            Distribution::Exponential { mean: 1000.0 },
            Distribution::LogNormal { median: 1000.0, spread: 10.0 },
        ] {
            assert!(drawn(distribution).iter().all(|number| number.abs() <= 1e6), "{distribution:?}");
        }
        for nothing in [Distribution::Cauchy { scale: 0.0 }, Distribution::LogNormal { median: 0.0, spread: 10.0 }] {
            assert!(drawn(nothing).iter().all(|&number| number == 0.0));
        }
    }

    #[test]
    fn is_named_in_files_and_errors_name_the_field() {
        for (text, message) in [
            (r#"{"normal":{"deviation":-1.0}}"#, "normal.deviation = -1: must be from 0 to 1000"),
            (r#"{"cauchy":{"scale":1001.0}}"#, "cauchy.scale = 1001: must be from 0 to 1000"),
            (r#"{"exponential":{"mean":-0.5}}"#, "exponential.mean = -0.5: must be from 0 to 1000"),
            (r#"{"log-normal":{"median":1.0,"spread":11.0}}"#, "log-normal.spread = 11: must be from 0 to 10"),
        ] {
            let distribution: Distribution = serde_json::from_str(text).expect("deserialises");
            assert_eq!(serde_json::to_string(&distribution).expect("serialises"), text);
            assert_eq!(distribution.validate().expect_err("out of range").to_string(), message);
        }
    }
}
