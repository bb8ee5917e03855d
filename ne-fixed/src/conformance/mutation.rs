//! What a mutation owes.

use super::{COUNTS, bits};
use crate::Mutation;
use ne_core::{
    Purpose, Seed,
    conformance::{Promise, Violation},
};

/// The same again.
pub const DETERMINISTIC: Promise = Promise::new("mutation", "the result depends on the arguments alone");
/// Numbers stay numbers.
pub const FINITE: Promise =
    Promise::new("mutation", "weights stay finite, and the deviation finite and not negative, if they were");
/// How much, and not how often.
pub const STRENGTH: Promise = Promise::new("mutation", "`strength` scales the size of a change, not its probability");

/// All of them.
pub const PROMISES: &[Promise] = &[DETERMINISTIC, FINITE, STRENGTH];

const CHECK: Purpose = Purpose::new("conformance mutation");

/// Genes of all draws by which strength is judged.
const DRAWS: usize = 400;

/// Checks a mutation on nets of 1 to 200 weights, ordinary and huge ones. `seed` gives the draws.
///
/// Whether strength changes how often a weight changes is judged on 80,000 weights, at five standard deviations.
///
/// # Errors
/// The first promise that is not kept.
pub fn check_mutation(mutation: &impl Mutation, seed: Seed) -> Result<(), Violation> {
    let mutated = |weights: &[f32], deviation: f32, strength: f32, place: usize| {
        let (mut weights, mut deviation) = (weights.to_vec(), deviation);
        let mut stream = seed.individual(place as u64).stream(CHECK);
        mutation.mutate(&mut weights, &mut deviation, strength, &mut stream);
        (weights, deviation)
    };
    let initial = mutation.initial_deviation();
    for count in COUNTS {
        for weight in [0.0, -1.5, 1e3, f32::MAX] {
            let weights = vec![weight; count];
            for (place, strength) in [0.25, 1.0, 8.0].into_iter().enumerate() {
                let (found, deviation) = FINITE.check(|| {
                    let (found, deviation) = mutated(&weights, initial, strength, place);
                    if let Some(wrong) = found.iter().find(|weight| !weight.is_finite()) {
                        return Err(format!("{wrong} from {weight:e} at strength {strength}"));
                    }
                    match deviation.is_finite() && deviation >= 0.0 {
                        true => Ok((found, deviation)),
                        false => Err(format!("a deviation of {deviation} from {initial} at strength {strength}")),
                    }
                })?;
                DETERMINISTIC.check(|| {
                    mutated(&[0.5], initial, 2.0, place + 1);
                    let (again, deviation_again) = mutated(&weights, initial, strength, place);
                    match (bits(&again), deviation_again.to_bits()) == (bits(&found), deviation.to_bits()) {
                        true => Ok(()),
                        false => {
                            Err(format!("other weights, or another deviation, of {count} weights the second time"))
                        }
                    }
                })?;
            }
        }
    }
    STRENGTH.check(|| {
        // How many of the weights changed, and by how much in all.
        let changes = |strength: f32| {
            let changed = (0..DRAWS).flat_map(|place| mutated(&[0.0; 200], initial, strength, place).0);
            changed
                .filter(|&change| change != 0.0)
                .fold((0.0, 0.0), |(count, size), change| (count + 1.0, size + f64::from(change.abs())))
        };
        let ((count, size), (more, larger)) = (changes(1.0), changes(4.0));
        if f64::abs(more - count) > 5.0 * f64::sqrt(more + count) {
            return Err(format!("{count} of {} weights change at strength 1, and {more} at 4", 200 * DRAWS));
        }
        match larger * count >= size * more {
            true => Ok(()),
            false => Err(format!("a mean change of {} at strength 1, and of {} at 4", size / count, larger / more)),
        }
    })
}
