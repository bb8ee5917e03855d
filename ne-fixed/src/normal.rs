use ne_core::RandomStream;
use rand::{Rng, RngExt};
use std::sync::LazyLock;

/// A source of normally distributed numbers with mean 0 and deviation 1: the ziggurat method, whose usual case is one
/// multiplication, one comparison and no logarithm.
///
/// Source: Marsaglia & Tsang, *The Ziggurat Method for Generating Random Variables*, Journal of Statistical Software
/// 5(8), 2000; in the form of Doornik, *An Improved Ziggurat Method to Generate Normal Random Samples*, 2005, which
/// takes layer and position from different bits.
#[derive(Clone, Copy)]
pub(crate) struct Normal {
    ziggurat: &'static Ziggurat,
}

/// The upper half of the bell curve exp(-x²/2), covered by layers of equal area. The lowest has the curve's tail in it.
struct Ziggurat {
    /// The width of each layer, widest first, and a last width of 0. The lowest layer is as wide as its area over its
    /// height, and so wider than the place where its tail begins.
    widths: [f32; LAYERS + 1],
    /// The share of a layer's width that lies under the curve for certain: the width of the layer above.
    safe: [f32; LAYERS],
    /// How high the curve is at each width.
    heights: [f32; LAYERS + 1],
}

const LAYERS: usize = 128;
/// Where the tail begins, and the area of each layer, for 128 layers: constants of the paper.
const TAIL: f64 = 3.442_619_855_899;
const AREA: f64 = 9.912_563_035_262_17e-3;

static ZIGGURAT: LazyLock<Ziggurat> = LazyLock::new(Ziggurat::new);

impl Normal {
    pub(crate) fn new() -> Self {
        Self { ziggurat: &ZIGGURAT }
    }

    /// The next number; never farther from 0 than 10.
    #[inline]
    pub(crate) fn next(self, stream: &mut RandomStream) -> f32 {
        loop {
            let bits = stream.next_u32();
            let layer = bits as usize % LAYERS;
            // The upper 24 bits, from -1 to 1.
            let share = (bits >> 8) as f32 * (1.0 / 8_388_608.0) - 1.0;
            let x = share * self.ziggurat.widths[layer];
            if share.abs() < self.ziggurat.safe[layer] {
                return x;
            }
            if let Some(x) = self.edge(layer, x, stream) {
                return x;
            }
        }
    }

    /// A number from the part of a layer that the curve cuts through, if `x` falls under the curve.
    #[cold]
    fn edge(self, layer: usize, x: f32, stream: &mut RandomStream) -> Option<f32> {
        if layer == 0 {
            return Some(tail(stream).copysign(x));
        }
        let (low, high) = (self.ziggurat.heights[layer], self.ziggurat.heights[layer + 1]);
        (low + stream.random::<f32>() * (high - low) < height(x)).then_some(x)
    }
}

/// The bell curve.
fn height(x: f32) -> f32 {
    libm::expf(-0.5 * x * x)
}

/// A number from the tail. Source: Marsaglia, *Generating a Variable from the Tail of the Normal Distribution*,
/// Technometrics 6(1), 1964.
fn tail(stream: &mut RandomStream) -> f32 {
    let mut exponential = || -libm::logf(1.0 - stream.random::<f32>());
    loop {
        let beyond = exponential() / TAIL as f32;
        if 2.0 * exponential() >= beyond * beyond {
            return TAIL as f32 + beyond;
        }
    }
}

impl Ziggurat {
    fn new() -> Self {
        let exact_height = |width: f64| libm::exp(-0.5 * width * width);
        let mut exact = [0.0; LAYERS + 1];
        exact[0] = AREA / exact_height(TAIL);
        exact[1] = TAIL;
        for layer in 2..LAYERS {
            let below: f64 = exact[layer - 1];
            exact[layer] = (-2.0 * libm::log(AREA / below + exact_height(below))).sqrt();
        }
        let widths = exact.map(|width| width as f32);
        let safe = std::array::from_fn(|layer| (exact[layer + 1] / exact[layer]) as f32);
        Self { widths, safe, heights: widths.map(height) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};

    fn numbers() -> Vec<f64> {
        let (normal, mut stream) = (Normal::new(), Seed::of_run(2).stream(Purpose::new("test")));
        (0..1_000_000).map(|_| f64::from(normal.next(&mut stream))).collect()
    }

    #[test]
    fn moments_are_normal() {
        let numbers = numbers();
        let moment = |power| numbers.iter().map(|x| x.powi(power)).sum::<f64>() / numbers.len() as f64;
        for (power, expected, tolerance) in [(1, 0.0, 0.004), (2, 1.0, 0.006), (3, 0.0, 0.016), (4, 3.0, 0.04)] {
            assert!((moment(power) - expected).abs() < tolerance, "moment {power}: {}", moment(power));
        }
    }

    #[test]
    fn shares_are_normal_in_the_middle_and_in_the_tails() {
        let numbers = numbers();
        for step in -40..=40 {
            let bound = f64::from(step) * 0.1;
            let expected = 0.5 * libm::erfc(-bound / std::f64::consts::SQRT_2);
            let found = numbers.iter().filter(|&&x| x < bound).count() as f64 / 1e6;
            let deviation = (expected * (1.0 - expected) / 1e6).sqrt();
            assert!((found - expected).abs() < 4.0 * deviation, "below {bound}: {found}, expected {expected}");
        }
    }

    #[test]
    fn layers_have_equal_areas() {
        let ziggurat = Ziggurat::new();
        let height = |width: f32| libm::exp(-0.5 * f64::from(width).powi(2));
        for pair in ziggurat.widths[1..].windows(2) {
            let area = f64::from(pair[0]) * (height(pair[1]) - height(pair[0]));
            assert!((area - AREA).abs() < 1e-6, "{area}");
        }
    }
}
