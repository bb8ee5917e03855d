//! Creatures in rapier2d: the reference physics of Gambol.
//!
//! [`RapierWorld`] builds a [`Blueprint`](creatures::Blueprint) and its ground in a rapier world of its own; all else,
//! from settling to measuring, it has from `envs-core`, as every engine. Two decisions:
//!
//! - **Settings with reasons.** rapier's defaults suit piles of crates; creatures with strong motors need others. Each
//!   field of [`PhysicsSettings`] says what breaks without it, and a test of this crate shows it break.
//! - **A copy goes on to the bit as the original would.** That is what lets an episode begin with a copy of a settled
//!   world, and a test of this crate shows it too.
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

mod world;

pub use envs_core::{EnvironmentError, PhysicsSettings, Variation, Water};
pub use world::RapierWorld;

/// A creature in rapier2d.
pub type RapierEnvironment = envs_core::CreatureEnvironment<RapierWorld>;

/// The exact version of rapier2d this crate is built with; another version gives other trajectories.
pub const RAPIER_VERSION: &str = "0.36.1";
