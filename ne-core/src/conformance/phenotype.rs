//! What a phenotype owes.

use super::{Promise, Violation, probe::Behaviour};
use crate::Phenotype;

/// Its shape never changes.
pub const SHAPE: Promise = Promise::new("phenotype", "`inputs()` and `outputs()` say the same before and after steps");
/// The same again.
pub const DETERMINISTIC: Promise = Promise::new("phenotype", "two built alike behave alike to the bit");
/// Every output is written, whatever it held.
pub const WRITES_OUTPUTS: Promise =
    Promise::new("phenotype", "`activate` writes every output, whatever the slice held before");
/// No NaN, no infinity.
pub const FINITE: Promise = Promise::new("phenotype", "finite inputs give finite outputs");
/// Reset is birth.
pub const RESET: Promise = Promise::new("phenotype", "after `reset` it behaves as when it was new");

/// All of them.
pub const PROMISES: &[Promise] = &[SHAPE, DETERMINISTIC, WRITES_OUTPUTS, FINITE, RESET];

/// Checks phenotypes. `make` builds one and must build the same each time.
///
/// They are fed a battery of inputs: zeros, ones, alternating signs, ±1,000,000, the smallest normal number, and noise
/// within ±3.
///
/// # Errors
/// The first promise that is not kept.
pub fn check_phenotype<P: Phenotype>(make: impl Fn() -> P) -> Result<(), Violation> {
    SHAPE.check(|| {
        let mut phenotype = make();
        let shape = (phenotype.inputs(), phenotype.outputs());
        let same_shape = |phenotype: &P, when: &str| match (phenotype.inputs(), phenotype.outputs()) {
            found if found == shape => Ok(()),
            found => Err(format!("(inputs, outputs) are {found:?} {when}, {shape:?} at birth")),
        };
        same_shape(&phenotype, "when asked again")?;
        phenotype.reset();
        same_shape(&phenotype, "after a reset")?;
        Behaviour::of(&mut phenotype, 0.0);
        same_shape(&phenotype, "after steps")?;
        same_shape(&make(), "built again")
    })?;
    let born = DETERMINISTIC.check(|| {
        let born = Behaviour::of(&mut make(), 0.0);
        same(&Behaviour::of(&mut make(), 0.0), &born, "built again")?;
        Ok(born)
    })?;
    WRITES_OUTPUTS.check(|| {
        same(&Behaviour::of(&mut make(), f32::NAN), &born, "outputs filled with NaN against zeros")?;
        same(&Behaviour::of(&mut make(), -12345.0), &born, "outputs filled with -12345 against zeros")
    })?;
    FINITE.check(|| born.non_finite().map_or(Ok(()), Err))?;
    RESET.check(|| {
        let mut phenotype = make();
        phenotype.reset();
        same(&Behaviour::of(&mut phenotype, 0.0), &born, "reset before use, against new")?;
        phenotype.reset();
        same(&Behaviour::of(&mut phenotype, 0.0), &born, "reset after use, against new")
    })
}

/// An error that says where two behaviours differ, if they do.
pub(super) fn same(found: &Behaviour, expected: &Behaviour, what: &str) -> Result<(), String> {
    found.difference(expected).map_or(Ok(()), |difference| Err(format!("{what}: {difference}")))
}
