use crate::Phenotype;
use serde::Serialize;

/// Heritable data: what a strategy varies and selects.
///
/// An implementor owes:
/// - `express` is a pure function: equal genomes build phenotypes that behave alike to the bit;
/// - if it can be deserialised, as a run that is to be resumed needs, it then expresses the same phenotype;
/// - cloning is cheap (share what does not vary between individuals in an `Arc`).
///
/// Check yours with `check_genome` of the [conformance kit](crate::conformance).
pub trait Genome: Clone + Send + Sync + Serialize + 'static {
    /// The controller this genome describes.
    type Phenotype: Phenotype;

    /// Builds the phenotype.
    fn express(&self) -> Self::Phenotype;
}
