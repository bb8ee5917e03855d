//! Creatures in a physics engine, whichever it is.
//!
//! An engine knows bodies, hinges and contacts. What makes a [`tasks::Environment`] of them is the same for every
//! engine, and stands here: [`CreatureEnvironment`] lets a [`Blueprint`](creatures::Blueprint) settle, varies the world
//! from trial to trial, reads the sensors, drives the motors and measures. An engine implements [`Engine`], eight small
//! functions, and nothing else. So two engines can differ in how bodies move, and in nothing that was not meant.
//!
//! ```text
//!  Blueprint, PhysicsSettings, Ground ──┐
//!  Variation ── seed ── Conditions ─────┴── Engine ── Settled ── CreatureEnvironment: tasks::Environment
//! ```
//!
//! Five decisions:
//!
//! - **One creature, one world.** Creatures never meet, so a shared world could only couple them by accident. Threads
//!   get different creatures, never parts of one.
//! - **Settle once, copy often.** The settled world is a prototype; an episode begins with a copy of it. So an episode
//!   never pays for settling, and nothing of an earlier one can be left. Only varied worlds settle for each trial.
//! - **The ground is data.** A [`Ground`] is a list of shapes that any engine can build. A [`Landscape`] is the ground that a
//!   [`Terrain`](creatures::Terrain) becomes for a body, with a list of its obstacles.
//! - **Water is a setting.** With a [`Water`] in the settings there is no ground, and a [`Hull`] tells what drag leaves of a
//!   part's velocity: plain arithmetic that any engine can call before its step.
//! - **A trial's world is drawn before it is built.** [`Variation::draw`] turns a seed into [`Conditions`], numbers that
//!   can be shown and compared; engines draw nothing. [`CreatureEnvironment::under`] builds a world of given conditions.
//!
//! [`conformance::check_sense`] checks a sensor of one's own. [`body_of`] gives what the judges of movements may know of a creature.
//!
//! ```
//! use envs_core::{Conditions, Ground, GroundShape, Variation};
//! use ne_core::Seed;
//!
//! // A step, 20 cm high, from 3 m on.
//! let mut ground = Ground::flat();
//! ground.shapes.push(GroundShape::Box { x: 8.0, y: 0.0, width: 10.0, height: 0.4 });
//! ground.validate()?;
//!
//! // The world of the first trial of a run, for a creature with two motors.
//! let trial = Variation::light().draw(Seed::of_run(1), 2);
//! assert!((0.7..=1.3).contains(&trial.friction));
//! assert!(trial.turns.iter().all(|turn| turn.abs() <= 0.05));
//! assert_eq!(Variation::default().draw(Seed::of_run(1), 2), Conditions::reference(2));
//! # Ok::<(), ne_core::SettingError>(())
//! ```

mod anatomy;
mod body;
mod bumps;
mod conditions;
pub mod conformance;
mod engine;
mod environment;
mod error;
mod ground;
mod inertia;
mod push;
mod settings;
mod settled;
mod terrain;
mod variation;
mod water;

pub use anatomy::body_of;
pub use body::{RestHinge, RestPose, next_gap};
pub use bumps::bumps;
pub use conditions::Conditions;
pub use engine::{Engine, last_substep_share};
pub use environment::{ActuatedHinge, CreatureEnvironment, check_start};
pub use error::EnvironmentError;
pub use ground::{Ground, GroundShape};
pub use push::{Push, PushSchedule};
pub use settings::PhysicsSettings;
pub use settled::Settled;
pub use terrain::{Landscape, Obstacle};
pub use variation::Variation;
pub use water::{Hull, PartVelocity, Water};
