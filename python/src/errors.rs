//! The library's errors as Python's.

use ne_core::Parallel;
use pyo3::{PyErr, PyResult, exceptions::PyValueError};

/// An argument that is wrong, in the library's own words.
pub(crate) fn wrong(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Checks a number of threads; 0 is one for each core.
pub(crate) fn check_threads(threads: usize) -> PyResult<()> {
    let most = Parallel::MOST_THREADS;
    match threads > most {
        true => Err(wrong(format!("threads = {threads}: must be from 0 to {most}"))),
        false => Ok(()),
    }
}
