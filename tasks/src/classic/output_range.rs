use serde::{Deserialize, Serialize};

/// The range of a controller's outputs, from which a task takes what they mean.
///
/// Outputs beyond the range count as its nearer end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutputRange {
    /// 0 to 1, as the logistic function gives.
    #[default]
    ZeroToOne,
    /// −1 to 1, as the hyperbolic tangent gives.
    MinusOneToOne,
}

impl OutputRange {
    /// An output of this range, moved to 0 to 1.
    pub fn to_zero_to_one(self, output: f32) -> f64 {
        let output = f64::from(output);
        match self {
            Self::ZeroToOne => output.clamp(0.0, 1.0),
            Self::MinusOneToOne => 0.5 * output.clamp(-1.0, 1.0) + 0.5,
        }
    }

    /// An output of this range, moved to −1 to 1.
    pub fn to_minus_one_to_one(self, output: f32) -> f64 {
        let output = f64::from(output);
        match self {
            Self::ZeroToOne => 2.0 * output.clamp(0.0, 1.0) - 1.0,
            Self::MinusOneToOne => output.clamp(-1.0, 1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_middle_and_what_lies_beyond() {
        use OutputRange::{MinusOneToOne, ZeroToOne};
        let table = [
            (ZeroToOne, [-3.0, 0.0, 0.25, 0.5, 1.0, 7.0], [0.0, 0.0, 0.25, 0.5, 1.0, 1.0]),
            (MinusOneToOne, [-3.0, -1.0, -0.5, 0.0, 1.0, 7.0], [0.0, 0.0, 0.25, 0.5, 1.0, 1.0]),
        ];
        for (range, outputs, expected) in table {
            assert_eq!(outputs.map(|output| range.to_zero_to_one(output)), expected, "{range:?}");
            let expected = expected.map(|value| 2.0 * value - 1.0);
            assert_eq!(outputs.map(|output| range.to_minus_one_to_one(output)), expected, "{range:?}");
        }
    }
}
