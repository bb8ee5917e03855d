/// The quantile of `values` at `share` (0 the lowest, 0.5 the median, 1 the highest), with linear interpolation between
/// neighbours: type 7 of Hyndman & Fan, *Sample Quantiles in Statistical Packages*, The American Statistician 50, 1996.
///
/// `None` if there are no values, if one of them or `share` is NaN, or if the quantile lies between −∞ and ∞. Between a
/// finite value and an infinite one it is infinite. A share below 0 or above 1 gives the lowest or highest.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    if values.is_empty() || share.is_nan() || values.iter().any(|value| value.is_nan()) {
        return None;
    }
    Some(quantile_of_sorted(&sorted(values), share)).filter(|quantile| !quantile.is_nan())
}

/// The same values, ascending.
pub(crate) fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// The quantile at `share` of ascending values, of which there is at least one; NaN between −∞ and ∞.
pub(crate) fn quantile_of_sorted(sorted: &[f64], share: f64) -> f64 {
    let position = share.clamp(0.0, 1.0) * (sorted.len() - 1) as f64;
    let (low, high, way) = (sorted[position.floor() as usize], sorted[position.ceil() as usize], position.fract());
    match high - low {
        // Infinite ones, too, which have no difference.
        _ if low == high => low,
        // Rounding must not lead past the upper neighbour.
        difference if difference.is_finite() => (low + difference * way).min(high),
        _ => low * (1.0 - way) + high * way,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    /// The same as `numpy.percentile([4, 1, 3, 9], [10, 25, 50, 75])`.
    #[test]
    fn interpolates_between_neighbours() {
        let at = |share| quantile(&[4.0, 1.0, 3.0, 9.0], share).expect("there are values");
        assert_eq!([at(0.1), at(0.25), at(0.5), at(0.75)], [1.6, 2.5, 3.5, 5.25]);
        assert_eq!([at(-1.0), at(0.0), at(1.0), at(2.0)], [1.0, 1.0, 9.0, 9.0]);
    }

    #[test]
    fn is_none_without_an_answer() {
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(quantile(&[1.0], f64::NAN), None);
        assert_eq!(quantile(&[1.0, f64::NAN], 0.5), None);
        assert_eq!(quantile(&[7.0], 0.3), Some(7.0));
        assert_eq!(quantile(&[f64::NEG_INFINITY, f64::INFINITY], 0.5), None);
    }

    #[test]
    fn infinite_values_and_differences_have_their_place() {
        let (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
        let median = |values: &[f64]| quantile(values, 0.5).expect("there are values");
        assert_eq!(median(&[least, 5.0]), least);
        assert_eq!(median(&[5.0, most]), most);
        assert_eq!(median(&[least, 5.0, most]), 5.0);
        assert_eq!(median(&[most, most]), most);
        assert_eq!(median(&[f64::MIN, f64::MAX]), 0.0);
    }

    proptest! {
        #[test]
        fn lies_within_the_values_and_never_falls(
            values in vec(-1e3..1e3f64, 1..30), a in 0.0..=1.0f64, b in 0.0..=1.0f64,
        ) {
            let at = |share| quantile(&values, share).expect("there are values");
            let (lower, upper) = (at(a.min(b)), at(a.max(b)));
            prop_assert!(at(0.0) <= lower && lower <= upper && upper <= at(1.0));
        }
    }
}
