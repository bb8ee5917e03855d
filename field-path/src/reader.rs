//! Reads types from JSON as `serde_json` does, and knows where it is.

use crate::{fault::Fault, json::Json};
use serde::{
    Deserializer,
    de::{
        DeserializeSeed, EnumAccess, Error, Expected, IntoDeserializer, MapAccess, SeqAccess, Unexpected,
        VariantAccess, Visitor, value::StrDeserializer,
    },
    forward_to_deserialize_any,
};
use serde_json::{Number, value::RawValue};
use std::{borrow::Cow, marker::PhantomData, vec};

/// So many lists and objects around each other are read, as `serde_json` does.
const DEEPEST: u8 = 127;

/// In plainer words than "number out of range".
const TOO_LARGE: &str = "expected a number that fits single precision (at most 3.4e38), found a larger one";

/// A value.
#[derive(Clone, Copy)]
pub(crate) struct Reader<'de> {
    text: &'de str,
    depth: u8,
}

// What no type has a part in is kept out of the functions that are made anew for each: these are many.
impl<'de> Reader<'de> {
    pub(crate) fn new(text: &'de str) -> Self {
        Self { text, depth: 0 }
    }

    fn below(self, value: &'de RawValue) -> Self {
        Self { text: value.get(), depth: self.depth + 1 }
    }

    fn json(self) -> Result<Json<'de>, Fault> {
        match Json::parse(self.text)? {
            Json::List(_) | Json::Fields(_) if self.depth == DEEPEST => Err(Fault::custom("recursion limit exceeded")),
            json => Ok(json),
        }
    }

    fn items(self, items: Vec<&'de RawValue>) -> Items<'de> {
        Items { reader: self, items: items.into_iter(), index: 0 }
    }

    fn fields(self, fields: Vec<(Cow<'de, str>, &'de RawValue)>) -> Fields<'de> {
        Fields { reader: self, fields: fields.into_iter(), key: Cow::Borrowed(""), value: None }
    }

    fn list(self, expected: &dyn Expected) -> Result<Items<'de>, Fault> {
        match self.json()? {
            Json::List(items) => Ok(self.items(items)),
            other => Err(other.instead_of(expected)),
        }
    }

    fn object(self, expected: &dyn Expected) -> Result<Fields<'de>, Fault> {
        match self.json()? {
            Json::Fields(fields) => Ok(self.fields(fields)),
            other => Err(other.instead_of(expected)),
        }
    }

    fn text(self, expected: &dyn Expected) -> Result<Cow<'de, str>, Fault> {
        match self.json()? {
            Json::Text(text) => Ok(text),
            other => Err(other.instead_of(expected)),
        }
    }

    fn number(self, expected: &dyn Expected) -> Result<Number, Fault> {
        match self.json()? {
            Json::Number(number) => Ok(number),
            other => Err(other.instead_of(expected)),
        }
    }

    fn boolean(self, expected: &dyn Expected) -> Result<bool, Fault> {
        match self.json()? {
            Json::Bool(value) => Ok(value),
            other => Err(other.instead_of(expected)),
        }
    }

    fn null(self, expected: &dyn Expected) -> Result<(), Fault> {
        match self.json()? {
            Json::Null => Ok(()),
            other => Err(other.instead_of(expected)),
        }
    }

    fn variant(self) -> Result<Variant<'de>, Fault> {
        let (name, content) = match self.json()? {
            Json::Text(name) => (name, None),
            Json::Fields(fields) => match <[_; 1]>::try_from(fields) {
                Ok([(name, content)]) => (name, Some(content)),
                Err(_) => return Err(Fault::invalid_value(Unexpected::Map, &"map with a single key")),
            },
            other => return Err(other.instead_of(&"string or map")),
        };
        Ok(Variant { reader: self, name, content })
    }
}

macro_rules! of_a_text {
    ($($method:ident)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            match self.text(&visitor)? {
                Cow::Borrowed(text) => visitor.visit_borrowed_str(text),
                Cow::Owned(text) => visitor.visit_string(text),
            }
        }
    )*};
}

macro_rules! of_a_number {
    ($($method:ident)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            visit_number(&self.number(&visitor)?, visitor)
        }
    )*};
}

impl<'de> Deserializer<'de> for Reader<'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.json()? {
            Json::Null => visitor.visit_unit(),
            Json::Bool(value) => visitor.visit_bool(value),
            Json::Number(number) => visit_number(&number, visitor),
            Json::Text(Cow::Borrowed(text)) => visitor.visit_borrowed_str(text),
            Json::Text(Cow::Owned(text)) => visitor.visit_string(text),
            Json::List(items) => visit_items(self.items(items), visitor),
            Json::Fields(fields) => visitor.visit_map(self.fields(fields)),
        }
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let value = self.boolean(&visitor)?;
        visitor.visit_bool(value)
    }

    of_a_number! {
        deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64 deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64
        deserialize_f64
    }

    // Rounded once, from the text.
    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        if !self.text.starts_with(|first: char| first == '-' || first.is_ascii_digit()) {
            return visit_number(&self.number(&visitor)?, visitor);
        }
        match serde_json::from_str(self.text) {
            Ok(number) => visitor.visit_f32(number),
            // It is written as a number is.
            Err(_) => Err(Fault::custom(TOO_LARGE)),
        }
    }

    // Of an identifier, too: the number of a variant is no name.
    of_a_text! { deserialize_char deserialize_str deserialize_string deserialize_identifier }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        if self.text == "null" { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.null(&visitor)?;
        visitor.visit_unit()
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_unit(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visit_items(self.list(&visitor)?, visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let fields = self.object(&visitor)?;
        visitor.visit_map(fields)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        // A list of its fields without their names is none: it would be half of the code that reads a type.
        self.deserialize_map(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_enum(self.variant()?)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }

    forward_to_deserialize_any! { i128 u128 bytes byte_buf }
}

fn visit_items<'de, V: Visitor<'de>>(mut items: Items<'de>, visitor: V) -> Result<V::Value, Fault> {
    let length = items.items.len();
    let value = visitor.visit_seq(&mut items)?;
    if items.items.len() == 0 { Ok(value) } else { Err(Fault::invalid_length(length, &"fewer elements in array")) }
}

fn visit_number<'de, V: Visitor<'de>>(number: &Number, visitor: V) -> Result<V::Value, Fault> {
    match (number.as_u64(), number.as_i64()) {
        (Some(number), _) => visitor.visit_u64(number),
        (None, Some(number)) => visitor.visit_i64(number),
        (None, None) => visitor.visit_f64(number.as_f64().unwrap_or(f64::NAN)),
    }
}

/// What is left of a list.
struct Items<'de> {
    reader: Reader<'de>,
    items: vec::IntoIter<&'de RawValue>,
    index: usize,
}

impl<'de> Items<'de> {
    fn next(&mut self) -> Option<Reader<'de>> {
        self.index += 1;
        self.items.next().map(|item| self.reader.below(item))
    }
}

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Fault;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Fault> {
        let Some(item) = self.next() else { return Ok(None) };
        match seed.deserialize(item) {
            Ok(value) => Ok(Some(value)),
            Err(fault) => Err(fault.in_item(self.index - 1, item.text)),
        }
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

/// What is left of an object.
struct Fields<'de> {
    reader: Reader<'de>,
    fields: vec::IntoIter<(Cow<'de, str>, &'de RawValue)>,
    /// That was read last, and its value.
    key: Cow<'de, str>,
    value: Option<Reader<'de>>,
}

impl<'de> Fields<'de> {
    /// The next key and its value.
    fn next(&mut self) -> Option<(Key<'_>, Reader<'de>)> {
        let (key, value) = self.fields.next()?;
        let value = self.reader.below(value);
        (self.key, self.value) = (key, Some(value));
        Some((Key(&self.key), value))
    }
}

impl<'de> MapAccess<'de> for Fields<'de> {
    type Error = Fault;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Fault> {
        let Some((key, value)) = self.next() else { return Ok(None) };
        match seed.deserialize(key) {
            Ok(key) => Ok(Some(key)),
            Err(fault) => Err(fault.in_field(&self.key, value.text)),
        }
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Fault> {
        let Some(value) = self.value.take() else { return Err(Fault::custom("a value is read before its key")) };
        match seed.deserialize(value) {
            Ok(value) => Ok(value),
            Err(fault) => Err(fault.in_field(&self.key, value.text)),
        }
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.fields.len())
    }
}

/// The key of a field: a text, be it that of a number.
struct Key<'a>(&'a str);

impl<'a> Key<'a> {
    fn text(&self) -> StrDeserializer<'a, Fault> {
        self.0.into_deserializer()
    }
}

macro_rules! keys_of_numbers {
    ($($method:ident)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            match serde_json::from_str(self.0) {
                Ok(number) => visit_number(&number, visitor),
                Err(_) => Err(Fault::custom("invalid value: expected key to be a number in quotes")),
            }
        }
    )*};
}

impl<'de> Deserializer<'de> for Key<'_> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.text().deserialize_any(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.text().deserialize_enum(name, variants, visitor)
    }

    keys_of_numbers! {
        deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64 deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64
        deserialize_f32 deserialize_f64
    }

    forward_to_deserialize_any! {
        bool i128 u128 char str string bytes byte_buf unit unit_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

/// A variant of an enum: its name alone, or with what it holds.
struct Variant<'de> {
    reader: Reader<'de>,
    name: Cow<'de, str>,
    content: Option<&'de RawValue>,
}

impl<'de> EnumAccess<'de> for Variant<'de> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self), Fault> {
        seed.deserialize(Key(&self.name)).map(|variant| (variant, self))
    }
}

impl<'de> Variant<'de> {
    /// What it holds, if it is to hold something.
    fn content(&self, expected: &'static str) -> Result<Reader<'de>, Fault> {
        match self.content {
            Some(content) => Ok(self.reader.below(content)),
            None => Err(Fault::invalid_type(Unexpected::UnitVariant, &expected).in_field(&self.name, self.reader.text)),
        }
    }
}

impl<'de> VariantAccess<'de> for Variant<'de> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        if self.content.is_none() { Ok(()) } else { self.newtype_variant_seed(PhantomData) }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Fault> {
        let content = self.content("newtype variant")?;
        seed.deserialize(content).map_err(|fault| fault.in_field(&self.name, content.text))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Fault> {
        let content = self.content("tuple variant")?;
        content.deserialize_seq(visitor).map_err(|fault| fault.in_field(&self.name, content.text))
    }

    fn struct_variant<V: Visitor<'de>>(self, fields: &'static [&'static str], visitor: V) -> Result<V::Value, Fault> {
        let content = self.content("struct variant")?;
        content.deserialize_struct("", fields, visitor).map_err(|fault| fault.in_field(&self.name, content.text))
    }
}
