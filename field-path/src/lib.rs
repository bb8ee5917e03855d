//! Reads JSON so that what is wrong with it has the name of a field, such as `parts[2].shape.box.width`.
//!
//! ```
//! let error = field_path::from_str::<std::collections::BTreeMap<String, Vec<f32>>>(r#"{ "limits": [1, "far"] }"#);
//! let error = error.expect_err("a text is no number");
//! assert_eq!(error.to_string(), "field limits[1]: invalid type: string \"far\", expected f32");
//! assert_eq!((error.line, error.column), (1, 17));
//! ```
//!
//! The crate `serde_path_to_error` does this for any format, by wrapping each visitor of each type in one of its own. Configurations of Gambol
//! have hundreds of types, and half of the code of `gambol-runs` was such wrappers. Here the reader itself knows where it is: a text
//! is taken apart by `serde_json`, one list or object at a time, and what fails below one is told its place on the way up. Types are
//! read as `serde_json` reads them from a text, with the messages it has where it reads them from a `Value`, which say more; a test compares
//! all three. One thing is refused that `serde_json` reads: an object as a list of its fields' values.

mod fault;
mod json;
mod reader;

use reader::Reader;
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::{Value, value::RawValue};

/// A value that is not what its type asks for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("field {path}: {message}")]
pub struct FieldError {
    /// The field, such as `strategy.cma-es.population`; `.` for the whole.
    pub path: String,
    /// What is wrong with it.
    pub message: String,
    /// The line where its value begins, from 1; of a text that is no JSON, where that shows.
    pub line: usize,
    /// The column, in bytes from 1; at the very end of a text from 0.
    pub column: usize,
    /// Whether the text is no JSON.
    pub is_syntax: bool,
}

/// Reads a text.
///
/// # Errors
/// [`FieldError`] if it is no JSON, else for the first field that is wrong.
pub fn from_str<'de, T: Deserialize<'de>>(text: &'de str) -> Result<T, FieldError> {
    from_slice(text.as_bytes())
}

/// Reads a text as bytes.
///
/// # Errors
/// As [`from_str`].
pub fn from_slice<'de, T: Deserialize<'de>>(text: &'de [u8]) -> Result<T, FieldError> {
    let whole: &RawValue = serde_json::from_slice(text).map_err(|error| not_json(&error))?;
    T::deserialize(Reader::new(whole.get())).map_err(|fault| fault.explain(text))
}

/// Reads a value, by way of its text: a number is rounded once, to what it becomes.
///
/// # Errors
/// As [`from_str`]; lines and columns mean nothing.
pub fn from_value<T: DeserializeOwned>(value: &Value) -> Result<T, FieldError> {
    from_str(&value.to_string())
}

fn not_json(error: &serde_json::Error) -> FieldError {
    let message = without_place(&error.to_string()).to_owned();
    FieldError { path: ".".into(), message, line: error.line(), column: error.column(), is_syntax: true }
}

/// What `serde_json` says, without its "at line 1 column 2".
pub fn without_place(message: &str) -> &str {
    message.rsplit_once(" at line ").map_or(message, |(message, _)| message)
}
