//! A JSON value, taken apart as far as its own items: those are text still.

use crate::fault::Fault;
use serde::{
    Deserialize, Deserializer,
    de::{Error, Expected, MapAccess, Unexpected, Visitor},
};
use serde_json::{Number, value::RawValue};
use std::{borrow::Cow, fmt};

pub(crate) enum Json<'de> {
    Null,
    Bool(bool),
    Number(Number),
    Text(Cow<'de, str>),
    List(Vec<&'de RawValue>),
    Fields(Vec<(Cow<'de, str>, &'de RawValue)>),
}

impl<'de> Json<'de> {
    pub(crate) fn parse(text: &'de str) -> Result<Self, Fault> {
        let json = match text.as_bytes().first() {
            Some(b'n') => Ok(Self::Null),
            Some(b't') => Ok(Self::Bool(true)),
            Some(b'f') => Ok(Self::Bool(false)),
            Some(b'"') => serde_json::from_str(text).map(|Text(text)| Self::Text(text)),
            Some(b'[') => serde_json::from_str(text).map(Self::List),
            Some(b'{') => serde_json::from_str(text).map(|Fields(fields)| Self::Fields(fields)),
            _ => serde_json::from_str(text).map(Self::Number),
        };
        json.map_err(|error| Fault::of_part(&error))
    }

    /// That it is there, and not what is expected.
    #[cold]
    pub(crate) fn instead_of(&self, expected: &dyn Expected) -> Fault {
        Fault::invalid_type(self.unexpected(), expected)
    }

    fn unexpected(&self) -> Unexpected<'_> {
        match self {
            Self::Null => Unexpected::Unit,
            Self::Bool(value) => Unexpected::Bool(*value),
            Self::Number(number) => match (number.as_u64(), number.as_i64()) {
                (Some(number), _) => Unexpected::Unsigned(number),
                (None, Some(number)) => Unexpected::Signed(number),
                (None, None) => Unexpected::Float(number.as_f64().unwrap_or(f64::NAN)),
            },
            Self::Text(text) => Unexpected::Str(text),
            Self::List(_) => Unexpected::Seq,
            Self::Fields(_) => Unexpected::Map,
        }
    }
}

/// Borrowed where nothing in it is escaped.
#[derive(Deserialize)]
struct Text<'a>(#[serde(borrow)] Cow<'a, str>);

/// In the order of the text, and however often a key is there: to refuse it is up to the type.
struct Fields<'de>(Vec<(Cow<'de, str>, &'de RawValue)>);

impl<'de> Deserialize<'de> for Fields<'de> {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        struct All;

        impl<'de> Visitor<'de> for All {
            type Value = Fields<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Fields<'de>, A::Error> {
                let mut fields = Vec::new();
                while let Some((Text(key), value)) = map.next_entry()? {
                    fields.push((key, value));
                }
                Ok(Fields(fields))
            }
        }
        reader.deserialize_map(All)
    }
}
