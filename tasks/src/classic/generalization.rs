use super::{DoublePole, State};
use ne_core::{Failure, Phenotype, Task};

/// Decisions that must be held from each start.
const DECISIONS: u32 = 1_000;

/// The grid of starts, as shares of each range.
const SHARES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// The range of x (m), ẋ (m/s), θ₁ (degrees) and θ̇₁ (degrees/s): from minus this to this.
const RANGES: [f64; 4] = [2.16, 1.35, 3.6, 8.6];

/// The result of the test of [`DoublePole::generalization`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Generalization {
    /// The starts from which 1,000 decisions were held, of [`STARTS`](Self::STARTS).
    pub held: u32,
    /// The decisions made in all: the work.
    pub steps: u64,
}

impl Generalization {
    /// The number of starts.
    pub const STARTS: u32 = 625;

    /// The number of starts that must be held by a controller which is called general.
    pub const GENERAL: u32 = 200;

    /// Whether enough starts were held.
    pub fn is_general(&self) -> bool {
        self.held >= Self::GENERAL
    }
}

impl DoublePole {
    /// Tests from how many of 625 starts a controller holds the poles for 1,000 decisions.
    ///
    /// The starts are a grid: x, ẋ, θ₁ and θ̇₁ each at 0.05, 0.25, 0.5, 0.75 and 0.95 of their ranges ±2.16 m,
    /// ±1.35 m/s, ±3.6° and ±8.6°/s; the short pole is upright and at rest. The settings' start angle and fitness do
    /// not matter. At most 625,000 decisions; it is no part of an evaluation.
    ///
    /// Source: as for [`PoleFitness::Damping`](super::PoleFitness::Damping).
    ///
    /// # Errors
    /// [`Failure::ShapeMismatch`] if the phenotype does not fit the task, [`Failure::NonFinite`] if an output is no
    /// number.
    pub fn generalization(&self, phenotype: &mut dyn Phenotype) -> Result<Generalization, Failure> {
        self.check_shape(phenotype)?;
        let mut result = Generalization { held: 0, steps: 0 };
        for start in starts() {
            let balanced = self.balancing.balance(phenotype, start, DECISIONS, |_| ());
            if let Some(failure) = balanced.failure {
                return Err(failure);
            }
            result.held += u32::from(balanced.held == DECISIONS);
            result.steps += u64::from(balanced.decisions);
        }
        Ok(result)
    }
}

fn starts() -> impl Iterator<Item = State<2>> {
    (0..Generalization::STARTS as usize).map(|number| {
        let value = |axis: usize| RANGES[axis] * (2.0 * SHARES[number / SHARES.len().pow(axis as u32) % 5] - 1.0);
        State {
            position: value(0),
            velocity: value(1),
            angles: [value(2).to_radians(), 0.0],
            angular_velocities: [value(3).to_radians(), 0.0],
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_starts_are_a_whole_grid_around_upright() {
        let starts: Vec<State<2>> = starts().collect();
        assert!(starts.contains(&State::UPRIGHT));
        for (index, start) in starts.iter().enumerate() {
            assert!(!starts[..index].contains(start), "{start:?} twice");
        }
        let first = starts[0];
        assert!((first.position + 1.944).abs() < 1e-12, "{first:?}");
        assert!((first.velocity + 1.215).abs() < 1e-12, "{first:?}");
        assert!((first.angles[0] + 3.24_f64.to_radians()).abs() < 1e-12, "{first:?}");
        assert!((first.angular_velocities[0] + 7.74_f64.to_radians()).abs() < 1e-12, "{first:?}");
    }
}
