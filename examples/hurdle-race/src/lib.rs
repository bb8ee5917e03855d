//! A hurdle race of characters that [Gambol](../../README.md) has trained; see `README.md` in this folder.
//!
//! | module | what it is |
//! |---|---|
//! | [`body`] | a character in rapier: what every game that has one must do |
//! | [`race`] | track, hurdles, clock, and who is where |
//! | [`pilot`] | how those that are not yours decide what to do |
//!
//! What is drawn, and the keys, are in `main.rs`.

pub mod body;
pub mod pilot;
pub mod race;
