//! What can be wrong with a file, and with what a game tells.

use core::fmt;

/// The version of the file's format that this crate writes and reads.
pub const VERSION: u32 = 2;

/// Why bytes are not a character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileError {
    /// They do not begin as a character's file does.
    NotACharacter,
    /// They were written by another version of the format.
    Version {
        /// The version they say they have.
        found: u32,
    },
    /// They are not as long as they say.
    Length {
        /// Bytes that should follow the header.
        expected: usize,
        /// Bytes that do.
        found: usize,
    },
    /// They were changed after they were written.
    Digest,
    /// They end in the middle of a field, or go on after the last.
    Cut {
        /// The field.
        field: &'static str,
    },
    /// A number or a text of a field is not allowed.
    Field {
        /// The field.
        field: &'static str,
        /// Which of several, from 0.
        index: usize,
        /// What is allowed.
        allowed: &'static str,
    },
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotACharacter => f.write_str("not a character of Gambol: write one with `gambol export --to player`"),
            Self::Version { found } => {
                write!(f, "version {found} of the format; this player reads version {}", VERSION)
            }
            Self::Length { expected, found } => {
                write!(f, "{found} bytes after the header, which says {expected}: the file was cut or added to")
            }
            Self::Digest => f.write_str("the digest does not fit: the file was changed after it was written"),
            Self::Cut { field } => write!(f, "the file does not end with its last field: {field}"),
            Self::Field { field, index, allowed } => write!(f, "{field}, number {index}: must be {allowed}"),
        }
    }
}

impl core::error::Error for FileError {}

/// Why a frame could not be played. Its motors hold still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TickError {
    /// As many parts are wanted as the character has.
    Parts {
        /// How many it has.
        expected: usize,
        /// How many there were.
        found: usize,
    },
    /// As many measurements are wanted as [`Character::outside`](crate::Character::outside) lists.
    Outside {
        /// How many it lists.
        expected: usize,
        /// How many there were.
        found: usize,
    },
    /// The time of a frame is not from 0 to 1 s.
    Seconds,
    /// A number is not finite. The net's memory begins anew.
    NotFinite,
}

impl fmt::Display for TickError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Parts { expected, found } => write!(f, "{found} parts, and the character has {expected}"),
            Self::Outside { expected, found } => {
                write!(f, "{found} measurements of what is outside, and the character wants {expected}")
            }
            Self::Seconds => f.write_str("the time of a frame must be from 0 to 1 s"),
            Self::NotFinite => f.write_str("a number is not finite; the motors hold still and the net begins anew"),
        }
    }
}

impl core::error::Error for TickError {}
