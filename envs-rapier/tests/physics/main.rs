//! What the physics promises. One test for each setting that differs from rapier's default, which shows what breaks
//! when it is undone.

mod gauge;
mod promises;
mod traps;
mod water;
mod worlds;
