use crate::{Cases, assert_caught};
use ne_core::{
    Phenotype,
    conformance::{check_phenotype, phenotype::*},
};
use std::sync::atomic::{AtomicU32, Ordering};

/// Two inputs, two outputs, a memory, and one flaw.
struct Flawed {
    flaw: Flaw,
    memory: f32,
    born: u32,
}

#[derive(Clone, Copy, PartialEq)]
enum Flaw {
    None,
    ShapeGrowsWithUse,
    NoTwoAlike,
    LeavesAnOutput,
    AddsToTheOutput,
    Overflows,
    ZeroByZero,
    ResetDoesNothing,
    ResetIsNotBirth,
    Panics,
}

static BORN: AtomicU32 = AtomicU32::new(0);

impl Flawed {
    fn new(flaw: Flaw) -> Self {
        Self { flaw, memory: 0.25, born: BORN.fetch_add(1, Ordering::Relaxed) }
    }
}

impl Phenotype for Flawed {
    fn inputs(&self) -> usize {
        2 + usize::from(self.flaw == Flaw::ShapeGrowsWithUse && self.memory != 0.25)
    }

    fn outputs(&self) -> usize {
        2
    }

    fn reset(&mut self) {
        self.memory = match self.flaw {
            Flaw::ResetDoesNothing => self.memory,
            Flaw::ResetIsNotBirth => 0.0,
            _ => 0.25,
        };
    }

    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        self.memory = (0.5 * self.memory + inputs[0] - inputs[1]).clamp(-1.0, 1.0);
        outputs[0] = self.memory;
        match self.flaw {
            Flaw::NoTwoAlike => outputs[1] = self.born as f32,
            Flaw::LeavesAnOutput if inputs[0] < 0.0 => {}
            Flaw::AddsToTheOutput => outputs[1] += inputs[0],
            Flaw::Overflows => outputs[1] = (inputs[0] * inputs[0]).exp(),
            Flaw::ZeroByZero => outputs[1] = inputs[0] / inputs[0].abs(),
            Flaw::Panics => panic!("on purpose"),
            _ => outputs[1] = inputs[1].clamp(-1.0, 1.0),
        }
    }
}

#[test]
fn broken_phenotypes_are_caught() {
    let check = |flaw: Flaw| check_phenotype(|| Flawed::new(flaw));
    assert_eq!(check(Flaw::None), Ok(()));
    let cases: Cases<'_> = vec![
        (SHAPE, "shape grows with use", check(Flaw::ShapeGrowsWithUse)),
        (SHAPE, "panics", check(Flaw::Panics)),
        (DETERMINISTIC, "no two alike", check(Flaw::NoTwoAlike)),
        (WRITES_OUTPUTS, "leaves an output", check(Flaw::LeavesAnOutput)),
        (WRITES_OUTPUTS, "adds to the output", check(Flaw::AddsToTheOutput)),
        (FINITE, "overflows", check(Flaw::Overflows)),
        (FINITE, "zero by zero", check(Flaw::ZeroByZero)),
        (RESET, "reset does nothing", check(Flaw::ResetDoesNothing)),
        (RESET, "reset is not birth", check(Flaw::ResetIsNotBirth)),
    ];
    assert_caught(&cases, PROMISES);
}

#[test]
fn the_violation_has_the_numbers() {
    let violation = check_phenotype(|| Flawed::new(Flaw::ZeroByZero)).expect_err("it is broken");
    assert_eq!(
        violation.to_string(),
        "a phenotype owes: finite inputs give finite outputs. Found: step 0, output 1: NaN for inputs 0e0, 0e0, ..."
    );
}
