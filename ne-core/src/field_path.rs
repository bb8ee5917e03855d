//! Reads a value so that what is wrong with it has the name of a field.

use serde::{Deserializer, de::DeserializeOwned};

/// A value that is not what its type asks for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("field {path}: {message}")]
pub struct FieldError {
    /// The field, such as `strategy.cma-es.population`; `.` for the whole.
    pub path: String,
    /// What is wrong with it.
    pub message: String,
}

/// Reads a value. For each kind of reader the code that reads a type is made anew: of text take that of `from_slice`.
///
/// # Errors
/// [`FieldError`] for the first field that is wrong.
pub fn read<'de, T: DeserializeOwned, D: Deserializer<'de>>(reader: D) -> Result<T, FieldError> {
    serde_path_to_error::deserialize(reader).map_err(|error| {
        let (path, message) = (error.path().to_string(), error.inner().to_string());
        FieldError { path, message: without_place(&message).to_owned() }
    })
}

/// What the parser says, without its "at line 1 column 2".
pub(crate) fn without_place(message: &str) -> &str {
    message.rsplit_once(" at line ").map_or(message, |(message, _)| message)
}
