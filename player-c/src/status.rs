//! How a call went.

use core::ffi::{CStr, c_char};
use player::{FileError, TickError};

/// How a call went; 0 is well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum GambolStatus {
    /// Well.
    Ok = 0,
    /// A pointer is null that must not be.
    NullPointer = 1,
    /// An index is not below the count.
    Index = 2,
    /// An array is not as long as the character wants it.
    Count = 3,
    /// The time of a frame is not from 0 to 1 s. Motors hold still.
    Seconds = 4,
    /// A number is not finite. Motors hold still, and the net begins anew.
    NotFinite = 5,
    /// The file does not begin as a character's does.
    NotACharacter = 6,
    /// The file is of another version.
    Version = 7,
    /// The file is not as long as it says.
    Length = 8,
    /// The file was changed after it was written.
    Digest = 9,
    /// The file does not end with its last field.
    Cut = 10,
    /// A number or a text of the file is not allowed.
    Field = 11,
    /// The body does not look the same from both sides, and cannot turn round.
    Asymmetric = 12,
    /// What a newer library says.
    Other = 13,
}

impl From<FileError> for GambolStatus {
    fn from(error: FileError) -> Self {
        match error {
            FileError::NotACharacter => Self::NotACharacter,
            FileError::Version { .. } => Self::Version,
            FileError::Length { .. } => Self::Length,
            FileError::Digest => Self::Digest,
            FileError::Cut { .. } => Self::Cut,
            FileError::Field { .. } => Self::Field,
            _ => Self::Other,
        }
    }
}

impl From<TickError> for GambolStatus {
    fn from(error: TickError) -> Self {
        match error {
            TickError::Parts { .. } | TickError::Outside { .. } => Self::Count,
            TickError::Seconds => Self::Seconds,
            TickError::NotFinite => Self::NotFinite,
            _ => Self::Other,
        }
    }
}

/// A [`GambolStatus`] as a sentence, which lives for ever.
#[unsafe(no_mangle)]
pub extern "C" fn gambol_status_text(status: u32) -> *const c_char {
    let text: &CStr = match status {
        0 => c"well",
        1 => c"a pointer is null that must not be",
        2 => c"an index is not below the count",
        3 => c"an array is not as long as the character wants it",
        4 => c"the time of a frame must be from 0 to 1 s",
        5 => c"a number is not finite; the motors hold still and the net begins anew",
        6 => c"not a character of Gambol: write one with gambol export --to player",
        7 => c"the file is of another version than this player reads",
        8 => c"the file is not as long as it says: it was cut or added to",
        9 => c"the digest does not fit: the file was changed after it was written",
        10 => c"the file does not end with its last field",
        11 => c"a number or a text of the file is not allowed",
        12 => c"the body does not look the same from both sides, and cannot turn round",
        _ => c"this player does not know what is wrong",
    };
    text.as_ptr()
}
