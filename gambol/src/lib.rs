//! Gambol: evolves controllers for 2D creatures, shows the gait, and saves it for a game.
//!
//! This library ties the others together: it is what the `gambol` program, a studio or a test calls, and the program itself is
//! in it: [`program`], for everybody's movements. Its one decision:
//! **a run is a folder.** Everything that happens is a file in it, written whole or not at all, and everything that
//! looks at a run (resuming, reporting, verifying, replaying) reads those files and nothing else. So viewers attach and
//! detach as they like, and a run can be killed at any moment.
//!
//! | module | what it does |
//! |---|---|
//! | [`config`] | the configuration of a run; presets; putting one together |
//! | [`setup`] | from a configuration to a task |
//! | [`search`] | the strategies a configuration can name |
//! | [`training`] | train, resume |
//! | [`shaping`] | train in stages, go on from what was learned |
//! | [`lesson`] | train, report and verify in one call |
//! | [`run_folder`] | which file is what |
//! | [`compare`] | strategies against each other, with paired seeds |
//! | [`champion`] | the saved champion; verifying it |
//! | [`front`] | the saved compromises between several objectives |
//! | [`trajectory`] | recording what a champion does; CSV |
//! | [`dot`] | a champion's net as a drawing |
//! | [`gait`] | a champion's gait, measured and judged: whether it is usable |
//! | [`sheet`] | a gait as one image: a contact sheet with charts |
//! | [`worlds`] | worlds in which gaits are judged, many at once |
//! | [`robust`] | what is left of it in worlds that are not quite the same |
//! | [`report`] | the HTML page |
//! | [`reproduce`] | the experiments of the thesis Gambol starts from, beside what it reports |
//! | [`yardsticks`] | the strategies on classic tasks, beside published numbers |
//! | [`source`] | finding a creature by name or path |
//!
//! # Train, verify
//!
//! ```
//! use gambol::training::{TrainOptions, train};
//! use gambol::Registry;
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
//!     on_generation: &mut |report| assert!(report.evaluations > 0),
//! };
//! let outcome = train(&config, &folder.path().join("run"), options)?;
//! let champion = outcome.champion.expect("somebody jumped");
//! assert!(champion.verify(&registry)?.is_identical());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod assembly;
pub mod champion;
mod commands;
pub mod compare;
pub mod config;
pub mod defaults;
pub mod dot;
pub mod episode_parts;
pub mod front;
pub mod gait;
mod jury;
pub mod lesson;
pub mod nominal;
pub mod obstacles;
mod perturbation;
pub mod presets;
mod proving;
mod recorder;
mod registry;
pub mod report;
pub mod reproduce;
pub mod request;
pub mod robust;
pub mod run_folder;
pub mod setup;
pub mod shaping;
pub mod sheet;
pub mod source;
pub mod stage;
pub mod strategies;
pub mod suggest;
mod topology;
pub mod training;
pub mod training_task;
pub mod trajectory;
pub mod yardsticks;

pub use commands::program;
pub use registry::Registry;
pub use setup::Setup;
