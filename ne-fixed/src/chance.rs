//! Random numbers with portable maths: the same bits on every platform, which distributions that use the system's
//! logarithm do not promise.

use ne_core::RandomStream;
use rand::{Rng, RngExt};

/// Calls `visit` with each index below `count` that is chosen, each with probability `rate` (from 0 to 1),
/// independently, in ascending order.
///
/// The gaps between chosen indices follow a geometric distribution, so the cost grows with the number of chosen.
/// Source: Devroye, *Non-Uniform Random Variate Generation*, 1986, X.2.
#[inline]
pub(crate) fn for_each_chosen(
    rate: f64,
    count: usize,
    stream: &mut RandomStream,
    mut visit: impl FnMut(usize, &mut RandomStream),
) {
    if rate >= 1.0 {
        return (0..count).for_each(|index| visit(index, stream));
    }
    if rate <= 0.0 {
        return;
    }
    let per_index = 1.0 / libm::log1p(-rate);
    let mut index = gap(per_index, stream);
    while index < count {
        visit(index, stream);
        index = index.saturating_add(1).saturating_add(gap(per_index, stream));
    }
}

/// How many are passed over before the next is chosen; `per_index` is 1 / ln(1 - rate).
fn gap(per_index: f64, stream: &mut RandomStream) -> usize {
    // From 2^-32 to 1: never 0, whose logarithm is infinite.
    let uniform = (f64::from(stream.next_u32()) + 1.0) * (1.0 / 4_294_967_296.0);
    (libm::log(uniform) * per_index) as usize
}

/// Uniform from -1 (included) to 1 (excluded).
#[inline]
pub(crate) fn symmetric(stream: &mut RandomStream) -> f32 {
    2.0 * stream.random::<f32>() - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};

    fn stream(seed: u64) -> RandomStream {
        Seed::of_run(seed).stream(Purpose::new("test"))
    }

    #[test]
    fn each_index_is_chosen_with_its_rate() {
        for rate in [0.001, 0.1, 0.5, 0.9, 0.999] {
            let (mut counts, mut stream) = ([0_u32; 50], stream(1));
            for _ in 0..20_000 {
                for_each_chosen(rate, counts.len(), &mut stream, |index, _| counts[index] += 1);
            }
            let deviation = (20_000.0 * rate * (1.0 - rate)).sqrt();
            for count in counts {
                assert!((f64::from(count) - 20_000.0 * rate).abs() < 4.5 * deviation, "{rate}: {counts:?}");
            }
        }
    }

    #[test]
    fn rates_0_and_1_are_none_and_all() {
        for (rate, expected) in [(0.0, 0), (1.0, 50), (1e-300, 0)] {
            let mut chosen = Vec::new();
            for_each_chosen(rate, 50, &mut stream(1), |index, _| chosen.push(index));
            assert_eq!(chosen, (0..expected).collect::<Vec<_>>());
        }
    }
}
