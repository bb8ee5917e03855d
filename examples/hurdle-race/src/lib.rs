//! A hurdle race of characters that [Gambol](../../README.md) has trained; see `README.md` in this folder.
//!
//! | module | what it is |
//! |---|---|
//! | [`body`] | a character in rapier: what every game that has one must do |
//! | [`race`] | the track, its hurdles, the clock, and the positions of the runners |
//! | [`pilot`] | what the computer tells its runners |
//!
//! What is drawn, and the keys, are in `main.rs`.

pub mod body;
pub mod pilot;
pub mod race;
