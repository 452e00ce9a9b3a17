//! What Python hears where a library says no.

use std::error::Error;

use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::PyErr;

create_exception!(
    ogm_maps,
    MapError,
    PyValueError,
    "Input that cannot be meant: a file, an array, a pose, a parameter. The text says what to do."
);

/// The error and its causes in one line, as the command prints them.
pub(crate) fn map_error(error: impl Error) -> PyErr {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(deeper) = cause {
        text += &format!(": {deeper}");
        cause = deeper.source();
    }
    MapError::new_err(text)
}
