//! The library's errors as Python's.

use pyo3::{PyErr, exceptions::PyValueError};

/// An argument that is wrong, in the library's own words.
pub(crate) fn wrong(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}
