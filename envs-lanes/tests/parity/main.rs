//! The lanes against rapier: to the bit.
//!
//! The yardstick that would do is rapier against itself, started 0.2 µm higher. It is not needed: nothing differs. An
//! upgrade of rapier that changes the solver turns these tests red.

mod evaluations;
mod stage;
mod trajectories;
