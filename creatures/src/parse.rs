//! From text to a creature, with errors that say where.

use field_path::FieldError;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::error::UnknownName;
use crate::format::{FORMAT, VERSION};
use crate::names::{nearest, shortened};
use crate::{Creature, CreatureError};

impl Creature {
    /// Reads a creature file. Only its form is checked here; [`Blueprint::new`](crate::Blueprint::new) checks the rest.
    ///
    /// # Errors
    /// [`CreatureError::Syntax`] for text that is no JSON, [`CreatureError::NotACreature`] and
    /// [`CreatureError::Version`] for other files, [`CreatureError::Field`] and [`CreatureError::UnknownName`] for
    /// fields that do not fit the format.
    pub fn from_json(text: &str) -> Result<Self, CreatureError> {
        creature(text)
    }
}

/// Read before everything else, so that a file of another kind or of a later version is not blamed for its fields.
#[derive(Deserialize)]
struct Header {
    format: Option<Value>,
    version: Option<Value>,
}

fn creature(text: &str) -> Result<Creature, CreatureError> {
    let header: Header = from_json(text)?;
    match &header.format {
        Some(Value::String(format)) => check_format(format)?,
        Some(other) => return Err(CreatureError::NotACreature { found: shortened(&other.to_string()) }),
        None => return Err(CreatureError::NotACreature { found: "none".to_owned() }),
    }
    match &header.version {
        Some(version) if version.as_u64() == Some(u64::from(VERSION)) => {}
        Some(other) => return Err(CreatureError::Version { found: shortened(&other.to_string()) }),
        None => return Err(CreatureError::Version { found: "none".to_owned() }),
    }
    from_json(text)
}

/// Checks the header of a creature, wherever it comes from.
pub(crate) fn check_header(creature: &Creature) -> Result<(), CreatureError> {
    check_format(&creature.format)?;
    if creature.version != VERSION {
        return Err(CreatureError::Version { found: creature.version.to_string() });
    }
    Ok(())
}

fn check_format(format: &str) -> Result<(), CreatureError> {
    if format == FORMAT {
        return Ok(());
    }
    Err(CreatureError::NotACreature { found: format!("{:?}", shortened(format)) })
}

fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, CreatureError> {
    field_path::from_str(text).map_err(explain)
}

fn explain(error: FieldError) -> CreatureError {
    let FieldError { path, message, line, column, is_syntax } = error;
    if is_syntax {
        return CreatureError::Syntax { line, column, message };
    }
    let path = if path == "." { "the file".to_owned() } else { shortened(&path) };
    if let Some((found, valid)) = unknown(&message) {
        let what = if message.starts_with("unknown field") { "field" } else { choice_at(&path) };
        let nearest = nearest(&found, valid.iter().map(String::as_str));
        let found = shortened(&found);
        return CreatureError::UnknownName(Box::new(UnknownName { path, line, column, what, found, nearest, valid }));
    }
    CreatureError::Field { path, line, column, message: plain(&message) }
}

/// What a file chooses at a path.
fn choice_at(path: &str) -> &'static str {
    if path.starts_with("sensors") {
        "sensor"
    } else if path.contains("decorations") {
        "form"
    } else {
        "shape"
    }
}

/// Takes apart serde's ``unknown field `x`, expected `a` or `b` `` (or `variant`): it keeps the names nowhere else.
fn unknown(message: &str) -> Option<(String, Vec<String>)> {
    let rest = message.strip_prefix("unknown field `").or_else(|| message.strip_prefix("unknown variant `"))?;
    let (name, expected) = rest.rsplit_once("`, expected ")?;
    let valid = expected.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    Some((name.to_owned(), valid))
}

/// Says in plain words what serde says in Rust's.
fn plain(message: &str) -> String {
    if message.ends_with("expected fewer elements in array") {
        return "too many values in the list".to_owned();
    }
    let Some((found, expected)) = message.rsplit_once(", expected ") else {
        return message.to_owned();
    };
    let expected = match expected {
        "f32" => "a number",
        "i32" | "u32" => "a whole number",
        "a sequence" => "a list",
        "string or map" | "map with a single key" => "a name, or an object with one name in it",
        other if other.starts_with("struct variant") => "an object with its settings",
        other if other.starts_with("struct ") => "an object",
        "unit" => "no settings: the name alone",
        "an array of length 2" => "a list of 2 numbers",
        other => other,
    };
    let found = found.replace("unit variant", "a name alone").replace("type: map", "type: an object");
    format!("{}, expected {expected}", shortened(&found))
}
