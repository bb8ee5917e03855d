//! The physics of `envs-rapier` for a whole population at once: one creature in each SIMD lane, with the same bits.
//!
//! Physics is nearly all the cost of neuroevolution on bodies, and a general engine spends most of it on bookkeeping for
//! one small creature at a time. All creatures of a population have the same body, so sixteen of them can be stepped by
//! the same instructions, each in a lane of its own. That takes hardly longer than one.
//!
//! - [`LaneEpisode`] is the [`Task`](ne_core::Task) for training: it plays batches.
//! - [`play`] shows what controllers do, each in a world of its own.
//! - [`DrivenLanes`] are creatures whose actions come from outside, step by step.
//! - [`LaneEnvironment`] is a single creature, for callers that take a [`tasks::Environment`].
//!
//! Three decisions:
//!
//! - **The same bits as rapier, not physics as good.** A gait is a long chain of contacts, each of which decides the
//!   next; another rounding is another chain, and a controller that leans on one exact chain falls in the other. So the
//!   solver does rapier's arithmetic at our settings, operation by operation, and tests compare every part's position and
//!   velocity to the bit. Another version of rapier can break this; the tests say so.
//! - **A lane knows nothing of its neighbours.** No operation mixes lanes, and none is fused or reordered. Therefore a
//!   creature's result is its result alone: on any lane, with any number of lanes, on any instruction set and thread.
//! - **Refuse what is not the same.** Water, parts of one creature that collide with each other, continuous collision
//!   detection, capsules on ground with boxes and more than 100 parts that hang on one are rapier's; asking for them here is
//!   an error that says so.
//!
//! ```
//! use creatures::{Blueprint, find};
//! use envs_lanes::{LaneEnvironment, LaneEpisode};
//! use ne_core::{Phenotype, Seed, Task};
//! use ne_net::{DenseNet, DenseShape};
//! use tasks::{Running, Trials};
//!
//! let blueprint = Blueprint::new(find("tetrapod-2")?)?;
//! let sensors = blueprint.creature().sensors.clone();
//! let environment = LaneEnvironment::new(blueprint, &sensors, 3.0, Default::default(), Default::default())?;
//! let task = LaneEpisode::new(environment, Box::new(Running::default()), 100, Trials::default())?;
//!
//! let shape = DenseShape::new(task.inputs(), vec![10], task.outputs());
//! let mut nets = Vec::new();
//! for weight in [0.1, 0.2, 0.3] {
//!     nets.push(DenseNet::new(shape.clone(), &vec![weight; shape.weight_count()])?);
//! }
//! let mut batch: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
//! let evaluations = task.evaluate_batch(&mut batch, Seed::of_run(1));
//! assert_eq!(evaluations.len(), 3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod batch;
mod controllers;
mod driven;
mod engine;
mod episode;
mod evaluation;
mod instructions;
mod lane_player;
mod lanes;
mod net;
mod profile;
mod recording;
mod senses;
mod solver;
mod stopwatch;
mod workload;

pub use driven::{DrivenEnd, DrivenLanes, DrivenStep};
pub use engine::{LaneEngine, LaneEnvironment};
pub use episode::LaneEpisode;
pub use instructions::Instructions;
pub use recording::{Play, play};
pub use solver::ENGINE;
pub use stopwatch::Profile;

/// Creatures side by side: a register of AVX-512, and several of those of smaller processors, which have time for it.
pub const LANES: usize = 16;
