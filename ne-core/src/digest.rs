//! A small, portable digest (FNV-1a, 64 bits) that tells whether two byte sequences are the same: files, trajectories,
//! runs. It finds accidents, not attacks.

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Number, Value};
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
        // A value that is there can be read.
        JsonDigest.deserialize(value).unwrap_or_default()
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

/// Reads a JSON value and gives its digest, without keeping the value: that of a long array takes no memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JsonDigest;

impl<'de> DeserializeSeed<'de> for JsonDigest {
    type Value = Digest;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Digest, D::Error> {
        let mut digest = Digest::default();
        AddTo(&mut digest).deserialize(deserializer)?;
        Ok(digest)
    }
}

/// Adds a JSON value to a digest.
struct AddTo<'a>(&'a mut Digest);

impl AddTo<'_> {
    fn add_number(self, number: &Number) {
        self.0.add(b"#");
        self.0.add(number.to_string().as_bytes());
    }
}

impl<'de> DeserializeSeed<'de> for AddTo<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for AddTo<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.0.add(b"n");
        Ok(())
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<(), E> {
        self.0.add(if value { b"t" } else { b"f" });
        Ok(())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<(), E> {
        self.add_number(&value.into());
        Ok(())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<(), E> {
        self.add_number(&value.into());
        Ok(())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<(), E> {
        self.add_number(&Number::from_f64(value).ok_or_else(|| E::custom("a number that is not finite"))?);
        Ok(())
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<(), E> {
        self.0.add_text(b"s", value);
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<(), A::Error> {
        self.0.add(b"[");
        let mut count = 0_u64;
        while items.next_element_seed(AddTo(self.0))?.is_some() {
            count += 1;
        }
        self.0.add(b"]");
        self.0.add(&count.to_le_bytes());
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<(), A::Error> {
        let mut found: Vec<(String, Digest)> = Vec::new();
        while let Some(key) = fields.next_key()? {
            found.push((key, fields.next_value_seed(JsonDigest)?));
        }
        found.sort_by(|(a, _), (b, _)| a.cmp(b));
        self.0.add(b"{");
        self.0.add(&(found.len() as u64).to_le_bytes());
        for (key, value) in found {
            self.0.add_text(b"k", &key);
            self.0.add(&value.0.to_le_bytes());
        }
        Ok(())
    }
}
