//! Checks that plug-in authors run in their own tests, for the contracts of this crate: [`check_environment`],
//! [`check_movement`] and [`check_rules`]. What they have in common with all checks is said in [`ne_core::conformance`].
//!
//! ```
//! use tasks::{Energy, Running, Sum, conformance::check_movement};
//!
//! check_movement(&Sum::of(Running::default()).plus(-0.01, Energy::default()))?;
//! # Ok::<(), ne_core::conformance::Violation>(())
//! ```

pub mod environment;
pub mod movement;
mod playing;
pub mod rules;
mod stories;

pub use environment::check_environment;
pub use movement::check_movement;
pub use rules::check_rules;

/// Checks that a name can be typed.
fn typed(name: &str) -> Result<(), String> {
    let typed = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
    if name.is_empty() || !name.chars().all(typed) { Err(format!("the name {name:?}")) } else { Ok(()) }
}
