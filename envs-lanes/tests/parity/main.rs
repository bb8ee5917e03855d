//! The lanes against rapier: to the bit.
//!
//! | file | what is compared |
//! |---|---|
//! | `trajectories` | shipped creatures, step by step |
//! | `any_creature`, `all_creatures` | random creatures in random worlds: whatever a creature file can say |
//! | `scenes` | single effects whose physics is known: fall, slide, motor, limit, rest |
//! | `gauges`, `soundness` | how far joints, limits and the ground give way |
//! | `evaluations`, `batches`, `contract` | whole evaluations, in any batch, on any thread |
//! | `physics` | worlds that differ in what engines differ in, and pushes, another in each lane |
//! | `recordings` | controllers in worlds of their own, shown moment by moment |
//! | `driven` | creatures that are driven from outside, step by step |
//! | `failures`, `refusals` | what goes wrong, and what lanes cannot do |
//! | `control` | rapier against rapier, started 0.2 µm higher: how large a difference of nothing becomes |
//!
//! An upgrade of rapier that changes the solver turns these tests red.

mod all_creatures;
mod any_creature;
mod batches;
mod contract;
mod control;
mod driven;
mod evaluations;
mod failures;
mod gauges;
mod physics;
mod recordings;
mod refusals;
mod scenes;
mod soundness;
mod stage;
mod trajectories;
