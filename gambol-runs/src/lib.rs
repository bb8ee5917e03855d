//! One run: from what a user asks for to a champion in a folder.
//!
//! Its one decision: **a run is a folder.** Everything that happens is a file in it, written whole or not at all, and
//! everything that looks at a run (resuming, reporting, verifying, replaying) reads those files and nothing else. So viewers
//! attach and detach as they like, and a run can be killed at any moment. Nothing here prints, draws or reads a command line.
//!
//! From the bottom up; no module imports one below it:
//!
//! | module | what it does |
//! |---|---|
//! | [`config`] | the configuration of a run, as plain data |
//! | [`strategies`], [`defaults`], [`presets`], [`catalogue`], [`Registry`] | what a configuration can name |
//! | [`episode_parts`], [`obstacles`] | what a population is evaluated on |
//! | [`judge`] | where gaits are judged: the reference world, and worlds near it |
//! | [`setup`] | from a configuration to a task |
//! | [`champion`], [`front`], [`trajectory`] | what a run has found, saved; verifying and recording it |
//! | [`gait`], [`robust`] | a champion's gait, judged, also in perturbed worlds |
//! | [`run_folder`], [`recorder`] | which file is what, and what is written in it |
//! | [`training`], [`run`] | train, resume; a run as an object, a generation at a time |
//! | [`shaping`] | train in stages, go on from what was learned |
//! | [`request`], [`source`] | what a user asks for, by names and files |
//! | [`suggest`], [`texts`] | how messages and files say it |
//! | `schema` | the JSON Schema of a configuration; with the feature `schema` |
//!
//! # Train, verify
//!
//! ```
//! use gambol_runs::{Registry, training::{TrainOptions, train}};
//!
//! let registry = Registry::default();
//! let mut config = registry.config("default", creatures::find("biped-1")?, "jumping")?;
//! config.stop.generations = Some(2);
//! config.movement.steps = Some(50);
//! let folder = tempfile::tempdir()?;
//! let options = TrainOptions {
//!     threads: 1,
//!     registry: registry.clone(),
//!     signal: Default::default(),
//!     on_generation: &mut |generation| assert!(generation.report.evaluations > 0),
//! };
//! let outcome = train(&config, &folder.path().join("run"), options)?;
//! let champion = outcome.champion.expect("one of them jumped");
//! assert!(champion.verify(&registry)?.is_identical());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assembly;
pub mod catalogue;
pub mod champion;
mod champion_selection;
pub mod config;
pub mod defaults;
pub mod episode_parts;
pub mod front;
pub mod gait;
pub mod judge;
mod layers;
pub mod obstacles;
mod perturbation;
pub mod presets;
mod program_name;
pub mod recorder;
mod reference;
mod registry;
pub mod request;
pub mod robust;
mod robustness_check;
pub mod run;
pub mod run_folder;
#[cfg(feature = "schema")]
pub mod schema;
pub mod setup;
pub mod shaping;
pub mod source;
pub mod strategies;
pub mod suggest;
pub mod texts;
mod tiers;
mod topology;
pub mod training;
mod training_task;
pub mod trajectory;
mod unique_keys;

pub use program_name::{program_name, set_program_name};
pub use registry::{Registry, RegistryError, UnknownPreset};
pub use setup::Setup;
