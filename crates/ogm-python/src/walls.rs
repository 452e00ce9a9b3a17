//! Straight walls of a map.

use std::sync::Arc;

use line_ransac::{Params, extract_segments};
use ogm_core::{Outcome, Refusal, Segment as Found};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{
    Bound, Py, PyAny, PyAnyMethods, PyResult, Python, pyclass, pyfunction, pymethods,
};

use crate::map::Map;

/// The straight walls of a map (Tsardoulias, Thallas, Petrou, section 4.1.1).
///
/// A map without any is a value, not an exception: `bool(walls)` says whether there are some, and
/// `walls.reason` why not.
#[pyfunction]
#[pyo3(signature = (map, *, seed = 0))]
pub(crate) fn wall_segments(py: Python<'_>, map: &Bound<'_, Map>, seed: u64) -> Walls {
    let grid = Arc::clone(&map.get().grid);
    let params = Params { seed, ..Params::default() };
    match py.detach(|| extract_segments(&grid, &params)) {
        Outcome::Found(found) => {
            Walls { segments: found.segments.into_iter().map(Segment).collect(), refusal: None }
        }
        Outcome::Refused(refusal) => Walls { segments: Vec::new(), refusal: Some(refusal) },
    }
}

/// The straight walls of a map.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Walls {
    segments: Vec<Segment>,
    refusal: Option<Refusal>,
}

#[pymethods]
impl Walls {
    /// The walls.
    #[getter]
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    /// Why there are none; `None` where there are.
    #[getter]
    fn reason(&self) -> Option<String> {
        self.refusal.as_ref().map(ToString::to_string)
    }

    fn __len__(&self) -> usize {
        self.segments.len()
    }

    fn __iter__(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(self.segments().into_bound_py_any(py)?.call_method0("__iter__")?.unbind())
    }

    fn __repr__(&self) -> String {
        match self.reason() {
            None => format!("Walls({} segments)", self.segments.len()),
            Some(reason) => format!("Walls({reason})"),
        }
    }
}

/// A straight piece of wall in the frame of its map.
#[pyclass(frozen, eq, module = "ogm_maps")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Segment(Found);

#[pymethods]
impl Segment {
    /// One end (x, y), metres.
    #[getter]
    fn start(&self) -> (f64, f64) {
        (self.0.start.x, self.0.start.y)
    }

    /// The other end (x, y), metres.
    #[getter]
    fn end(&self) -> (f64, f64) {
        (self.0.end.x, self.0.end.y)
    }

    /// Direction in [-pi/2, pi/2), radians.
    #[getter]
    fn direction(&self) -> f64 {
        self.0.direction
    }

    /// Distance between the ends, metres.
    #[getter]
    fn length(&self) -> f64 {
        self.0.length()
    }

    /// Mean occupancy under it: 1 is a wall without a gap.
    #[getter]
    fn reliability(&self) -> f64 {
        self.0.reliability
    }

    /// Occupied cells that support it.
    #[getter]
    fn support(&self) -> usize {
        self.0.support
    }

    fn __repr__(&self) -> String {
        let (length, direction) = (self.length(), self.direction());
        format!("Segment(length={length:.3}, direction={direction:.4})")
    }
}
