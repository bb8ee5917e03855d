//! From text to a creature, with errors that say where.

use serde::Deserialize;
use serde_json::Value;
use serde_json::error::Category;

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
    let header: Header = from_json(text, false)?;
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
    from_json(text, true)
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

/// `is_json` says that the text is known to be JSON, so that no fault in it can be one of syntax.
fn from_json<'a, T: Deserialize<'a>>(text: &'a str, is_json: bool) -> Result<T, CreatureError> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let path = error.path().to_string();
        explain(path, error.inner(), is_json)
    })?;
    json.end().map_err(|error| explain(String::new(), &error, is_json))?;
    Ok(value)
}

fn explain(path: String, error: &serde_json::Error, is_json: bool) -> CreatureError {
    let (line, column) = (error.line(), error.column());
    let place = format!(" at line {line} column {column}");
    let message = error.to_string();
    let message = message.strip_suffix(&place).unwrap_or(&message).to_owned();
    let too_large = message == "number out of range";
    if error.classify() != Category::Data && !too_large && !is_json {
        return CreatureError::Syntax { line, column, message };
    }
    let path = if path.is_empty() || path == "." { "the file".to_owned() } else { shortened(&path) };
    if too_large {
        let message = "expected a number that fits single precision (at most 3.4e38), found a larger one".to_owned();
        return CreatureError::Field { path, line, column, message };
    }
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
    match message {
        // What serde_json calls faults of syntax where it wants a variant of an enum, or the end of a short list.
        "expected value" => return "expected a name, or an object with one name in it".to_owned(),
        "trailing characters" => return "too many values in the list".to_owned(),
        _ => {}
    }
    let Some((found, expected)) = message.rsplit_once(", expected ") else {
        return message.to_owned();
    };
    let expected = match expected {
        "f32" => "a number",
        "i32" | "u32" => "a whole number",
        "a sequence" => "a list",
        other if other.starts_with("struct variant") => "an object with its settings",
        other if other.starts_with("struct ") => "an object",
        "unit" => "no settings: the name alone",
        "an array of length 2" => "a list of 2 numbers",
        other => other,
    };
    let found = found.replace("unit variant", "a name alone").replace("type: map", "type: an object");
    format!("{}, expected {expected}", shortened(&found))
}
