//! What a phenotype means: what it does with a fixed battery of inputs.

use crate::Phenotype;

/// Steps of the battery.
const STEPS: usize = 32;

/// The largest magnitude of the battery. Environments scale what they sense to a few units; six decimal orders more is
/// a range in which a controller still owes finite outputs, while near the largest f32 every sum overflows.
const LARGE: f32 = 1e6;

/// The number at `index` of the inputs at `step`.
fn input(step: usize, index: usize) -> f32 {
    let alternating = if (step + index).is_multiple_of(2) { 1.0 } else { -1.0 };
    match step {
        0 => 0.0,
        1 => 1.0,
        2 => -1.0,
        3 | 4 => alternating,
        5 => LARGE,
        6 => -LARGE,
        7 | 8 => LARGE * alternating,
        9 => f32::MIN_POSITIVE * alternating,
        10 => -0.0,
        _ => 3.0 * noise(step as u64, index as u64),
    }
}

/// A number from -1 to 1 that depends on both arguments: the finaliser of SplitMix64 (Steele et al., OOPSLA 2014).
pub(super) fn noise(a: u64, b: u64) -> f32 {
    let mut bits = a.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ b.wrapping_add(0x632b_e59b_d9b4_e019);
    for factor in [0xbf58_476d_1ce4_e5b9_u64, 0x94d0_49bb_1331_11eb] {
        bits = (bits ^ (bits >> 29)).wrapping_mul(factor);
    }
    // 24 bits fit an f32 exactly.
    ((bits ^ (bits >> 32)) >> 40) as f32 / (1 << 23) as f32 - 1.0
}

/// The outputs of a phenotype for the battery.
#[derive(Clone, Debug)]
pub(super) struct Behaviour {
    outputs: usize,
    values: Vec<f32>,
}

impl Behaviour {
    /// Feeds the battery to a phenotype as it is, not reset. The outputs are filled with `poison` before each step.
    pub(super) fn of(phenotype: &mut dyn Phenotype, poison: f32) -> Self {
        let (inputs, outputs) = (phenotype.inputs(), phenotype.outputs());
        let mut values = Vec::with_capacity(STEPS * outputs);
        let mut seen = vec![0.0; inputs];
        let mut wanted = vec![0.0; outputs];
        for step in 0..STEPS {
            seen.iter_mut().enumerate().for_each(|(index, value)| *value = input(step, index));
            wanted.fill(poison);
            phenotype.activate(&seen, &mut wanted);
            values.extend_from_slice(&wanted);
        }
        Self { outputs, values }
    }

    /// Where two behaviours first differ in a bit.
    pub(super) fn difference(&self, other: &Self) -> Option<String> {
        if self.outputs != other.outputs {
            return Some(format!("{} outputs against {}", self.outputs, other.outputs));
        }
        let differs = |(a, b): (&f32, &f32)| a.to_bits() != b.to_bits();
        let at = self.values.iter().zip(&other.values).position(differs)?;
        let (step, output) = (at / self.outputs, at % self.outputs);
        Some(format!("step {step}, output {output}: {:?} against {:?}", self.values[at], other.values[at]))
    }

    /// The first output that is not finite.
    pub(super) fn non_finite(&self) -> Option<String> {
        let at = self.values.iter().position(|value| !value.is_finite())?;
        let (step, output) = (at / self.outputs, at % self.outputs);
        let (low, high) = (input(step, 0), input(step, 1));
        Some(format!("step {step}, output {output}: {} for inputs {low:e}, {high:e}, ...", self.values[at]))
    }

    /// A number that changes with the behaviour: minus the mean distance from an arbitrary other one.
    pub(super) fn score(&self) -> f64 {
        let count = self.values.len().max(1) as f64;
        let distance = |(at, &value): (usize, &f32)| f64::from((value - noise(7, at as u64)).abs());
        -self.values.iter().enumerate().map(distance).sum::<f64>() / count
    }
}
