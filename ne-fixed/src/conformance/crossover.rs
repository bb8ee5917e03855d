//! What a crossover owes.

use super::{COUNTS, bits};
use crate::Crossover;
use ne_core::{
    Purpose, RandomStream, Seed,
    conformance::{Promise, Violation},
};
use rand::RngExt;

/// Nothing of what stood there is left.
pub const WRITES: Promise = Promise::new("crossover", "every gene of the child is written, whatever it held before");
/// Like from like.
pub const EQUALS: Promise = Promise::new("crossover", "parents that are equal have a child equal to them");
/// The same again.
pub const DETERMINISTIC: Promise = Promise::new("crossover", "the child depends on the parents and the stream alone");
/// Numbers stay numbers.
pub const FINITE: Promise = Promise::new("crossover", "the child of finite parents is finite");

/// All of them.
pub const PROMISES: &[Promise] = &[WRITES, EQUALS, DETERMINISTIC, FINITE];

const CHECK: Purpose = Purpose::new("conformance crossover");

/// Checks a crossover on parents of 1 to 200 genes, ordinary and huge ones. `seed` gives parents and draws.
///
/// # Errors
/// The first promise that is not kept.
pub fn check_crossover(crossover: &impl Crossover, seed: Seed) -> Result<(), Violation> {
    for (index, count) in COUNTS.into_iter().enumerate() {
        for (place, most) in [1.0, 1e3, f32::MAX].into_iter().enumerate() {
            let seed = seed.individual((3 * index + place) as u64);
            let mut stream = seed.stream(CHECK);
            let [first, second] = [(); 2].map(|()| genes(count, most, &mut stream));
            let child = |first: &[f32], second: &[f32], before: f32| {
                let mut child = vec![before; count];
                crossover.cross(first, second, &mut child, &mut seed.trial(1).stream(CHECK));
                child
            };
            let written = WRITES.check(|| {
                let (one, other) = (child(&first, &second, f32::NAN), child(&first, &second, 12345.0));
                match (0..count).find(|&gene| one[gene].to_bits() != other[gene].to_bits()) {
                    Some(gene) => {
                        Err(format!("gene {gene} of {count} is {} over NaN and {} over 12345", one[gene], other[gene]))
                    }
                    None => Ok(one),
                }
            })?;
            DETERMINISTIC.check(|| {
                child(&second, &first, 0.0);
                match bits(&child(&first, &second, 0.0)) == bits(&written) {
                    true => Ok(()),
                    false => Err(format!("another child of {count} genes the second time")),
                }
            })?;
            FINITE.check(|| match written.iter().find(|gene| !gene.is_finite()) {
                Some(gene) => Err(format!("{gene} from genes of up to {most:e}")),
                None => Ok(()),
            })?;
            EQUALS.check(|| {
                let same = child(&first, &first, 0.0);
                match (0..count).find(|&gene| same[gene] != first[gene]) {
                    Some(gene) => {
                        Err(format!("gene {gene} of both parents is {}, of the child {}", first[gene], same[gene]))
                    }
                    None => Ok(()),
                }
            })?;
        }
    }
    Ok(())
}

fn genes(count: usize, most: f32, stream: &mut RandomStream) -> Vec<f32> {
    // Scaled last: a range as wide as all numbers has no width.
    (0..count).map(|_| most * stream.random_range(-1.0..=1.0_f32)).collect()
}
