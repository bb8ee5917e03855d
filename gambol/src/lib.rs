//! Gambol: evolves controllers for 2D creatures, shows the gait, and saves it for a game.
//!
//! The `gambol` program is in this library, so that other crates can add movements and strategies: [`program`] is all
//! of `main`. Everything it does is in the libraries below it, which are here under one name:
//!
//! | crate | modules |
//! |---|---|
//! | `gambol-runs`: one run | [`config`], [`strategies`], [`defaults`], [`presets`], [`Registry`], [`setup`], [`training`], [`shaping`], [`champion`], [`gait`], [`robust`], [`run_folder`] and others |
//! | `gambol-experiments`: many runs | [`compare`], [`tune`], [`reproduce`], [`gaits`], [`benchmarks`] |
//! | `gambol-reports`: pages and pictures | [`report`], [`sheet`], [`dot`] |
//! | `gambol-exports`: files for games and other programs | [`export`] |
//!
//! [`complete_run`] trains, reports and verifies in one call.

mod commands;
pub mod complete_run;

pub use commands::program;
pub use gambol_experiments::{benchmarks, compare, gaits, reproduce, tune};
pub use gambol_exports as export;
pub use gambol_reports::{dot, drawing, film, report, sheet};
pub use gambol_runs::*;
