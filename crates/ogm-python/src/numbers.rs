//! Arrays of numbers as callers write them.

use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult};

/// The real numbers of `given` as an array: its shape, and its values in logical order.
pub(crate) fn numbers(given: &Bound<'_, PyAny>) -> PyResult<(Vec<usize>, Vec<f64>)> {
    let numpy = given.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (given,))?;
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    if !matches!(&*kind, "i" | "u" | "f") {
        return Err(PyTypeError::new_err(format!("these are numbers, not {dtype}")));
    }
    let array = array.call_method1("astype", ("float64",))?;
    let array: PyReadonlyArrayDyn<'_, f64> = array.extract()?;
    Ok((array.shape().to_vec(), array.as_array().iter().copied().collect()))
}
