//! Creatures as plain data: what they are made of, what they sense, what they move, how they look.
//!
//! **The one decision of this crate: a creature is a file, and nothing else.** No code belongs to a particular body,
//! and nothing here knows about physics or about learning. A [`Creature`] is the JSON file as its author wrote it
//! (degrees, names, looks). A [`Blueprint`] is the same creature checked and resolved (radians, indices, local
//! anchors). Every blueprint is valid, so engines never validate. Between a body and its net stand two small tables:
//! [`Senses`] (what the body tells, scaled to what a net likes) and [`Motors`] (what the net asks of the joints). Any
//! engine takes part by implementing [`BodyView`].
//!
//! ```text
//! creature.json ── Creature ── Blueprint ──┬── engine: bodies, hinges, motors
//!                                          ├── Senses: BodyView → inputs of the net, in [-range, range]
//!                                          └── Motors: outputs of the net, in [-1, 1] → rad/s, or angles → rad/s
//! ```
//!
//! # From body to brain
//! - The first part is the *torso*. Every other part hangs by one hinge on a part that stands earlier in the list.
//! - A part whose tag is one of the file's `actuated_tags` (default `leg`) is *actuated*: the motor of the hinge it
//!   hangs on is an output of the net. Other parts come along passively.
//! - A *foot* is the last segment of a leg: an actuated part on which nothing hangs. A chain with a part that says
//!   `"leg": false` is an arm or a tail, and has no foot.
//! - The file lists the *sensors*; by default the rotation of the torso and the angles of the actuated joints, both
//!   relative to the start pose.
//! - What an output asks of its motor, a speed or an angle, is the controller's [`Actuation`], and not the body's.
//!
//! # Example
//! ```
//! # #[cfg(feature = "files")] {
//! use creatures::{Blueprint, Motors, Senses};
//!
//! let creature = creatures::find("tetrapod-2")?;
//! let blueprint = Blueprint::new(creature)?;
//!
//! let senses = Senses::new(&blueprint, &blueprint.creature().sensors, creatures::DEFAULT_INPUT_RANGE)?;
//! let motors = Motors::new(&blueprint);
//! let listed: Vec<String> = senses
//!     .channels()
//!     .iter()
//!     .chain(motors.channels())
//!     .map(|c| format!("{}: {} to {} {}", c.name, c.range[0], c.range[1], c.unit))
//!     .collect();
//!
//! assert_eq!((senses.len(), motors.len()), (9, 8));
//! assert!(listed[0].starts_with("rotation of case: -3.14"));
//! assert_eq!(listed[9], "speed of near front thigh: -12 to 12 rad/s");
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Units
//! Metres, kilograms, seconds, newton metres; x points forward, y up; angles count counter-clockwise. Files hold
//! degrees, everything else radians.
#![cfg_attr(not(feature = "files"), no_std)]

#[cfg(feature = "files")]
mod blueprint;
#[cfg(feature = "files")]
mod body_part;
mod body_view;
#[cfg(feature = "files")]
pub mod bounds;
#[cfg(feature = "files")]
mod channel;
#[cfg(feature = "files")]
mod check;
#[cfg(feature = "files")]
mod colour;
#[cfg(feature = "files")]
mod creature;
#[cfg(feature = "files")]
mod custom;
mod drive;
#[cfg(feature = "files")]
mod error;
#[cfg(feature = "files")]
mod format;
mod landings;
#[cfg(feature = "files")]
mod legs;
mod limit;
#[cfg(feature = "files")]
pub mod look;
#[cfg(feature = "files")]
mod motors;
#[cfg(feature = "files")]
mod names;
#[cfg(feature = "files")]
mod parse;
#[cfg(feature = "files")]
mod problem;
pub mod rotation;
#[cfg(feature = "schema")]
mod schema;
#[cfg(feature = "files")]
mod sense;
#[cfg(feature = "files")]
mod senses;
#[cfg(feature = "files")]
mod sensor;
mod shape;
#[cfg(feature = "files")]
mod shipped;
mod source;
pub mod symmetry;
#[cfg(feature = "files")]
mod terrain;

#[cfg(feature = "files")]
pub use blueprint::Blueprint;
#[cfg(feature = "files")]
pub use body_part::{BodyPart, Hinge};
pub use body_view::BodyView;
#[cfg(feature = "files")]
pub use bounds::Bounds;
#[cfg(feature = "files")]
pub use channel::Channel;
#[cfg(feature = "files")]
pub use colour::Colour;
#[cfg(feature = "files")]
pub use creature::{Creature, Joint, Motor, Part};
#[cfg(feature = "files")]
pub use custom::CustomSensor;
pub use drive::{Actuation, Drive};
#[cfg(feature = "files")]
pub use error::{CreatureError, UnknownName};
#[cfg(feature = "files")]
pub use format::{FORMAT, VERSION};
pub use landings::Landings;
pub use limit::limit;
#[cfg(feature = "files")]
pub use look::{Decoration, Form, Look};
#[cfg(feature = "files")]
pub use motors::Motors;
#[cfg(feature = "files")]
pub use names::is_file_name;
#[cfg(feature = "files")]
pub use problem::Problem;
#[cfg(feature = "schema")]
pub use schema::{json_schema, tidy_schema};
#[cfg(feature = "files")]
pub use sense::Sense;
#[cfg(feature = "files")]
pub use senses::{DEFAULT_INPUT_RANGE, Senses};
#[cfg(feature = "files")]
pub use sensor::{Sensor, SensorKind};
pub use shape::Shape;
#[cfg(feature = "files")]
pub use shipped::{ShippedCreature, UnknownCreature, find, shipped};
pub use source::{Probe, Source, clock_phase, jump_phase, stride_swing};
#[cfg(feature = "files")]
pub use terrain::{
    BodySizes, Direction, DrawnObstacle, ObstacleKind, ObstacleSizes, Obstacles, TERRAINS, Terrain, TerrainEntry,
    TerrainError,
};
