//! Pictures for notebooks and files.

use std::path::PathBuf;

use ogm_core::{OccupancyGrid, Se2};
use pyo3::prelude::{PyResult, Python, pyclass, pymethods};
use pyo3::types::PyBytes;
use pyo3::{Bound, PyErr};

use crate::error::map_error;

/// A picture as a PNG; a notebook shows it.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Picture {
    png: Vec<u8>,
    /// Pixels from left to right.
    #[pyo3(get)]
    width: u32,
    /// Pixels from top to bottom.
    #[pyo3(get)]
    height: u32,
}

impl Picture {
    /// The map in greys, without the margins that nobody has seen.
    pub(crate) fn of_map(map: &OccupancyGrid) -> PyResult<Self> {
        let known = ogm_view::crop_known(map).map_err(map_error)?;
        let image = ogm_view::occupancy(&known);
        let png = ogm_view::png(&image).map_err(map_error)?;
        Ok(Self { png, width: image.width(), height: image.height() })
    }

    /// The source laid on the target.
    pub(crate) fn of_two(
        target: &OccupancyGrid,
        source: &OccupancyGrid,
        target_from_source: Se2,
    ) -> PyResult<Self> {
        let image = ogm_view::overlay(target, source, target_from_source).map_err(map_error)?;
        let png = ogm_view::png(&image).map_err(map_error)?;
        Ok(Self { png, width: image.width(), height: image.height() })
    }
}

#[pymethods]
impl Picture {
    /// Writes the PNG; an existing file is replaced only with `overwrite`.
    #[pyo3(signature = (path, *, overwrite = false))]
    fn save(&self, py: Python<'_>, path: PathBuf, overwrite: bool) -> Result<(), PyErr> {
        py.detach(|| ogm_io::write_file(&path, &self.png, overwrite)).map_err(map_error)
    }

    /// The bytes of the PNG file.
    #[getter]
    pub(crate) fn png<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.png)
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        self.png(py)
    }

    fn __repr__(&self) -> String {
        format!("Picture({} x {} pixels)", self.width, self.height)
    }
}
