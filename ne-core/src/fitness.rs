use serde::{Deserialize, Serialize};
use std::{cmp::Ordering, fmt};

/// How good a phenotype is: a finite number, larger is better.
///
/// A `Fitness` cannot hold NaN or an infinity, so it has a total order and any mean of fitnesses is a number. What has
/// no such number (an exploded body, a division by zero) is a [`Failure`](crate::Failure), never a magic value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Fitness(f64);

/// The error of [`Fitness::new`]: the value was NaN or infinite.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("a fitness must be a finite number, not {0}")]
pub struct NotFinite(pub f64);

impl Fitness {
    /// The fitness `value`.
    ///
    /// # Errors
    /// [`NotFinite`] if `value` is NaN or infinite.
    pub fn new(value: f64) -> Result<Self, NotFinite> {
        // Adding zero turns -0.0 into 0.0, so that equal fitnesses are equal in every order and file.
        if value.is_finite() { Ok(Self(value + 0.0)) } else { Err(NotFinite(value)) }
    }

    /// The number itself, always finite.
    pub fn get(self) -> f64 {
        self.0
    }
}

impl Eq for Fitness {}

impl PartialOrd for Fitness {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Fitness {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl fmt::Display for Fitness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl TryFrom<f64> for Fitness {
    type Error = NotFinite;
    fn try_from(value: f64) -> Result<Self, NotFinite> {
        Self::new(value)
    }
}

impl From<Fitness> for f64 {
    fn from(fitness: Fitness) -> f64 {
        fitness.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn holds_no_nan_and_no_infinity() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(Fitness::new(value).is_err());
        }
        assert!(serde_json::from_str::<Fitness>("null").is_err());
        assert!(serde_json::from_str::<Fitness>("1e999").is_err());
    }

    proptest! {
        #[test]
        fn orders_as_numbers_do(a in -1e300..1e300f64, b in -1e300..1e300f64) {
            let (x, y) = (Fitness::new(a).expect("finite"), Fitness::new(b).expect("finite"));
            prop_assert_eq!(Some(x.cmp(&y)), a.partial_cmp(&b));
        }
    }

    #[test]
    fn negative_zero_is_zero() {
        let zero = Fitness::new(-0.0).expect("finite");
        assert_eq!(zero.cmp(&Fitness::new(0.0).expect("finite")), Ordering::Equal);
        assert_eq!(serde_json::to_string(&zero).expect("a number"), "0.0");
    }
}
