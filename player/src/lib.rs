//! Plays a champion in a game: from the state of its body to the speeds its motors are asked for, once a frame.
//!
//! The one decision behind this crate: **the game has the physics, the player has everything else.** A game steps bodies
//! and hinges, as it does for all its objects; what a controller senses of them, how that is scaled, which phase a clock
//! has, what the net remembers, and what its outputs mean to motors is here, to the bit as it was in training. So the crate
//! is `no_std`, knows no engine, reads a file of a few kB, and allocates while it loads and never again.
//!
//! ```text
//! file ── Character ── Player ◄── every frame: where the parts are, what the game measures, the player's command
//!            │            └─────► the speed each motor is asked for, or its torque
//!            └── parts, hinges, motors: what to build in the engine
//! ```
//!
//! | type | what it is |
//! |---|---|
//! | [`Character`] | what a file holds: body, senses, net, motors; shared by all that play it |
//! | [`Player`] | one body that is played: clocks, memory of the net |
//! | [`PartState`] | where a part is and how it moves |
//! | [`Command`] | what the character is told: how fast to go, whether to jump |
//!
//! ```
//! use player::{Command, PartState, Player};
//!
//! # let bytes = player::example();
//! let character = player::Character::from_bytes(&bytes)?;
//!
//! // Build a body for each part and a hinge for each joint in your engine, then, every frame:
//! let mut player = Player::new(character.into())?;
//! let parts: Vec<PartState> = player.character().start_pose().collect();
//! let speeds = player.tick(&parts, &[], Command::run(1.0), 1.0 / 60.0)?;
//! assert_eq!(speeds.len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! With the feature `champion`, which needs `std`, a character is read from a *champion.json* too (`Character::read_champion`), or made of
//! a creature and a net.
//!
//! # Units
//! Metres, kilograms, seconds, radians; x points forward, y up; angles count counter-clockwise. The specification of the
//! file, and of everything that is computed, is `docs/player.md`.
#![no_std]

extern crate alloc;
#[cfg(any(test, feature = "champion"))]
extern crate std;

mod body;
#[cfg(feature = "champion")]
mod champion;
mod character;
mod error;
mod example;
mod facing;
mod file;
mod net;
mod player;
mod state;

#[cfg(feature = "champion")]
pub use champion::{ChampionError, CharacterParts};
pub use character::{Character, Facing, Hinge, Medium, Motor, Outside, Part, World};
pub use creatures::{Actuation, Probe, Shape, Source, symmetry::Asymmetry};
pub use error::{FileError, TickError, VERSION};
#[doc(hidden)]
pub use example::example;
pub use file::{MAGIC, source_record};
pub use ne_net::Activation;
pub use net::{Net, Neuron};
pub use player::Player;
pub use state::{Command, PartState};
