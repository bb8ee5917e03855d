//! The library's errors as Python's.

use pyo3::{PyErr, PyResult, exceptions::PyValueError};

/// An argument that is wrong, in the library's own words.
pub(crate) fn wrong(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Checks a number of threads; 0 is one for each core.
pub(crate) fn check_threads(threads: usize) -> PyResult<()> {
    match threads > 1024 {
        true => Err(wrong(format!("threads = {threads}: must be from 0 to 1024"))),
        false => Ok(()),
    }
}
