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
//! | one net for all limbs of a body | [`Neat::of_copies`], [`Copies`](ne_net::Copies) |
//! | historical markings | `innovation.rs` |
//! | distance between genomes | [`Compatibility`], `compatibility.rs` |
//! | species, fitness sharing, stagnation | [`SpeciationSettings`], `speciation` |
//! | selection of parents | [`ReproductionSettings`], `reproduction.rs` |
//! | crossover | [`Crossover`], `crossover.rs` |
//! | mutations | [`MutationSettings`], `mutation` |
//! | the first generation | [`StartTopology`], `start.rs` |
//! | a picture of a genome | [`NeatGenome::to_dot`], `dot.rs` |
//!
//! ```
//! use ne_core::{Evaluation, Evolution, Phenotype, Seed, Serial, StopConditions, Task};
//! use ne_neat::{Neat, NeatSettings};
//!
//! /// Exclusive or: the product of the inputs, ±1, with the other sign.
//! struct ExclusiveOr;
//! impl Task for ExclusiveOr {
//!     fn inputs(&self) -> usize { 2 }
//!     fn outputs(&self) -> usize { 1 }
//!     fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
//!         phenotype.reset();
//!         let (mut error, mut answer) = (0.0, [0.0]);
//!         for (a, b) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
//!             phenotype.activate(&[a, b], &mut answer);
//!             error += f64::from((answer[0] + a * b).powi(2));
//!         }
//!         Evaluation::new(16.0 - error)
//!     }
//! }
//!
//! let strategy = Neat::new(NeatSettings::default(), 2, 1)?;
//! let stop = StopConditions { target: Some(15.0), generations: Some(300), ..Default::default() };
//! let mut evolution = Evolution::new(strategy, Seed::of_run(1), stop);
//! evolution.run(&ExclusiveOr, &Serial, &mut [])?;
//! let champion = evolution.champion().expect("there is a best");
//! assert!(champion.fitness.get() >= 15.0 && champion.genome.hidden_count() > 0);
//! println!("{}", champion.genome.to_dot(&["a", "b"], &["either"]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod compatibility;
mod crossover;
mod dot;
mod genome;
mod growing;
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
