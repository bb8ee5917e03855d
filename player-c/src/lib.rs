//! The player of Gambol's characters for C, C++ and WebAssembly.
//!
//! The crate `player` behind functions that any language can call; the header is `include/gambol_player.h`. Two things are
//! owned by the caller and given back by it: a [`GambolCharacter`], which is what a file holds, and a [`GambolPlayer`], which is
//! one body that is played. A player holds its character, so that either may be given back first.
//!
//! Every function that can fail returns a [`GambolStatus`]. None panics, whatever it is given, as long as pointers are null or
//! point to as much as is said. What belongs to different threads is used by one at a time.
//!
//! Built with `--cfg gambol_freestanding` it is `no_std`, with the C library's memory, and small: see `docs/player.md`.
#![cfg_attr(gambol_freestanding, no_std)]
#![allow(unsafe_code)]

extern crate alloc;

mod body;
mod character;
#[cfg(gambol_freestanding)]
mod freestanding;
mod memory;
mod played;
mod status;

pub use body::{GambolHinge, GambolOutside, GambolPart, GambolWorld};
pub use character::*;
pub use memory::*;
pub use played::*;
pub use player::PartState;
pub use status::{GambolStatus, gambol_status_text};
