//! What a genome owes.

use super::{Promise, Violation, check_phenotype, phenotype::same, probe::Behaviour};
use crate::{Genome, field_path};
use serde::de::DeserializeOwned;

/// There is something to check.
pub const SAMPLE: Promise = Promise::new("check of genomes", "a sample of at least one genome");
/// Expressing is a pure function.
pub const EXPRESSES_THE_SAME: Promise =
    Promise::new("genome", "`express` builds phenotypes that behave alike to the bit and share no state");
/// A clone is as good.
pub const CLONES: Promise = Promise::new("genome", "a clone expresses the same phenotype");
/// A file is as good.
pub const SURVIVES_A_FILE: Promise =
    Promise::new("genome", "written as JSON and read back it expresses the same phenotype and writes the same JSON");

/// All of them; what they express owes those of a phenotype as well.
pub const PROMISES: &[Promise] = &[SAMPLE, EXPRESSES_THE_SAME, CLONES, SURVIVES_A_FILE];

/// Checks a few genomes, and the phenotypes they express ([`check_phenotype`]).
///
/// Take a varied sample: of random genomes, of bred ones, small and large.
///
/// # Errors
/// The first promise that is not kept; the text says by which genome of the sample.
pub fn check_genome<G: Genome + DeserializeOwned>(sample: &[G]) -> Result<(), Violation> {
    SAMPLE.check(|| if sample.is_empty() { Err("none".into()) } else { Ok(()) })?;
    for (index, genome) in sample.iter().enumerate() {
        let of_genome = |violation: Violation| violation.promise.broken(format!("genome {index}: {}", violation.found));
        check_one(genome).map_err(of_genome)?;
        check_phenotype(|| genome.express()).map_err(of_genome)?;
    }
    Ok(())
}

fn check_one<G: Genome + DeserializeOwned>(genome: &G) -> Result<(), Violation> {
    let behaviour = EXPRESSES_THE_SAME.check(|| {
        // Both are built before either is used, so that what they share would show.
        let (mut first, mut second) = (genome.express(), genome.express());
        let behaviour = Behaviour::of(&mut first, 0.0);
        same(&Behaviour::of(&mut second, 0.0), &behaviour, "expressed twice")?;
        same(&Behaviour::of(&mut genome.express(), 0.0), &behaviour, "expressed later")?;
        Ok(behaviour)
    })?;
    CLONES.check(|| same(&Behaviour::of(&mut genome.clone().express(), 0.0), &behaviour, "clone against original"))?;
    SURVIVES_A_FILE.check(|| {
        let text = to_json(genome)?;
        let read: G = from_json(&text)?;
        same(&Behaviour::of(&mut read.express(), 0.0), &behaviour, "read back against original")?;
        match to_json(&read)? {
            again if again == text => Ok(()),
            again => Err(format!("writes {} first, {} when read back", shorten(&text), shorten(&again))),
        }
    })
}

/// As text, the way a checkpoint holds it.
pub(super) fn to_json(value: &impl serde::Serialize) -> Result<String, String> {
    serde_json::to_string(value).map_err(|error| format!("cannot be written as JSON: {error}"))
}

/// From text, the way a checkpoint is read.
pub(super) fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    field_path::from_str(text).map_err(|error| format!("cannot be read back from JSON: {error}"))
}

/// The beginning of a long text.
fn shorten(text: &str) -> String {
    let start: String = text.chars().take(200).collect();
    if start.len() < text.len() { start + "..." } else { start }
}
