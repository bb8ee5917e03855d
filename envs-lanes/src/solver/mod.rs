//! rapier's solver for one kind of creature, with a lane for each creature.
//!
//! A time step is [`LaneWorld::step`](world::LaneWorld::step); its parts, in order:
//!
//! | part | file | what it does |
//! |---|---|---|
//! | find contacts | `level.rs`, `floor.rs`, `uneven.rs`, `ledges.rs` | which points of which shapes are near the ground, and their effective masses |
//! | for each substep: fall | `body.rs` | gravity changes the velocities |
//! | prepare joints | `joint.rs` | rows of the hinges from where the bodies are now |
//! | prepare contacts | `rows.rs` | how far each point is from the ground now; last impulses are applied again |
//! | solve | `joint.rs`, `rows.rs` | Gauss–Seidel sweeps over all rows, joints first, contacts last |
//! | move | `body.rs` | velocities change the positions |
//! | relax | `joint.rs`, `rows.rs` | one sweep without the terms that push bodies back into place |
//!
//! This is the "soft step" of Catto's Solver2D (*Solver2D*, box2d.org, 2024): small substeps (Macklin et al., *Small
//! Steps in Physics Simulation*, 2019), constraints as damped springs (Catto, *Soft Constraints*, GDC 2011), and a
//! relaxing sweep, as rapier2d has it (Apache-2.0, dimforge). **The arithmetic is rapier's, operation by operation and in
//! its order**: 32-bit sums are not associative, and a solver that is as good but rounds otherwise is another world to a
//! gait. What is left out is what is exactly zero for a creature on fixed ground: its velocity, its inverse mass.

mod body;
mod contacts;
mod floor;
mod joint;
mod ledges;
mod level;
mod mass;
mod normal;
mod order;
mod pace;
mod rows;
mod softness;
mod uneven;
mod world;

pub use order::ENGINE;
pub(crate) use world::LaneWorld;
