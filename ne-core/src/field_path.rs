//! Reads a value so that what is wrong with it has the name of a field.

use serde::de::DeserializeOwned;

/// A value that is not what its type asks for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("field {path}: {message}")]
pub struct FieldError {
    /// The field, such as `strategy.cma-es.population`; `.` for the whole.
    pub path: String,
    /// What is wrong with it.
    pub message: String,
}

/// Reads a value from JSON.
///
/// Always from text: for each kind of reader the code that reads a type is made anew, and that code is a third of the program.
///
/// # Errors
/// [`FieldError`] for the first field that is wrong. Text that is not JSON is an error of the field that it breaks in.
pub fn read<T: DeserializeOwned>(text: &[u8]) -> Result<T, FieldError> {
    serde_path_to_error::deserialize(&mut serde_json::Deserializer::from_slice(text)).map_err(|error| {
        let (path, message) = (error.path().to_string(), error.inner().to_string());
        FieldError { path, message: without_place(&message).to_owned() }
    })
}

/// What the parser says, without its "at line 1 column 2".
pub(crate) fn without_place(message: &str) -> &str {
    message.rsplit_once(" at line ").map_or(message, |(message, _)| message)
}
