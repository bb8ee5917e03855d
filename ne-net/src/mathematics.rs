//! Portable elementary functions: additions, multiplications, divisions and bit operations only, no branches, so that
//! loops over them become vector instructions.
//!
//! NaN goes in, NaN comes out: limits are written as comparisons, since `f32::clamp` and `f32::min` treat NaN in ways of
//! their own.

/// Adding and subtracting this rounds a number of at most 2²² to the nearest integer, which then stands in the lowest
/// bits of the sum.
const ROUNDER: f32 = 12_582_912.0; // 1.5 * 2^23

/// The same for `f64`, up to 2⁵¹.
const ROUNDER_64: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52

/// eˣ with a relative error below 3e-7. Beyond ±87 the value at ±87, which keeps it finite and above 0.
#[inline(always)]
pub(crate) fn exp(x: f32) -> f32 {
    let (power, rest) = exp_parts(limit(x, -87.0, 87.0));
    power + power * rest
}

/// tanh x with an error below 2e-7 relative to the value, everywhere; exactly odd.
#[inline(always)]
pub(crate) fn tanh(x: f32) -> f32 {
    // tanh |x| = (1 - t) / (1 + t) with t = exp(-2|x|) = power + power * rest. Taken apart like this nothing cancels:
    // near zero the power is 1 and the numerator is the small rest alone. Beyond 10, tanh is 1 as an f32 has it.
    let size = limit(x.abs(), 0.0, 10.0);
    let (power, rest) = exp_parts(-2.0 * size);
    let small = power * rest;
    (((1.0 - power) - small) / ((1.0 + power) + small)).copysign(x)
}

/// sin x with an error below 1e-6 for |x| up to 2³¹; beyond 2³² the value there. Exactly odd; NaN for infinities.
#[inline(always)]
pub(crate) fn sin(x: f32) -> f32 {
    // x - n * pi in f64. The upper part of pi has 33 bits, so that its product with an n of up to 20 bits is exact.
    const PI_UPPER: f64 = 3.141_592_653_468_251_2;
    const PI_LOWER: f64 = 1.215_420_109_760_201e-10;
    // Taylor; the next term is below 7e-10 at pi / 2.
    const C3: f64 = -1.0 / 6.0;
    const C5: f64 = 1.0 / 120.0;
    const C7: f64 = -1.0 / 5_040.0;
    const C9: f64 = 1.0 / 362_880.0;
    const C11: f64 = -1.0 / 39_916_800.0;
    const C13: f64 = 1.0 / 6_227_020_800.0;
    let size = f64::from(limit(x.abs(), 0.0, 4_294_967_296.0));
    let rounded = size * core::f64::consts::FRAC_1_PI + ROUNDER_64;
    let turns = rounded - ROUNDER_64;
    let r = (size - turns * PI_UPPER) - turns * PI_LOWER;
    let r2 = r * r;
    let sine = r + r * r2 * (C3 + r2 * (C5 + r2 * (C7 + r2 * (C9 + r2 * (C11 + r2 * C13)))));
    // Half turns flip the sign, and so does a negative x. The last term is 0, or NaN for an infinite x.
    let flips = ((rounded.to_bits() as u32) << 31) ^ (x.to_bits() & 0x8000_0000);
    f32::from_bits((sine as f32).to_bits() ^ flips) + x * 0.0
}

/// `x` limited to the range; NaN stays NaN.
#[inline(always)]
pub(crate) fn limit(x: f32, low: f32, high: f32) -> f32 {
    let x = if x < low { low } else { x };
    if x > high { high } else { x }
}

/// (2ⁿ, eʳ - 1) with n the integer nearest to x / ln 2 and x = n ln 2 + r, for |x| ≤ 87: eˣ is `power + power * rest`.
///
/// Source of the reduction: Cody & Waite, *Software Manual for the Elementary Functions*, 1980. The series is Taylor's:
/// on |r| ≤ ln 2 / 2 the first term left out is below 6e-9.
#[inline(always)]
fn exp_parts(x: f32) -> (f32, f32) {
    // The upper part of ln 2 has 9 bits, so that its product with n is exact.
    const LN_2_UPPER: f32 = 355.0 / 512.0;
    const LN_2_LOWER: f32 = -2.121_944_4e-4;
    const C2: f32 = 1.0 / 2.0;
    const C3: f32 = 1.0 / 6.0;
    const C4: f32 = 1.0 / 24.0;
    const C5: f32 = 1.0 / 120.0;
    const C6: f32 = 1.0 / 720.0;
    const C7: f32 = 1.0 / 5_040.0;
    let rounded = x * core::f32::consts::LOG2_E + ROUNDER;
    let n = rounded - ROUNDER;
    let r = (x - n * LN_2_UPPER) - n * LN_2_LOWER;
    // In pairs, which do not wait for each other.
    let r2 = r * r;
    let rest = r + r2 * ((C2 + r * C3) + r2 * ((C4 + r * C5) + r2 * (C6 + r * C7)));
    let power = f32::from_bits((rounded.to_bits() << 23).wrapping_add(0x3f80_0000));
    (power, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every 997th of all the finite numbers of a sign, and the other sign.
    fn numbers(largest: f32) -> impl Iterator<Item = f32> {
        (0..=largest.to_bits()).step_by(997).map(f32::from_bits).flat_map(|x| [x, -x])
    }

    #[test]
    fn tanh_is_close_everywhere_and_odd() {
        for x in numbers(f32::MAX) {
            let (found, wanted) = (f64::from(tanh(x)), libm::tanh(f64::from(x)));
            assert!((found - wanted).abs() <= 2e-7 * wanted.abs() + 1e-37, "tanh {x} = {found}, not {wanted}");
            assert_eq!(tanh(-x), -tanh(x));
            assert!(found.abs() <= 1.0);
        }
    }

    #[test]
    fn exp_is_close_and_finite() {
        for x in numbers(87.0) {
            let (found, wanted) = (f64::from(exp(x)), libm::exp(f64::from(x)));
            assert!((found - wanted).abs() <= 3e-7 * wanted, "exp {x} = {found}, not {wanted}");
        }
        for x in numbers(f32::MAX) {
            assert!(exp(x).is_finite() && exp(x) > 0.0);
        }
    }

    #[test]
    fn sin_is_close_bounded_and_odd() {
        for x in numbers(2_147_483_648.0) {
            let (found, wanted) = (f64::from(sin(x)), libm::sin(f64::from(x)));
            assert!((found - wanted).abs() <= 1e-6, "sin {x} = {found}, not {wanted}");
        }
        for x in numbers(100.0) {
            let (found, wanted) = (f64::from(sin(x)), libm::sin(f64::from(x)));
            assert!((found - wanted).abs() <= 1e-7, "sin {x} = {found}, not {wanted}");
        }
        for x in numbers(f32::MAX) {
            assert!(sin(x).abs() <= 1.0);
            assert_eq!(sin(-x), -sin(x));
        }
    }

    #[test]
    fn nan_stays_nan() {
        for function in [exp, tanh, sin] {
            assert!(function(f32::NAN).is_nan());
        }
        assert!(sin(f32::INFINITY).is_nan());
        assert_eq!((tanh(f32::INFINITY), tanh(f32::NEG_INFINITY)), (1.0, -1.0));
    }
}
