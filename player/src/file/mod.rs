//! The file of a character: a header, and fields one after the other, all numbers with the lowest byte first.
//!
//! `docs/player.md` is its specification.

mod codes;
mod read;
mod validate;
mod write;

pub use codes::source_record;

use crate::{Character, FileError};
use alloc::vec::Vec;

/// What a file begins with.
pub const MAGIC: [u8; 8] = *b"GAMBOLPL";

/// Magic, version, length and digest of what follows.
const HEADER: usize = 24;

impl Character {
    /// Reads a character's file.
    ///
    /// # Errors
    /// If the bytes are not one: cut, changed, of another version, or with a number that is out of range. Whatever they are,
    /// nothing panics, and no more memory is taken than a small multiple of their length.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, FileError> {
        read::read(bytes)
    }

    /// Writes the file; [`from_bytes`](Self::from_bytes) gives the same character back.
    ///
    /// # Errors
    /// If it is [not valid](Self::validate), or is the mirror image of a file's.
    pub fn to_bytes(&self) -> Result<Vec<u8>, FileError> {
        write::write(self)
    }

    /// Checks every number.
    ///
    /// # Errors
    /// Names the first field that is out of range, and what is allowed.
    pub fn validate(&self) -> Result<(), FileError> {
        validate::validate(self)
    }
}

/// FNV-1a, 64 bits (RFC 9923): finds accidents, not attacks.
fn digest(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |digest, &byte| (digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests;
