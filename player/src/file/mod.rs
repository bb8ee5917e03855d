//! The file of a character: a header, and fields one after the other, all numbers with the lowest byte first.
//!
//! `docs/player.md` is its specification.

mod codes;
mod read;
mod validate;
mod write;

pub(crate) use read::read;
pub(crate) use validate::validate;
pub(crate) use write::write;

/// What a file begins with.
pub const MAGIC: [u8; 8] = *b"GAMBOLPL";

/// The version of the format that this crate writes and reads.
pub const VERSION: u32 = 1;

/// Magic, version, length and digest of what follows.
const HEADER: usize = 24;

/// FNV-1a, 64 bits (RFC 9923): finds accidents, not attacks.
fn digest(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |digest, &byte| (digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests;
