//! NeuroEvolution of Augmenting Topologies: nets whose neurons and connections evolve with their weights.
//!
//! [`Neat`] is a [`Strategy`](ne_core::Strategy) after Stanley & Miikkulainen, *Evolving Neural Networks through
//! Augmenting Topologies*, Evolutionary Computation 10(2), 2002. Its settings are [`NeatSettings`]; a
//! [`NeatGenome`] is expressed as a [`GraphNet`](ne_net::GraphNet), feed-forward or recurrent.
//!
//! The one decision behind this crate: **the truth is a list of genes sorted by number.** Graphs are built from it for as
//! long as a question takes to answer (is there a cycle, in which order are neurons computed, what does it look like),
//! and forgotten. Numbers are given after all individuals of a generation were mutated, one individual after the other,
//! so that nothing else can change them.
//!
//! | part of NEAT | where |
//! |---|---|
//! | genes, and the net they build | `genome` |
//! | historical markings | `innovation.rs` |
//! | distance between genomes | [`Compatibility`], `compatibility.rs` |
//! | species, fitness sharing, stagnation | [`SpeciationSettings`], `speciation` |
//! | who breeds with whom | [`ReproductionSettings`], `reproduction.rs` |
//! | crossover | [`Crossover`], `crossover.rs` |
//! | mutations | [`MutationSettings`], `mutation` |
//! | the first generation | [`StartTopology`], `start.rs` |

mod compatibility;
mod crossover;
mod dot;
mod genome;
mod innovation;
mod mutation;
mod neat;
mod noise;
mod reproduction;
mod settings;
mod speciation;
mod start;
mod state;

pub use compatibility::Compatibility;
pub use crossover::Crossover;
pub use genome::{
    BiasKind, ConnectionGene, GenomeError, InnovationNumber, Layout, NeatGenome, NodeGene, NodeId, NodeKind,
};
pub use mutation::{MutationSettings, SplitChoice, WeightMutation};
pub use neat::Neat;
pub use noise::Noise;
pub use reproduction::ReproductionSettings;
pub use settings::NeatSettings;
pub use speciation::{FitnessBaseline, PopulationStagnation, SpeciationSettings, TargetSpecies};
pub use start::StartTopology;
pub use state::StateError;
