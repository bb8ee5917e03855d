//! The contracts of neuroevolution, and the loop that runs them.
//!
//! Everything in Gambol that can be swapped is swapped at a trait of this crate:
//!
//! | trait | one sentence |
//! |---|---|
//! | [`Genome`] | heritable data that builds a phenotype |
//! | [`Phenotype`] | a controller: numbers in, numbers out |
//! | [`Task`] | scores a phenotype; a [function](TaskFn) will do |
//! | [`Selector`] | picks parents by their scores |
//! | [`Strategy`] | asks for evaluations of genomes, is told their results |
//! | `Observer` | is told of each generation |
//!
//! `Evolution` is the loop between them. Evaluations run on this thread (`Serial`), on several (`Parallel`), or wherever an
//! `Evaluator` takes them. What most runs do without are modules of their own: `champion_selection` chooses the champion of a
//! run in varied worlds, `promotion` says when a population goes on to its next stage, `successive_halving` saves evaluations
//! for the promising.
//!
//! The one decision behind all of them: **a run is a function of its settings and one seed.** No contract hands out a
//! shared random generator. Code that needs chance derives a [`RandomStream`] of its own from a [`Seed`], which says where
//! in the run it stands (run, generation, individual, trial) and, with a [`Purpose`], what the numbers are for. Threads,
//! observers and the moment of a restart cannot reach those streams, so they cannot change a result, and a strategy has
//! no generator to save.
//!
//! With `default-features = false` this crate is the traits and plain data alone. Features:
//!
//! - `selection`: the five selectors,
//! - `fields`: reads values so that an error names the field,
//! - `evolution` (default): the loop, stop conditions, observers, checkpoints, the serial evaluator, the conformance kit,
//! - `parallel` (default): the evaluator that uses several threads.
//!
//! # A whole run
//!
//! ```
//! # #[cfg(feature = "evolution")] {
//! use ne_core::{Evaluation, Evolution, Genome, Phenotype, Seed, Serial, StopConditions, Strategy, TaskFn};
//! use serde::{Deserialize, Serialize};
//!
//! /// A genome of one number, expressed as a controller that always answers it.
//! #[derive(Clone, Serialize, Deserialize)]
//! struct Constant(f32);
//! impl Phenotype for Constant {
//!     fn inputs(&self) -> usize { 0 }
//!     fn outputs(&self) -> usize { 1 }
//!     fn reset(&mut self) {}
//!     fn activate(&mut self, _: &[f32], outputs: &mut [f32]) { outputs[0] = self.0 }
//! }
//! impl Genome for Constant {
//!     type Phenotype = Self;
//!     fn express(&self) -> Self { self.clone() }
//! }
//!
//! /// Ten candidates on a grid around the best so far; the grid shrinks.
//! #[derive(Serialize, Deserialize)]
//! struct Grid { centre: f32, width: f32, candidates: Vec<Constant> }
//! impl Strategy for Grid {
//!     type Genome = Constant;
//!     fn name(&self) -> &str { "grid" }
//!     fn ask(&mut self, _: Seed) -> &[Constant] {
//!         self.candidates = (0..10).map(|i| Constant(self.centre + self.width * (i as f32 - 4.5))).collect();
//!         &self.candidates
//!     }
//!     fn tell(&mut self, evaluations: &[Evaluation], _: Seed) {
//!         let best = (0..10).max_by_key(|&i| evaluations[i].fitness()).unwrap_or(0);
//!         self.centre = self.candidates[best].0;
//!         self.width *= 0.5;
//!     }
//! }
//!
//! // Find the number 7.
//! let task = TaskFn::new(0, 1, |phenotype: &mut dyn Phenotype, _: Seed| {
//!     let mut answer = [0.0];
//!     phenotype.activate(&[], &mut answer);
//!     -f64::from((answer[0] - 7.0).abs())
//! });
//! let strategy = Grid { centre: 0.0, width: 4.0, candidates: Vec::new() };
//! let mut evolution = Evolution::new(strategy, Seed::of_run(1), StopConditions::generations(20));
//! evolution.run(&task, &Serial, &mut [])?;
//! let champion = evolution.champion().expect("twenty generations have a best");
//! assert!((champion.genome.0 - 7.0).abs() < 1e-3);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod conformance;
mod evaluation;
mod fitness;
mod genome;
mod measurements;
pub mod pareto;
mod phenotype;
mod seed;
mod selector;
mod setting;
mod share;
mod strategy;
mod task;
mod threads;

#[cfg(feature = "evolution")]
pub mod archive;
#[cfg(feature = "evolution")]
pub mod bounded_read;
#[cfg(feature = "evolution")]
mod champion;
#[cfg(feature = "evolution")]
pub mod champion_selection;
#[cfg(feature = "evolution")]
mod checkpoint;
#[cfg(feature = "evolution")]
pub mod digest;
#[cfg(feature = "evolution")]
mod evaluator;
#[cfg(feature = "evolution")]
mod evolution;
#[cfg(feature = "evolution")]
mod observer;
#[cfg(feature = "evolution")]
mod progress;
#[cfg(feature = "evolution")]
pub mod promotion;
#[cfg(feature = "evolution")]
mod shared_fields;
#[cfg(feature = "evolution")]
mod statistics;
#[cfg(feature = "evolution")]
mod stop;
#[cfg(feature = "evolution")]
pub mod successive_halving;
#[cfg(feature = "evolution")]
mod whole_file;
#[cfg(feature = "evolution")]
pub mod write_points;

pub use evaluation::{Evaluation, Failure};
#[cfg(feature = "fields")]
pub use field_path;
pub use fitness::{Fitness, NotFinite};
pub use genome::Genome;
pub use measurements::Measurements;
pub use phenotype::Phenotype;
pub use seed::{Purpose, RandomStream, Seed};
pub use selector::Selector;
#[cfg(feature = "selection")]
pub use selector::{RankSelector, Roulette, Selection, StochasticUniversal, Tournament, Truncation};
pub use setting::SettingError;
pub use share::{share_rounded_down, share_rounded_up};
pub use strategy::{FrontPoint, Origin, SpeciesReport, Statistic, Strategy};
pub use task::{Task, TaskFn};
pub use threads::Threads;

#[cfg(feature = "evolution")]
pub use champion::{Candidate, Champion, TieredFitness};
#[cfg(feature = "evolution")]
pub use checkpoint::{CHECKPOINT_FORMAT, CHECKPOINT_VERSION, Checkpoint};
#[cfg(feature = "evolution")]
pub use evaluator::{Evaluator, Serial, evaluate_phenotypes};
#[cfg(feature = "parallel")]
pub use evaluator::{Parallel, ThreadsError};
#[cfg(feature = "evolution")]
pub use evolution::{Evolution, EvolutionError};
#[cfg(feature = "evolution")]
pub use observer::{Generation, Observer, ObserverError};
#[cfg(feature = "evolution")]
pub use progress::Progress;
#[cfg(feature = "evolution")]
pub use statistics::{GenerationReport, Quantiles};
#[cfg(feature = "evolution")]
pub use stop::{StopConditions, StopReason, StopSignal};
