//! Whether operators of one's own keep the promises of [`Crossover`](crate::Crossover) and [`Mutation`](crate::Mutation), as
//! [`ne_core::conformance`] checks what its own contracts owe.
//!
//! ```
//! use ne_core::Seed;
//! use ne_fixed::{UniformCrossover, conformance::check_crossover};
//!
//! check_crossover(&UniformCrossover {}, Seed::of_run(1))?;
//! # Ok::<(), ne_core::conformance::Violation>(())
//! ```

pub mod crossover;
pub mod mutation;

pub use {crossover::check_crossover, mutation::check_mutation};

/// How many weights nets of the checks have: also one alone.
const COUNTS: [usize; 4] = [1, 2, 3, 200];

/// The bits of numbers, so that NaN is equal to itself.
fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|number| number.to_bits()).collect()
}
