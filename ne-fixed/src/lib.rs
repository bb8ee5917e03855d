//! Neuroevolution of weights on a fixed topology: the net's shape stays, its weights evolve.
//!
//! The genome is a [`WeightVector`]; each strategy is a folder whose main file reads like its paper.
//!
//! | strategy | what it is | when |
//! |---|---|---|
//! | [`ConventionalNe`] | a generational genetic algorithm, in the form of the thesis ([`thesis`](ConventionalNeSettings::thesis)) and in a better one | to see evolution at work; rugged landscapes |
//! | [`CmaEs`] | a normal distribution that learns size and shape; restarts with other populations, or where the best search ended | up to a thousand weights; the fewest evaluations where fitness says much |
//! | [`OpenEs`] | a centre that climbs an estimated gradient | thousands of weights, noisy fitness, many processors |
//! | [`Cosyne`] | a subpopulation for each weight, whose members meet in ever new nets | small nets, few evaluations |
//! | [`Nsga2`] | a genetic algorithm that keeps a front of compromises between objectives | where several things are wanted that cannot all be had |
//! | [`RandomSearch`], [`HillClimbing`], [`Ars`] | baselines: weights drawn anew; one parent and its noisy copies; steps along the best of random directions | to see what the others are worth |
//!
//! They take any [`Topology`](ne_net::Topology), a dense shape or a frozen graph, recurrent ones included.
//!
//! The one decision behind the operators: **they are plain numbers on plain slices.** A [`Crossover`] or [`Mutation`]
//! sees weights and a random stream of its own and knows nothing of nets, populations or generations. A [`Setting`], it
//! is named and adjusted in a configuration file, checked once, and saved with the strategy.
//!
//! | part of conventional neuroevolution | choices |
//! |---|---|
//! | [`Initialization`] | uniform, Gaussian scaled by fan-in, any [`Distribution`] |
//! | selection of parents | [`Selection`](ne_core::Selection), or any [`Selector`](ne_core::Selector) of yours |
//! | [`CrossoverChoice`] | [`OnePoint`], [`TwoPoint`], [`UniformCrossover`], [`Arithmetic`], or your [`Crossover`] |
//! | [`MutationChoice`] | [`UniformMutation`], [`GaussianMutation`], [`SelfAdaptiveMutation`], [`DistributedMutation`], or your [`Mutation`] |
//! | [`StagnationBoost`] | larger mutations when a population stagnates |
//!
//! ```
//! use ne_core::{Evaluation, Evolution, Phenotype, Seed, Serial, StopConditions, Task};
//! use ne_fixed::{ConventionalNe, ConventionalNeSettings};
//! use ne_net::DenseShape;
//!
//! /// Answer with the half of the input.
//! struct Half;
//! impl Task for Half {
//!     fn inputs(&self) -> usize { 1 }
//!     fn outputs(&self) -> usize { 1 }
//!     fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
//!         phenotype.reset();
//!         let mut error = 0.0;
//!         for step in -10..=10 {
//!             let (input, mut answer) = (step as f32 * 0.1, [0.0]);
//!             phenotype.activate(&[input], &mut answer);
//!             error += f64::from((answer[0] - 0.5 * input).powi(2));
//!         }
//!         Evaluation::new(-error)
//!     }
//! }
//!
//! let strategy = ConventionalNe::new(ConventionalNeSettings::default(), DenseShape::new(1, vec![4], 1))?;
//! let stop = StopConditions { generations: Some(30), ..Default::default() };
//! let mut evolution = Evolution::new(strategy, Seed::of_run(1), stop);
//! evolution.run(&Half, &Serial, &mut [])?;
//! assert!(evolution.champion().expect("there is a best").fitness.get() > -0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod ars;
mod chance;
mod cma_es;
pub mod conformance;
mod conventional;
mod cosyne;
mod crossover;
mod distribution;
mod diversity;
mod genome;
mod hill_climbing;
mod initialization;
mod mirrored;
mod mutation;
mod nets;
mod normal;
mod nsga2;
mod open_es;
mod random_search;
mod ranking;
mod setting;
mod state_error;

pub use ars::{Ars, ArsSettings};
pub use cma_es::{CmaEs, CmaEsSettings, CovarianceModel, Restart};
pub use conventional::{ConventionalNe, ConventionalNeSettings, StagnationBoost};
pub use cosyne::{Cosyne, CosyneSettings, Permutation};
pub use crossover::{Arithmetic, Crossover, CrossoverChoice, OnePoint, TwoPoint, UniformCrossover};
pub use distribution::Distribution;
pub use genome::{WeightVector, WeightVectorError};
pub use hill_climbing::{HillClimbing, HillClimbingSettings};
pub use initialization::Initialization;
pub use mutation::{
    DistributedMutation, GaussianMutation, Mutation, MutationChoice, SelfAdaptiveMutation, UniformMutation,
};
pub use nsga2::{Nsga2, Nsga2Settings};
pub use open_es::{Adam, OpenEs, OpenEsSettings};
pub use random_search::{RandomSearch, RandomSearchSettings};
pub use setting::Setting;
pub use state_error::StateError;
