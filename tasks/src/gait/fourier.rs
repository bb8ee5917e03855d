//! The fast Fourier transform. With sines of `libm`, and always in the same order: libraries that choose instructions when
//! the program runs round otherwise on other machines, and a verdict would be another one there.

use std::f64::consts::PI;

/// Real and imaginary part.
pub(super) type Complex = [f64; 2];

/// Transforms of one length, a power of 2.
pub(super) struct Fourier {
    /// For each stage, the largest first: the roots of unity of its butterflies.
    roots: Vec<Vec<Complex>>,
    length: usize,
}

impl Fourier {
    /// For at least so many numbers: the next power of 2.
    pub(super) fn new(least: usize) -> Self {
        let length = least.next_power_of_two();
        let mut roots = Vec::new();
        let mut half = length / 2;
        while half > 0 {
            roots.push((0..half).map(|index| turned(-PI * index as f64 / half as f64)).collect());
            half /= 2;
        }
        Self { roots, length }
    }

    /// How many numbers it transforms.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// The transform in place, in bit-reversed order: what comes out for frequency k is at the place that k has with its
    /// bits the other way round.
    pub(super) fn forward(&self, values: &mut [Complex]) {
        for roots in &self.roots {
            for block in values.chunks_exact_mut(2 * roots.len()) {
                let (low, high) = block.split_at_mut(roots.len());
                for ((low, high), root) in low.iter_mut().zip(high).zip(roots) {
                    let difference = [low[0] - high[0], low[1] - high[1]];
                    *low = [low[0] + high[0], low[1] + high[1]];
                    *high = times(difference, *root);
                }
            }
        }
    }

    /// The sum over all frequencies, from bit-reversed order back to the order of time: `forward` undone, but for a factor
    /// of the length.
    pub(super) fn backward(&self, values: &mut [Complex]) {
        for roots in self.roots.iter().rev() {
            for block in values.chunks_exact_mut(2 * roots.len()) {
                let (low, high) = block.split_at_mut(roots.len());
                for ((low, high), root) in low.iter_mut().zip(high).zip(roots) {
                    let turned = times(*high, [root[0], -root[1]]);
                    *high = [low[0] - turned[0], low[1] - turned[1]];
                    *low = [low[0] + turned[0], low[1] + turned[1]];
                }
            }
        }
    }
}

/// 1, turned by an angle, rad.
pub(super) fn turned(angle: f64) -> Complex {
    [libm::cos(angle), libm::sin(angle)]
}

pub(super) fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// The square of the magnitude.
pub(super) fn power(value: Complex) -> f64 {
    value[0] * value[0] + value[1] * value[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_it_is_short_for() {
        let values: Vec<Complex> = (0..16).map(|index| [libm::sin(f64::from(index * index)), 0.1]).collect();
        let fourier = Fourier::new(11);
        assert_eq!(fourier.length(), 16);
        let mut transformed = values.clone();
        fourier.forward(&mut transformed);
        for frequency in 0..16_usize {
            let mut wanted = [0.0, 0.0];
            for (index, &value) in values.iter().enumerate() {
                let term = times(value, turned(-2.0 * PI * (frequency * index % 16) as f64 / 16.0));
                wanted = [wanted[0] + term[0], wanted[1] + term[1]];
            }
            let found = transformed[frequency.reverse_bits() >> (usize::BITS - 4)];
            assert!((found[0] - wanted[0]).abs() + (found[1] - wanted[1]).abs() < 1e-12, "{found:?} {wanted:?}");
        }
        fourier.backward(&mut transformed);
        for (back, value) in transformed.iter().zip(&values) {
            assert!((back[0] / 16.0 - value[0]).abs() + (back[1] / 16.0 - value[1]).abs() < 1e-14);
        }
    }
}
