use ne_core::SettingError;

/// Holm's step-down correction for several tests (Holm, *A Simple Sequentially Rejective Multiple Test Procedure*,
/// Scandinavian Journal of Statistics 6, 1979): the adjusted p values, in the order given.
///
/// With *m* tests the k-th smallest p value, k from 1, is multiplied by m − k + 1; an adjusted value is at least the one
/// before it and at most 1. Rejecting what is at most α keeps the probability of any false rejection at α, however the
/// tests depend on each other. It rejects all that Bonferroni's correction does, and sometimes more.
///
/// # Errors
/// The error names the first p value that is not from 0 to 1.
pub fn holm(p_values: &[f64]) -> Result<Vec<f64>, SettingError> {
    for (index, &p) in p_values.iter().enumerate() {
        SettingError::check_range(&format!("p_values[{index}]"), p, 0.0, 1.0)?;
    }
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|&one, &other| p_values[one].total_cmp(&p_values[other]));
    let mut adjusted = vec![0.0; p_values.len()];
    let mut highest = 0.0_f64;
    for (position, &index) in order.iter().enumerate() {
        let remaining = (p_values.len() - position) as f64;
        highest = highest.max((remaining * p_values[index]).min(1.0));
        adjusted[index] = highest;
    }
    Ok(adjusted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    /// By hand: 4 · 1/128, 3 · 1/64, 2 · 1/32, then 1 · 3/64 raised to the value before it.
    #[test]
    fn of_four_p_values() {
        assert_eq!(
            holm(&[1.0 / 64.0, 3.0 / 64.0, 1.0 / 32.0, 1.0 / 128.0]),
            Ok(vec![0.046875, 0.0625, 0.0625, 0.03125])
        );
        assert_eq!(holm(&[0.75, 0.625]), Ok(vec![1.0, 1.0]));
        assert_eq!(holm(&[]), Ok(vec![]));
    }

    #[test]
    fn errors_name_the_p_value() {
        for (p, found) in [(1.5, "1.5"), (-0.1, "-0.1"), (f64::NAN, "NaN")] {
            let error = holm(&[0.5, p]).expect_err("out of range");
            assert_eq!(error.to_string(), format!("p_values[1] = {found}: must be from 0 to 1"));
        }
    }

    proptest! {
        #[test]
        fn is_between_the_p_value_and_bonferroni(p_values in vec(0.0..=1.0f64, 1..10)) {
            let adjusted = holm(&p_values).expect("p values");
            for (p, adjusted) in p_values.iter().zip(&adjusted) {
                prop_assert!(p <= adjusted && *adjusted <= (p * p_values.len() as f64).min(1.0));
            }
        }

        #[test]
        fn keeps_order_and_follows_permutations(p_values in vec(0.0..=1.0f64, 1..10)) {
            let adjusted = holm(&p_values).expect("p values");
            let mut pairs: Vec<(f64, f64)> = p_values.iter().copied().zip(adjusted.iter().copied()).collect();
            pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
            prop_assert!(pairs.is_sorted_by(|one, other| one.1 <= other.1));
            let reversed: Vec<f64> = p_values.into_iter().rev().collect();
            let back: Vec<f64> = holm(&reversed).expect("p values").into_iter().rev().collect();
            prop_assert_eq!(adjusted, back);
        }
    }
}
