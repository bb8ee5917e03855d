//! Shares of counts, as people mean them.

/// 0.07 × 100 is 7.000000000000001 in binary, and 0.57 × 100 is 56.99999999999999: a share of a count that misses a whole
/// number by so little means it.
const CLOSE: f64 = 1e-9;

/// This share of a count, rounded up: 0.07 of 100 is 7. Of a share above 0 at least one, where there is one.
pub fn share_rounded_up(share: f64, count: usize) -> usize {
    let least = usize::from(share > 0.0 && count > 0);
    ((share * count as f64 - CLOSE).ceil() as usize).max(least)
}

/// This share of a count, rounded down: 0.57 of 100 is 57.
pub fn share_rounded_down(share: f64, count: usize) -> usize {
    (share * count as f64 + CLOSE).floor() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_in_per_cent_of_a_hundred_is_that_number() {
        for percent in 0..=100 {
            let share = f64::from(percent) / 100.0;
            assert_eq!([share_rounded_up(share, 100), share_rounded_down(share, 100)], [percent as usize; 2]);
        }
        assert_eq!([share_rounded_up(1e-12, 10), share_rounded_up(1e-12, 0), share_rounded_up(0.0, 10)], [1, 0, 0]);
        assert_eq!([share_rounded_up(0.25, 10), share_rounded_down(0.25, 10)], [3, 2]);
    }
}
