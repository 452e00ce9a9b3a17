//! Rigid transforms of the plane, and what is taken for one.

use nalgebra::{Matrix3, Point2};
use numpy::{PyArray1, PyArray2};
use ogm_core::Se2;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Bound, Py, PyAny, PyAnyMethods, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyTuple;

use crate::error::{MapError, map_error};
use crate::numbers::numbers;

/// A rigid transform of the plane: turns by `theta`, then moves by (`x`, `y`).
///
/// `a_from_b @ points` maps points of frame b, an array of shape (2,) or (n, 2) in metres, into
/// frame a; `a_from_b @ b_from_c` is `a_from_c`. NumPy takes it for its 3 x 3 matrix.
#[pyclass(frozen, eq, module = "ogm_maps")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Transform(pub(crate) Se2);

#[pymethods]
impl Transform {
    #[new]
    #[pyo3(signature = (x = 0.0, y = 0.0, theta = 0.0))]
    fn new(x: f64, y: f64, theta: f64) -> PyResult<Self> {
        let a_from_b = Se2::new(x, y, theta);
        if !(x.is_finite() && y.is_finite() && theta.is_finite()) {
            let text = format!("a transform must be finite, got ({x}, {y}, {theta})");
            return Err(MapError::new_err(text));
        }
        Ok(Self(a_from_b))
    }

    /// The transform of a 3 x 3 matrix of a turn and a move.
    #[staticmethod]
    fn from_matrix(matrix: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(from_rows(rows_of(matrix)?)?))
    }

    /// Along x, metres.
    #[getter]
    fn x(&self) -> f64 {
        self.0.x() + 0.0
    }

    /// Along y, metres.
    #[getter]
    fn y(&self) -> f64 {
        self.0.y() + 0.0
    }

    /// Counter-clockwise, radians in [-pi, pi).
    #[getter]
    fn theta(&self) -> f64 {
        self.0.theta() + 0.0
    }

    /// The homogeneous 3 x 3 matrix.
    #[getter]
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (sin, cos) = self.0.theta().sin_cos();
        let (x, y) = (self.x(), self.y());
        array(py, &Matrix3::new(cos, -sin, x, sin, cos, y, 0.0, 0.0, 1.0))
    }

    /// The transform the other way round.
    fn inverse(&self) -> Self {
        Self(self.0.inverse())
    }

    fn __matmul__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        let py = other.py();
        if let Ok(other) = other.cast::<Self>() {
            return Self(self.0 * other.get().0).into_py_any(py);
        }
        let (shape, numbers) = numbers(other)?;
        if !matches!(shape[..], [2] | [_, 2]) {
            let text = format!("points are an array of shape (2,) or (n, 2), not {shape:?}");
            return Err(MapError::new_err(text));
        }
        let moved = numbers.as_chunks::<2>().0.iter().flat_map(|[x, y]| {
            let moved = self.0 * Point2::new(*x, *y);
            [moved.x, moved.y]
        });
        let moved = PyArray1::from_iter(py, moved);
        moved.call_method1("reshape", (PyTuple::new(py, shape)?,))?.into_py_any(py)
    }

    #[pyo3(signature = (dtype = None, copy = None))]
    fn __array__<'py>(
        &self,
        py: Python<'py>,
        dtype: Option<Bound<'py, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if copy == Some(false) {
            return Err(pyo3::exceptions::PyValueError::new_err("a matrix is always a copy"));
        }
        let matrix = self.matrix(py)?.into_any();
        match dtype {
            Some(dtype) => matrix.call_method1("astype", (dtype,)),
            None => Ok(matrix),
        }
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        (self.x(), self.y(), self.theta()).into_bound_py_any(py)?.call_method0("__iter__")
    }

    fn __repr__(&self) -> String {
        format!("Transform(x={:?}, y={:?}, theta={:?})", self.x(), self.y(), self.theta())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, ([f64; 4],))> {
        Ok((slf.get_type().getattr("_restore")?, (slf.get().0.parts(),)))
    }

    /// The transform of a pickle, to the last bit.
    #[staticmethod]
    fn _restore(parts: [f64; 4]) -> PyResult<Self> {
        let restored = Se2::from_parts(parts);
        restored.map(Self).ok_or_else(|| MapError::new_err(format!("{parts:?} is no transform")))
    }
}

/// What a caller may write for a pose: a [`Transform`], (x, y, theta), or a 3 x 3 matrix.
pub(crate) fn pose(given: &Bound<'_, PyAny>) -> PyResult<Se2> {
    if let Ok(transform) = given.cast::<Transform>() {
        return Ok(transform.get().0);
    }
    let listed = as_list(given)?;
    if let Ok([x, y, theta]) = listed.extract::<[f64; 3]>() {
        return Ok(Transform::new(x, y, theta)?.0);
    }
    from_rows(rows_of(&listed)?)
}

/// NumPy's arrays are no sequences, but make lists of themselves.
fn as_list<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    if given.hasattr("tolist")? { given.call_method0("tolist") } else { Ok(given.clone()) }
}

fn rows_of(given: &Bound<'_, PyAny>) -> PyResult<[[f64; 3]; 3]> {
    as_list(given)?.extract().map_err(|_cause| {
        PyTypeError::new_err(
            "a pose is an ogm_maps.Transform, (x, y, theta) in metres and radians, or a 3 x 3 matrix",
        )
    })
}

fn from_rows([[a, b, x], [c, d, y], last]: [[f64; 3]; 3]) -> PyResult<Se2> {
    let near = |value: f64, wanted: f64| (value - wanted).abs() <= 1e-6;
    let turns = near(a, d) && near(b, -c) && near(a.hypot(c), 1.0);
    if !(turns && last == [0.0, 0.0, 1.0]) {
        let text = "the matrix is no turn and move: its last row must be 0 0 1, and the 2 x 2 \
                    at its upper left a rotation, without scale or mirror";
        return Err(MapError::new_err(text));
    }
    let a_from_b = Se2::new(x, y, c.atan2(a));
    a_from_b.check_finite().map_err(map_error)?;
    Ok(a_from_b)
}

/// A matrix as an array of shape (3, 3).
pub(crate) fn array<'py>(
    py: Python<'py>,
    matrix: &Matrix3<f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows: Vec<Vec<f64>> = matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
    PyArray2::from_vec2(py, &rows).map_err(map_error)
}

/// A pose that may be missing.
pub(crate) fn optional(a_from_b: Option<&Se2>) -> Option<Transform> {
    a_from_b.map(|a_from_b| Transform(*a_from_b))
}
