use super::Lanes;
use std::f32::consts::{FRAC_PI_2, PI};

/// What is lost when π becomes an `f32`, negative.
const PI_REST: f32 = -8.742_278e-8;

/// π/4 and π/2, rounded down; what is missing is added where it counts.
const QUARTER_PI_BELOW: f32 = f32::from_bits(0x3f49_0fda);
const HALF_PI_BELOW: f32 = f32::from_bits(0x3fc9_0fda);

/// How far the bits of x and of 2²⁶ x are apart.
const TWENTY_SIX_OCTAVES: i32 = 26 << 23;

/// The angle of the direction (`cos`, `sin`), rad: to the bit what `libm::atan2f(sin, cos)` gives, for finite numbers.
///
/// The sensors of a body and rapier's joint limits use that function, so the lanes have to give its bits: the same
/// argument reduction (to the nearest of 0, ½, 1, 1½ and ∞) and the same polynomial, chosen without branches.
/// Source of the method: S. Moshier's and FreeBSD's `atanf`, from which the `libm` crate descends.
#[inline(always)]
pub(crate) fn angle_of<const W: usize>(cos: Lanes<W>, sin: Lanes<W>) -> Lanes<W> {
    let mut angle = Lanes::ZERO;
    for ((angle, cos), sin) in angle.0.iter_mut().zip(cos.0).zip(sin.0) {
        *angle = atan2(sin, cos);
    }
    angle
}

/// Without branches: every `if` chooses between two numbers that are both there.
#[inline(always)]
fn atan2(y: f32, x: f32) -> f32 {
    let (size_x, size_y) = (x.abs().to_bits(), y.abs().to_bits());
    let acute = arctangent(f32::from_bits(size_y) / f32::from_bits(size_x));
    // So flat that the quotient may be lost below the smallest numbers.
    let flat = (size_y as i32) < size_x as i32 - TWENTY_SIX_OCTAVES;
    let acute = if flat & (x < 0.0) { 0.0 } else { acute };
    let turned = PI - (acute - PI_REST);
    let angle = if x.to_bits() >> 31 == 0 { acute } else { turned };
    // libm goes another way where x is 1, and rounds one number differently there.
    let steep = (x != 1.0) & ((size_x as i32) < size_y as i32 - TWENTY_SIX_OCTAVES);
    let upright = (size_x == 0) | steep;
    let angle = if upright { FRAC_PI_2 } else { angle };
    let level = if x.to_bits() >> 31 == 0 { 0.0 } else { PI };
    let angle = if size_y == 0 { level } else { angle };
    // The function is odd in y, to the bit: every rounding above is symmetric.
    angle.copysign(y)
}

/// The arctangent of a number that is not negative.
#[inline(always)]
fn arctangent(x: f32) -> f32 {
    const A: [f32; 5] = [0.333_333_28, -0.199_991_58, 0.142_536_36, -0.106_480_174, 0.061_687_607];
    let mut top = x;
    let mut bottom = 1.0;
    let mut upper = 0.0;
    let mut lower = 0.0;
    // Each line replaces the choice of the one before it.
    let steps = [
        (0.4375, 2.0 * x - 1.0, 2.0 + x, 0.463_647_6, 5.012_158_2e-9),
        (0.6875, x - 1.0, x + 1.0, QUARTER_PI_BELOW, 3.774_894_7e-8),
        (1.1875, x - 1.5, 1.0 + 1.5 * x, 0.982_793_7, 3.447_321_7e-8),
        (2.4375, -1.0, x, HALF_PI_BELOW, 7.549_789_4e-8),
    ];
    for (from, its_top, its_bottom, its_upper, its_lower) in steps {
        let here = x >= from;
        top = if here { its_top } else { top };
        bottom = if here { its_bottom } else { bottom };
        upper = if here { its_upper } else { upper };
        lower = if here { its_lower } else { lower };
    }
    let x_reduced = top / bottom;
    let z = x_reduced * x_reduced;
    let w = z * z;
    let odd = z * (A[0] + w * (A[2] + w * A[4]));
    let even = w * (A[1] + w * A[3]);
    let correction = x_reduced * (odd + even);
    let small = x_reduced - correction;
    let large = upper - ((correction - lower) - x_reduced);
    let angle = if x < 0.4375 { small } else { large };
    if x >= 67_108_864.0 { HALF_PI_BELOW } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn same(y: f32, x: f32) {
        let (found, wanted) = (atan2(y, x), libm::atan2f(y, x));
        assert_eq!(found.to_bits(), wanted.to_bits(), "atan2({y:e}, {x:e}) = {found:e}, not {wanted:e}");
    }

    /// Directions all round, a thousandth of a degree apart, and with lengths that are not quite 1.
    #[test]
    fn has_the_bits_of_libm_all_round() {
        for step in 0..1_440_000_u32 {
            let angle = step as f32 * (std::f32::consts::TAU / 360_000.0);
            let (sin, cos) = libm::sincosf(angle);
            same(sin, cos);
            same(sin * 1.000_000_3, cos * 0.999_999_4);
        }
    }

    #[test]
    fn has_the_bits_of_libm_at_the_edges() {
        let edges = [0.0, 1e-38, 1e-20, 1e-8, 0.4375, 0.6875, 0.999_999_9, 1.0, 1.1875, 1.5, 2.4375, 1e8, 6.7e7, 1e20];
        let both = edges.iter().flat_map(|&edge| [edge, -edge]);
        for y in both.clone() {
            for x in both.clone() {
                same(y, x);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100_000))]

        #[test]
        fn has_the_bits_of_libm(y in -2.0f32..2.0, x in -2.0f32..2.0) {
            same(y, x);
        }

        #[test]
        fn has_the_bits_of_libm_for_any_number(y in proptest::num::f32::NORMAL | proptest::num::f32::ZERO,
                                               x in proptest::num::f32::NORMAL | proptest::num::f32::ZERO) {
            same(y, x);
        }
    }
}
