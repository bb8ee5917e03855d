/// The largest size of a score, a sample's value or a coordinate of a curve: 10³⁰⁰.
///
/// Below it no sum, difference or average in this crate overflows, so that every statistic of valid numbers is a number.
pub const LARGEST: f64 = 1e300;

/// The error of functions of one or two samples given as slices.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SampleError {
    /// A sample has no values.
    #[error("{sample} is empty: it must have at least one value")]
    Empty {
        /// Which sample: `x` or `y`.
        sample: &'static str,
    },
    /// Paired samples of different lengths.
    #[error("x has {x} values and y has {y}: pairs need equally many")]
    Lengths {
        /// How many values x has.
        x: usize,
        /// How many values y has.
        y: usize,
    },
    /// A value is NaN, infinite or too large.
    #[error("{sample}[{index}] = {value:e}: must be a finite number, at most {LARGEST:e} in size")]
    Value {
        /// Which sample: `x` or `y`.
        sample: &'static str,
        /// Which value, counted from 0.
        index: usize,
        /// The value found.
        value: f64,
    },
}

/// Finite and at most [`LARGEST`] in size.
pub(crate) fn is_usable(value: f64) -> bool {
    value.abs() <= LARGEST
}

/// Checks two samples that need not be equally long.
pub(crate) fn check_samples(x: &[f64], y: &[f64]) -> Result<(), SampleError> {
    for (sample, values) in [("x", x), ("y", y)] {
        if values.is_empty() {
            return Err(SampleError::Empty { sample });
        }
        if let Some(index) = values.iter().position(|&value| !is_usable(value)) {
            return Err(SampleError::Value { sample, index, value: values[index] });
        }
    }
    Ok(())
}

/// The differences `x - y` of two paired samples.
pub(crate) fn paired_differences(x: &[f64], y: &[f64]) -> Result<Vec<f64>, SampleError> {
    check_samples(x, y)?;
    if x.len() != y.len() {
        return Err(SampleError::Lengths { x: x.len(), y: y.len() });
    }
    Ok(x.iter().zip(y).map(|(x, y)| x - y).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_sample_and_the_value() {
        let message = |x: &[f64], y: &[f64]| paired_differences(x, y).expect_err("not two paired samples").to_string();
        assert_eq!(message(&[], &[1.0]), "x is empty: it must have at least one value");
        assert_eq!(message(&[1.0], &[]), "y is empty: it must have at least one value");
        assert_eq!(message(&[1.0, 2.0], &[1.0]), "x has 2 values and y has 1: pairs need equally many");
        assert_eq!(
            message(&[1.0, 2.0], &[1.0, f64::NAN]),
            "y[1] = NaN: must be a finite number, at most 1e300 in size"
        );
        assert_eq!(message(&[-f64::INFINITY], &[1.0]), "x[0] = -inf: must be a finite number, at most 1e300 in size");
    }

    #[test]
    fn differences_of_the_largest_values_are_finite() {
        assert_eq!(paired_differences(&[LARGEST], &[-LARGEST]), Ok(vec![2.0 * LARGEST]));
    }
}
