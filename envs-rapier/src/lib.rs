//! Creatures in rapier2d: the reference physics of Gambol.
//!
//! [`RapierEnvironment`] builds a [`Blueprint`](creatures::Blueprint) in a world of its own, lets it settle, and is then
//! a [`tasks::Environment`]. Three decisions:
//!
//! - **One creature, one world.** Creatures never meet, so a shared world could only couple them by accident. Threads
//!   get different creatures, never parts of one.
//! - **Settle once, copy often.** The settled world is a prototype; an episode begins with a copy of it. So an episode
//!   never pays for settling, and nothing of an earlier one can be left.
//! - **Settings with reasons.** rapier's defaults suit piles of crates; creatures with strong motors need others. Each
//!   field of [`PhysicsSettings`] says what breaks without it, and a test of this crate shows it break.
//!
//! ```
//! use creatures::{Blueprint, Sensor};
//! use envs_rapier::{PhysicsSettings, RapierEnvironment, Variation};
//! use ne_core::Seed;
//! use tasks::Environment;
//!
//! let blueprint = Blueprint::new(creatures::find("tetrapod-2")?)?;
//! let sensors = blueprint.creature().sensors.clone();
//! let mut world = RapierEnvironment::new(blueprint, &sensors, 3.0, PhysicsSettings::default(), Variation::default())?;
//! world.reset(Seed::of_run(1))?;
//! world.act(&[0.5; 8]);
//! world.step()?;
//! assert_eq!(world.snapshot().parts.len(), 9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod body;
mod environment;
mod settings;
mod variation;
mod world;

pub use environment::{EnvironmentError, RapierEnvironment};
pub use settings::PhysicsSettings;
pub use variation::Variation;

/// The exact version of rapier2d this crate is built with; another version gives other trajectories.
pub const RAPIER_VERSION: &str = "0.36.1";
