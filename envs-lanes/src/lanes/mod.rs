//! One number for each creature: the type that hides the lanes from the solver.

mod angle;

pub(crate) use angle::angle_of;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// One `f32` for each of `W` creatures that are stepped side by side.
///
/// A plain array: the loops over it have a fixed length, and become one vector instruction each where a register is wide
/// enough. Every operation is the IEEE operation of each lane alone, and none is fused with another, so a lane has the
/// same bits whatever the width and the instruction set.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lanes<const W: usize>(pub(crate) [f32; W]);

/// A yes or no for each creature: all bits set, or none.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Mask<const W: usize>([u32; W]);

impl<const W: usize> Lanes<W> {
    pub(crate) const ZERO: Self = Self([0.0; W]);
    pub(crate) const ONE: Self = Self([1.0; W]);

    #[inline(always)]
    pub(crate) fn splat(value: f32) -> Self {
        Self([value; W])
    }

    #[inline(always)]
    pub(crate) fn map(mut self, function: impl Fn(f32) -> f32) -> Self {
        for value in &mut self.0 {
            *value = function(*value);
        }
        self
    }

    #[inline(always)]
    fn zip(mut self, other: Self, function: impl Fn(f32, f32) -> f32) -> Self {
        for (value, other) in self.0.iter_mut().zip(other.0) {
            *value = function(*value, other);
        }
        self
    }

    #[inline(always)]
    fn compare(self, other: Self, holds: impl Fn(&f32, &f32) -> bool) -> Mask<W> {
        let mut mask = [0; W];
        for ((bits, value), other) in mask.iter_mut().zip(&self.0).zip(&other.0) {
            *bits = if holds(value, other) { u32::MAX } else { 0 };
        }
        Mask(mask)
    }

    /// The greater; `other` where either is no number.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    /// Limited to [`low`, `high`], for `low` ≤ `high`; NaN stays NaN.
    #[inline(always)]
    pub(crate) fn clamp(self, low: Self, high: Self) -> Self {
        let raised = self.zip(low, |a, low| if a < low { low } else { a });
        raised.zip(high, |a, high| if a > high { high } else { a })
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.map(f32::abs)
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.map(f32::sqrt)
    }

    /// The size of this number with the sign of the other.
    #[inline(always)]
    pub(crate) fn with_sign_of(self, sign: Self) -> Self {
        self.zip(sign, f32::copysign)
    }

    /// 1 / x, and 0 where |x| is below 1e-20: rapier's `simd_inv`.
    #[inline(always)]
    pub(crate) fn inverse(self) -> Self {
        self.map(|value| {
            let inverse = 1.0 / value;
            if value > -1e-20 && value < 1e-20 { 0.0 } else { inverse }
        })
    }

    #[inline(always)]
    pub(crate) fn less(self, other: Self) -> Mask<W> {
        self.compare(other, |a, b| a < b)
    }

    #[inline(always)]
    pub(crate) fn at_most(self, other: Self) -> Mask<W> {
        self.compare(other, |a, b| a <= b)
    }

    #[inline(always)]
    pub(crate) fn equal(self, other: Self) -> Mask<W> {
        self.compare(other, |a, b| a == b)
    }
}

impl<const W: usize> Mask<W> {
    pub(crate) const NONE: Self = Self([0; W]);

    /// `yes` where the mask is set, `no` elsewhere.
    #[inline(always)]
    pub(crate) fn select(self, yes: Lanes<W>, no: Lanes<W>) -> Lanes<W> {
        let mut chosen = no;
        for ((value, yes), bits) in chosen.0.iter_mut().zip(yes.0).zip(self.0) {
            *value = f32::from_bits((yes.to_bits() & bits) | (value.to_bits() & !bits));
        }
        chosen
    }

    /// The same of two masks.
    #[inline(always)]
    pub(crate) fn select_mask(self, yes: Self, no: Self) -> Self {
        let mut chosen = no;
        for ((bits, yes), own) in chosen.0.iter_mut().zip(yes.0).zip(self.0) {
            *bits = (yes & own) | (*bits & !own);
        }
        chosen
    }

    #[inline(always)]
    pub(crate) fn and(mut self, other: Self) -> Self {
        for (bits, other) in self.0.iter_mut().zip(other.0) {
            *bits &= other;
        }
        self
    }

    #[inline(always)]
    pub(crate) fn or(mut self, other: Self) -> Self {
        for (bits, other) in self.0.iter_mut().zip(other.0) {
            *bits |= other;
        }
        self
    }

    /// Set where this is and the other is not.
    #[inline(always)]
    pub(crate) fn without(mut self, other: Self) -> Self {
        for (bits, other) in self.0.iter_mut().zip(other.0) {
            *bits &= !other;
        }
        self
    }

    /// Whether it is set for any creature.
    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.0.iter().fold(0, |all, bits| all | bits) != 0
    }

    /// Whether it is set for this creature.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> bool {
        self.0[lane] != 0
    }

    pub(crate) fn set_lane(&mut self, lane: usize, set: bool) {
        self.0[lane] = if set { u32::MAX } else { 0 };
    }
}

impl<const W: usize> Add for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const W: usize> Sub for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const W: usize> Mul for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const W: usize> Div for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<const W: usize> Neg for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|value| -value)
    }
}

impl<const W: usize> AddAssign for Lanes<W> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const W: usize> SubAssign for Lanes<W> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
