use crate::mathematics::{exp, limit, sin, tanh};
use core::fmt;
#[cfg(feature = "nets")]
use serde::{Deserialize, Serialize};

/// The function that turns the weighted sum `a` of a neuron into its output.
///
/// All of them give the same bits on every platform, a finite output for every finite sum, and NaN for NaN. Errors are
/// against the exact function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "nets", derive(Serialize, Deserialize), serde(rename_all = "kebab-case"))]
pub enum Activation {
    /// 1 / (1 + e⁻ᵃ), from 0 to 1; error below 1e-6.
    Logistic,
    /// tanh a, from -1 to 1; error below 1e-6. The default, and what the thesis used in the end.
    #[default]
    Tanh,
    /// a(27 + a²) / (27 + 9a²), and ±1 for |a| ≥ 3: the thesis' cheap stand-in for tanh, at most 0.024 away from it.
    RationalTanh,
    /// The greater of a and 0.
    Relu,
    /// a itself.
    Linear,
    /// sin a, with a in radians; error below 1e-6 for |a| up to 2³¹ and constant beyond 2³². NaN for infinities.
    Sine,
    /// exp(-a²), from 0 to 1; error below 1e-6.
    Gaussian,
    /// 1 / (1 + e⁻⁴·⁹ᵃ), from 0 to 1; error below 1e-6: the activation of Stanley & Miikkulainen, 2002, section 4.1.
    SteepLogistic,
    /// tanh 2.45a, from -1 to 1; error below 1e-6: the [`SteepLogistic`](Self::SteepLogistic) stretched to ±1, for
    /// outputs that drive motors both ways.
    SteepTanh,
}

impl Activation {
    /// All activations.
    pub const ALL: [Self; 9] = [
        Self::Logistic,
        Self::Tanh,
        Self::RationalTanh,
        Self::Relu,
        Self::Linear,
        Self::Sine,
        Self::Gaussian,
        Self::SteepLogistic,
        Self::SteepTanh,
    ];

    /// The output of a neuron with the weighted sum `a`.
    #[inline]
    pub fn apply(self, a: f32) -> f32 {
        match self {
            Self::Logistic => logistic(a),
            Self::Tanh => tanh(a),
            Self::RationalTanh => rational_tanh(a),
            Self::Relu => relu(a),
            Self::Linear => a,
            Self::Sine => sin(a),
            Self::Gaussian => gaussian(a),
            Self::SteepLogistic => steep_logistic(a),
            Self::SteepTanh => steep_tanh(a),
        }
    }

    /// Replaces each weighted sum by the neuron's output: [`apply`](Self::apply) to each, to the bit, and faster.
    #[inline]
    pub fn apply_all(self, sums: &mut [f32]) {
        // Blocks of a fixed length become vector instructions without a rest.
        let (blocks, rest) = sums.as_chunks_mut::<8>();
        for block in blocks {
            self.apply_to_lanes(block);
        }
        let (halves, rest) = rest.as_chunks_mut::<4>();
        for half in halves {
            self.apply_to_lanes(half);
        }
        for sum in rest {
            *sum = self.apply(*sum);
        }
    }

    /// The same for sums side by side, of as many nets or neurons.
    // Always inlined, so that it is compiled for the instruction set of its caller.
    #[inline(always)]
    pub fn apply_to_lanes<const LANES: usize>(self, sums: &mut [f32; LANES]) {
        match self {
            Self::Logistic => replace(sums, logistic),
            Self::Tanh => replace(sums, tanh),
            Self::RationalTanh => replace(sums, rational_tanh),
            Self::Relu => replace(sums, relu),
            Self::Linear => {}
            Self::Sine => replace(sums, sin),
            Self::Gaussian => replace(sums, gaussian),
            Self::SteepLogistic => replace(sums, steep_logistic),
            Self::SteepTanh => replace(sums, steep_tanh),
        }
    }

    /// The least and the greatest output for finite sums, both included; infinite where there is no bound.
    pub fn range(self) -> (f32, f32) {
        match self {
            Self::Logistic | Self::Gaussian | Self::SteepLogistic => (0.0, 1.0),
            Self::Tanh | Self::RationalTanh | Self::Sine | Self::SteepTanh => (-1.0, 1.0),
            Self::Relu => (0.0, f32::INFINITY),
            Self::Linear => (f32::NEG_INFINITY, f32::INFINITY),
        }
    }

    /// The name a file has for it: `rational-tanh`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Logistic => "logistic",
            Self::Tanh => "tanh",
            Self::RationalTanh => "rational-tanh",
            Self::Relu => "relu",
            Self::Linear => "linear",
            Self::Sine => "sine",
            Self::Gaussian => "gaussian",
            Self::SteepLogistic => "steep-logistic",
            Self::SteepTanh => "steep-tanh",
        }
    }
}

impl fmt::Display for Activation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[inline(always)]
fn replace<const LANES: usize>(sums: &mut [f32; LANES], function: impl Fn(f32) -> f32) {
    for sum in sums {
        *sum = function(*sum);
    }
}

#[inline(always)]
fn logistic(a: f32) -> f32 {
    1.0 / (1.0 + exp(-a))
}

#[inline(always)]
fn steep_logistic(a: f32) -> f32 {
    logistic(4.9 * a)
}

#[inline(always)]
fn steep_tanh(a: f32) -> f32 {
    tanh(2.45 * a)
}

#[inline(always)]
fn rational_tanh(a: f32) -> f32 {
    // At ±3 the expression is exactly ±1, and flat: next to it, rounding may step over 1.
    let a = limit(a, -3.0, 3.0);
    let square = a * a;
    limit(a * (27.0 + square) / (27.0 + 9.0 * square), -1.0, 1.0)
}

#[inline(always)]
fn relu(a: f32) -> f32 {
    // Not `max`, which would make a 0 of NaN.
    if a < 0.0 { 0.0 } else { a }
}

#[inline(always)]
fn gaussian(a: f32) -> f32 {
    exp(-(a * a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SUMS: [f32; 8] = [0.0, 0.1, -0.7, 1.0, -2.5, 3.0, 12.25, -100.0];

    /// Golden: other bits are other runs, and champions that no longer repeat theirs.
    #[test]
    fn bits_are_the_same_for_ever() {
        #[rustfmt::skip]
        let golden: [(Activation, [u32; 8]); 9] = [
            (Activation::Logistic, [0x3f00_0000, 0x3f06_6509, 0x3ea9_e34b, 0x3f3b_26a8, 0x3d9b_5b88, 0x3f73_dbe6, 0x3f7f_ffb0, 0x00b3_3688]),
            (Activation::Tanh, [0, 0x3dcc_1ebc, 0xbf1a_b7d9, 0x3f42_f7d5, 0xbf7c_92c1, 0x3f7e_bbe9, 0x3f80_0000, 0xbf80_0000]),
            (Activation::RationalTanh, [0, 0x3dcc_31f9, 0xbf1c_d5ee, 0x3f47_1c72, 0xbf7f_9d99, 0x3f80_0000, 0x3f80_0000, 0xbf80_0000]),
            (Activation::Relu, [0, 0x3dcc_cccd, 0, 0x3f80_0000, 0, 0x4040_0000, 0x4144_0000, 0]),
            (Activation::Linear, [0, 0x3dcc_cccd, 0xbf33_3333, 0x3f80_0000, 0xc020_0000, 0x4040_0000, 0x4144_0000, 0xc2c8_0000]),
            (Activation::Sine, [0, 0x3dcc_7577, 0xbf24_eb73, 0x3f57_6aa4, 0xbf19_3578, 0x3e10_81c3, 0xbe9f_4b09, 0x3f01_a12e]),
            (Activation::Gaussian, [0x3f80_0000, 0x3f7d_73e8, 0x3f1c_d516, 0x3ebc_5ab2, 0x3afd_074b, 0x3901_6791, 0x00b3_3687, 0x00b3_3687]),
            (Activation::SteepLogistic, [0x3f00_0000, 0x3f1e_bf4c, 0x3d00_7ece, 0x3f7e_1b97, 0x36a0_8fa6, 0x3f7f_fffa, 0x3f80_0000, 0x00b3_3688]),
            (Activation::SteepTanh, [0, 0x3e75_fa5d, 0xbf6f_f027, 0x3f7c_372e, 0xbf7f_ff60, 0x3f7f_fff3, 0x3f80_0000, 0xbf80_0000]),
        ];
        assert_eq!(golden.map(|(activation, _)| activation), Activation::ALL);
        for (activation, bits) in golden {
            assert_eq!(SUMS.map(|a| activation.apply(a).to_bits()), bits, "{activation}");
        }
    }

    #[test]
    fn sigmoids_and_gaussian_are_close() {
        for step in -200_000..=200_000 {
            let a = step as f32 * 0.0005;
            let exact = f64::from(a);
            assert!((f64::from(logistic(a)) - 1.0 / (1.0 + libm::exp(-exact))).abs() < 1e-6, "{a}");
            assert!((f64::from(gaussian(a)) - libm::exp(-exact * exact)).abs() < 1e-6, "{a}");
            assert!((f64::from(steep_logistic(a)) - 1.0 / (1.0 + libm::exp(-4.9 * exact))).abs() < 1e-6, "{a}");
            assert!((f64::from(steep_tanh(a)) - libm::tanh(2.45 * exact)).abs() < 1e-6, "{a}");
            assert!((f64::from(rational_tanh(a)) - libm::tanh(exact)).abs() < 0.024, "{a}");
        }
    }

    #[test]
    fn rational_tanh_is_clamped() {
        for a in [3.0, 3.1, 1e30, f32::INFINITY] {
            assert_eq!((rational_tanh(a), rational_tanh(-a)), (1.0, -1.0));
        }
        for a in (2.9_f32.to_bits()..3.0_f32.to_bits()).map(f32::from_bits) {
            assert!(rational_tanh(a) <= 1.0, "{a}");
        }
    }

    #[test]
    fn nan_is_not_hidden() {
        for activation in Activation::ALL {
            assert!(activation.apply(f32::NAN).is_nan(), "{activation}");
        }
    }

    #[test]
    fn names_are_those_in_files() {
        for activation in Activation::ALL {
            assert_eq!(serde_json::to_string(&activation).expect("serialises"), format!("\"{activation}\""));
        }
    }

    proptest! {
        #[test]
        fn outputs_are_finite_and_in_range(a in proptest::num::f32::NORMAL | proptest::num::f32::SUBNORMAL) {
            for activation in Activation::ALL {
                let (low, high) = activation.range();
                let output = activation.apply(a);
                prop_assert!(output.is_finite() && low <= output && output <= high, "{} of {}: {}", activation, a, output);
            }
        }

        #[test]
        fn all_is_each(sums in proptest::collection::vec(-50.0..50.0f32, 0..40)) {
            for activation in Activation::ALL {
                let each: Vec<_> = sums.iter().map(|&a| activation.apply(a).to_bits()).collect();
                let mut all = sums.clone();
                activation.apply_all(&mut all);
                prop_assert_eq!(all.iter().map(|a| a.to_bits()).collect::<Vec<_>>(), each, "{}", activation);
            }
        }
    }
}
