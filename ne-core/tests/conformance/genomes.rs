use crate::{Cases, assert_caught};
use ne_core::{
    Genome, Phenotype,
    conformance::{check_genome, genome::*, phenotype},
};
use serde::{Deserialize, Serialize};
use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

/// A genome of one weight, with one flaw.
#[derive(Serialize, Deserialize)]
struct Flawed {
    flaw: Flaw,
    weight: f32,
    #[serde(skip)]
    unsaved: f32,
    #[serde(skip)]
    shared: Arc<AtomicU32>,
}

#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Flaw {
    None,
    ExpressCounts,
    PhenotypesShareState,
    CloneForgets,
    FileForgets,
    HoldsNan,
    Overflows,
}

impl Flawed {
    fn new(flaw: Flaw) -> Self {
        let weight = if flaw == Flaw::HoldsNan { f32::NAN } else { 0.1 };
        let unsaved = if flaw == Flaw::FileForgets { 0.5 } else { 0.0 };
        Self { flaw, weight, unsaved, shared: Arc::default() }
    }
}

impl Clone for Flawed {
    fn clone(&self) -> Self {
        let weight = if self.flaw == Flaw::CloneForgets { 0.0 } else { self.weight };
        Self { weight, shared: self.shared.clone(), ..*self }
    }
}

impl Genome for Flawed {
    type Phenotype = Expressed;

    fn express(&self) -> Expressed {
        let count = |flaw| if self.flaw == flaw { self.shared.fetch_add(1, Ordering::Relaxed) as f32 } else { 0.0 };
        // A NaN that does not show in the behaviour is still lost in a file.
        let weight = if self.weight.is_nan() { 1.0 } else { self.weight };
        let bias = count(Flaw::ExpressCounts) + self.unsaved;
        let shared = (self.flaw == Flaw::PhenotypesShareState).then(|| self.shared.clone());
        Expressed { weight, bias, shared, overflows: self.flaw == Flaw::Overflows }
    }
}

struct Expressed {
    weight: f32,
    bias: f32,
    shared: Option<Arc<AtomicU32>>,
    overflows: bool,
}

impl Phenotype for Expressed {
    fn inputs(&self) -> usize {
        1
    }

    fn outputs(&self) -> usize {
        1
    }

    fn reset(&mut self) {
        self.shared.iter().for_each(|shared| shared.store(0, Ordering::Relaxed));
    }

    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        let state = self.shared.as_ref().map_or(0, |shared| shared.fetch_add(1, Ordering::Relaxed));
        let scale = if self.overflows { 1e38 } else { 1.0 };
        outputs[0] = scale * self.weight * inputs[0] + self.bias + state as f32;
    }
}

#[test]
fn broken_genomes_are_caught() {
    let check = |flaw: Flaw| check_genome(&[Flawed::new(Flaw::None), Flawed::new(flaw)]);
    assert_eq!(check(Flaw::None), Ok(()));
    let cases: Cases<'_> = vec![
        (SAMPLE, "an empty sample", check_genome::<Flawed>(&[])),
        (EXPRESSES_THE_SAME, "express counts", check(Flaw::ExpressCounts)),
        (EXPRESSES_THE_SAME, "phenotypes share state", check(Flaw::PhenotypesShareState)),
        (CLONES, "clone forgets", check(Flaw::CloneForgets)),
        (SURVIVES_A_FILE, "file forgets", check(Flaw::FileForgets)),
        (SURVIVES_A_FILE, "holds NaN", check(Flaw::HoldsNan)),
        (phenotype::FINITE, "its phenotype overflows", check(Flaw::Overflows)),
    ];
    assert_caught(&cases, PROMISES);
}

#[test]
fn the_violation_names_the_genome_and_the_field() {
    let violation = check_genome(&[Flawed::new(Flaw::None), Flawed::new(Flaw::HoldsNan)]).expect_err("it is broken");
    assert!(violation.found.contains("genome 1"), "{violation}");
    assert!(violation.found.contains("field weight"), "{violation}");
}
