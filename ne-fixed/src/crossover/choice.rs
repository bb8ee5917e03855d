use super::{Arithmetic, Crossover, OnePoint, TwoPoint, UniformCrossover};
use crate::Setting;
use ne_core::RandomStream;
use serde::{Deserialize, Serialize};

/// One of the four crossover operators, chosen at run time: how a configuration file names it.
///
/// In JSON the name with its settings, of which these have none: `{"two-point": {}}`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum CrossoverChoice {
    /// Up to a point from one parent, the rest from the other.
    OnePoint(OnePoint),
    /// Between two points from one parent, the rest from the other.
    TwoPoint(TwoPoint),
    /// Each gene from either.
    Uniform(UniformCrossover),
    /// Between the parents.
    Arithmetic(Arithmetic),
}

impl Setting for CrossoverChoice {}

impl Crossover for CrossoverChoice {
    fn cross(&self, first: &[f32], second: &[f32], child: &mut [f32], stream: &mut RandomStream) {
        match self {
            Self::OnePoint(operator) => operator.cross(first, second, child, stream),
            Self::TwoPoint(operator) => operator.cross(first, second, child, stream),
            Self::Uniform(operator) => operator.cross(first, second, child, stream),
            Self::Arithmetic(operator) => operator.cross(first, second, child, stream),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::child;
    use super::*;

    #[test]
    fn does_what_the_chosen_operator_does() {
        let (first, second) = ([1.0, 2.0, 3.0, 4.0, 5.0], [-1.0, -2.0, -3.0, -4.0, -5.0]);
        for seed in 0..20 {
            let cross = |choice: CrossoverChoice| child(&choice, &first, &second, seed);
            assert_eq!(cross(CrossoverChoice::OnePoint(OnePoint {})), child(&OnePoint {}, &first, &second, seed));
            assert_eq!(cross(CrossoverChoice::TwoPoint(TwoPoint {})), child(&TwoPoint {}, &first, &second, seed));
            let uniform = UniformCrossover {};
            assert_eq!(cross(CrossoverChoice::Uniform(uniform)), child(&uniform, &first, &second, seed));
            assert_eq!(cross(CrossoverChoice::Arithmetic(Arithmetic {})), child(&Arithmetic {}, &first, &second, seed));
        }
    }

    #[test]
    fn is_named_in_files() {
        for (choice, text) in [
            (CrossoverChoice::OnePoint(OnePoint {}), r#"{"one-point":{}}"#),
            (CrossoverChoice::TwoPoint(TwoPoint {}), r#"{"two-point":{}}"#),
            (CrossoverChoice::Uniform(UniformCrossover {}), r#"{"uniform":{}}"#),
            (CrossoverChoice::Arithmetic(Arithmetic {}), r#"{"arithmetic":{}}"#),
        ] {
            assert_eq!(serde_json::to_string(&choice).expect("serialises"), text);
            assert_eq!(serde_json::from_str::<CrossoverChoice>(text).expect("deserialises"), choice);
            assert!(choice.validate().is_ok());
        }
        assert!(serde_json::from_str::<CrossoverChoice>(r#"{"one-point":{"points":2}}"#).is_err());
    }
}
