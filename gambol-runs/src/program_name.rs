//! What the program is called in which this library works: messages and pages tell commands of it.

use std::sync::OnceLock;

static NAME: OnceLock<String> = OnceLock::new();

/// Says what the program is called, once: of several calls the first counts. Without one it is `gambol`.
///
/// The name stands in messages and in the commands of a report; no result depends on it.
pub fn set_program_name(name: &str) {
    let _ = NAME.set(name.to_owned());
}

/// What the program is called.
pub fn program_name() -> &'static str {
    NAME.get().map_or("gambol", String::as_str)
}
