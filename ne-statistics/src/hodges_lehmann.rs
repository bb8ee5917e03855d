use crate::{
    quantile::{quantile_of_sorted, sorted},
    sample::{SampleError, paired_differences},
};

/// The Hodges–Lehmann estimate of the shift between paired samples (Hodges & Lehmann, *Estimates of Location Based on
/// Rank Tests*, Annals of Mathematical Statistics 34, 1963): by how much `x` is larger than `y`, in the unit of both.
///
/// The median of the Walsh averages (dᵢ + dⱼ) / 2, i ≤ j, of the differences d = x − y, zero differences included. It
/// belongs to the Wilcoxon signed-rank test: the shift at which the test sees no difference. Time and memory grow with
/// the square of the number of pairs.
///
/// # Errors
/// [`SampleError`] if the samples are empty or differ in length, or have a value that is not finite or too large.
pub fn hodges_lehmann(x: &[f64], y: &[f64]) -> Result<f64, SampleError> {
    let differences = paired_differences(x, y)?;
    let mut averages = Vec::with_capacity(differences.len() * (differences.len() + 1) / 2);
    for (index, one) in differences.iter().enumerate() {
        averages.extend(differences[index..].iter().map(|other| (one + other) / 2.0));
    }
    Ok(quantile_of_sorted(&sorted(&averages), 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wilcoxon::testing::{DARWIN, DEPRESSION};
    use proptest::{collection::vec, prelude::*};

    #[test]
    fn is_the_median_of_walsh_averages() {
        // Averages -2, 0, 2, 2, 4, 6.
        assert_eq!(hodges_lehmann(&[-2.0, 2.0, 6.0], &[0.0; 3]), Ok(2.0));
        assert_eq!(hodges_lehmann(&DARWIN, &[0.0; 15]), Ok(25.0));
        let shift = hodges_lehmann(&DEPRESSION.0, &DEPRESSION.1).expect("valid samples");
        assert!((shift - 0.46).abs() < 1e-12);
    }

    #[test]
    fn errors_are_those_of_pairs() {
        let error = hodges_lehmann(&[1.0, 2.0], &[1.0]).expect_err("lengths differ");
        assert_eq!(error.to_string(), "x has 2 values and y has 1: pairs need equally many");
    }

    proptest! {
        #[test]
        fn moves_with_a_shift_and_turns_with_the_sign(pairs in vec((-50..50i32, -50..50i32), 1..20), shift in -50..50i32) {
            let (x, y): (Vec<f64>, Vec<f64>) = pairs.iter().map(|&(x, y)| (f64::from(x), f64::from(y))).unzip();
            let estimate = hodges_lehmann(&x, &y).expect("valid samples");
            let moved: Vec<f64> = x.iter().map(|x| x + f64::from(shift)).collect();
            prop_assert_eq!(hodges_lehmann(&moved, &y).expect("valid samples"), estimate + f64::from(shift));
            prop_assert_eq!(hodges_lehmann(&y, &x).expect("valid samples"), -estimate);
            let back: (Vec<f64>, Vec<f64>) = (x.into_iter().rev().collect(), y.into_iter().rev().collect());
            prop_assert_eq!(hodges_lehmann(&back.0, &back.1).expect("valid samples"), estimate);
        }
    }
}
