use crate::sample::{SampleError, check_samples};

/// The effect size A₁₂ (Vargha & Delaney, *A Critique and Improvement of the CL Common Language Effect Size Statistics
/// of McGraw and Wong*, Journal of Educational and Behavioral Statistics 25, 2000): the probability that a value of `x`
/// is larger than a value of `y`, ties counting half.
///
/// From 0 to 1; 0.5 is no effect. The authors call 0.56, 0.64 and 0.71 a small, medium and large effect.
///
/// # Errors
/// [`SampleError`] if a sample is empty or has a value that is not finite or too large.
pub fn vargha_delaney(x: &[f64], y: &[f64]) -> Result<f64, SampleError> {
    check_samples(x, y)?;
    Ok(superiority(x, y))
}

/// The share of pairs in which the value of `x` is larger, ties counting half, of two samples that are not empty.
pub(crate) fn superiority(x: &[f64], y: &[f64]) -> f64 {
    let halves =
        |one: &f64| -> usize { y.iter().map(|other| usize::from(one > other) + usize::from(one >= other)).sum() };
    x.iter().map(halves).sum::<usize>() as f64 / (2 * x.len() * y.len()) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    /// By hand: 3.1 beats 3, 2.2 beats 1 and ties with 1, each 4.7 beats 3 and ties with 1, 5 beats all 4: 15.5 of 20.
    #[test]
    fn counts_pairs_won() {
        assert_eq!(vargha_delaney(&[3.1, 2.2, 4.7, 4.7, 5.0], &[2.2, 2.9, 4.7, 1.0]), Ok(0.775));
        assert_eq!(vargha_delaney(&[2.0], &[1.0, 0.0]), Ok(1.0));
        assert_eq!(vargha_delaney(&[2.0], &[2.0]), Ok(0.5));
    }

    #[test]
    fn errors_name_the_sample() {
        let error = vargha_delaney(&[1.0], &[]).expect_err("y is empty");
        assert_eq!(error.to_string(), "y is empty: it must have at least one value");
    }

    proptest! {
        #[test]
        fn is_antisymmetric_and_bounded(x in vec(-5..5i32, 1..20), y in vec(-5..5i32, 1..20)) {
            let [x, y] = [x, y].map(|sample| sample.into_iter().map(f64::from).collect::<Vec<_>>());
            let there = vargha_delaney(&x, &y).expect("valid samples");
            let back = vargha_delaney(&y, &x).expect("valid samples");
            prop_assert!((0.0..=1.0).contains(&there));
            prop_assert!((there + back - 1.0).abs() < 1e-12);
        }
    }
}
