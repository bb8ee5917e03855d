//! A small, portable digest (FNV-1a, 64 bits) that tells whether two byte sequences are the same: files, trajectories,
//! runs. It finds accidents, not attacks.

use serde_json::Value;
use std::fmt;

/// A running FNV-1a digest of 64 bits.
///
/// Source: Fowler, Noll, Vo, *The FNV Non-Cryptographic Hash Algorithm*, RFC 9923.
///
/// ```
/// use ne_core::digest::Digest;
///
/// let mut digest = Digest::default();
/// digest.add(b"a");
/// assert_eq!(digest.to_string(), "af63dc4c8601ec8c");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Digest {
    /// Adds bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Adds the bits of a number.
    pub fn add_f32(&mut self, value: f32) {
        self.add(&value.to_bits().to_le_bytes());
    }

    /// The digest as a number.
    pub fn value(self) -> u64 {
        self.0
    }

    /// The digest of a JSON value, the same whatever its white space and the order of its keys.
    pub fn of_json(value: &Value) -> Self {
        let mut digest = Self::default();
        digest.add_json(value);
        digest
    }

    fn add_json(&mut self, value: &Value) {
        match value {
            Value::Null => self.add(b"n"),
            Value::Bool(value) => self.add(if *value { b"t" } else { b"f" }),
            Value::Number(number) => {
                self.add(b"#");
                self.add(number.to_string().as_bytes());
            }
            Value::String(text) => self.add_text(b"s", text),
            Value::Array(items) => {
                self.add(b"[");
                self.add(&(items.len() as u64).to_le_bytes());
                items.iter().for_each(|item| self.add_json(item));
            }
            Value::Object(fields) => {
                let mut sorted: Vec<_> = fields.iter().collect();
                sorted.sort_by_key(|(key, _)| *key);
                self.add(b"{");
                self.add(&(sorted.len() as u64).to_le_bytes());
                for (key, value) in sorted {
                    self.add_text(b"k", key);
                    self.add_json(value);
                }
            }
        }
    }

    fn add_text(&mut self, mark: &[u8], text: &str) {
        self.add(mark);
        self.add(&(text.len() as u64).to_le_bytes());
        self.add(text.as_bytes());
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}
