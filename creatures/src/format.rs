//! How a creature file says what it is.

/// What the `format` field of a creature file says.
pub const FORMAT: &str = "gambol creature";
/// The version of the file format that this crate reads and writes.
pub const VERSION: u32 = 1;
