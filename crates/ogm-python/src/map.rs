//! A map: cells, and where they lie.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray2;
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid};
use ogm_io::{CellEncoding, WriteOptions};
use pyo3::prelude::{
    Bound, Py, PyAny, PyAnyMethods, PyResult, Python, pyclass, pyfunction, pymethods,
};
use pyo3::sync::PyOnceLock;
use pyo3::types::PyBytes;

use crate::cells;
use crate::error::map_error;
use crate::message::map_of;
use crate::picture::Picture;
use crate::transform::{Transform, pose};

/// An occupancy grid map; it never changes.
///
/// Row 0 of its cells is the lowest, as in a ROS message. `origin` is the pose of the lower-left
/// corner of cell (0, 0) in the frame of the map.
#[pyclass(frozen, eq, module = "ogm_maps")]
pub(crate) struct Map {
    pub(crate) grid: Arc<OccupancyGrid>,
    warnings: Vec<String>,
    array: PyOnceLock<Py<PyArray2<i8>>>,
}

impl PartialEq for Map {
    fn eq(&self, other: &Self) -> bool {
        self.grid == other.grid
    }
}

impl From<OccupancyGrid> for Map {
    fn from(grid: OccupancyGrid) -> Self {
        Self { grid: Arc::new(grid), warnings: Vec::new(), array: PyOnceLock::new() }
    }
}

/// Reads a ROS map: the YAML at `path` and the image that it names.
#[pyfunction]
pub(crate) fn load(py: Python<'_>, path: PathBuf) -> PyResult<Map> {
    let loaded = py.detach(|| ogm_io::read_map(&path)).map_err(map_error)?;
    let warnings = loaded.warnings.iter().map(ToString::to_string).collect();
    Ok(Map { warnings, ..Map::from(loaded.map) })
}

#[pymethods]
impl Map {
    /// The map of an array of integers of shape (height, width), row 0 the lowest: -1 unknown, 0
    /// free to 100 occupied.
    ///
    /// `resolution` is metres a cell; `origin` is the pose of the lower-left corner of cell (0, 0).
    #[staticmethod]
    #[pyo3(signature = (array, resolution, origin = None))]
    fn from_array(
        array: &Bound<'_, PyAny>,
        resolution: f64,
        origin: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let map_from_grid = origin.map_or_else(|| Ok(ogm_core::Se2::identity()), pose)?;
        let frame = GridFrame::new(resolution, map_from_grid).map_err(map_error)?;
        Ok(OccupancyGrid::new(frame, cells::from_array(array)?).into())
    }

    /// The map of a `nav_msgs/OccupancyGrid`, or of anything with its fields.
    #[staticmethod]
    fn from_occupancy_grid(message: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(map_of(message)?.into())
    }

    /// Writes the YAML at `path` and its image beside it.
    ///
    /// The image is a PGM of occupied, free and unknown, which every reader understands; with
    /// `probabilities` it is a PNG from which the same map is read, to the last bit. Existing files
    /// are replaced only with `overwrite`.
    #[pyo3(signature = (path, *, overwrite = false, probabilities = false))]
    fn save(
        &self,
        py: Python<'_>,
        path: PathBuf,
        overwrite: bool,
        probabilities: bool,
    ) -> PyResult<()> {
        let encoding =
            if probabilities { CellEncoding::Probabilities } else { CellEncoding::Classes };
        let options = WriteOptions { overwrite, encoding };
        py.detach(|| ogm_io::write_map(&path, &self.grid, &options)).map_err(map_error)
    }

    /// The cells as an array of int8 of shape (height, width), row 0 the lowest: -1 unknown, 0 free
    /// to 100 occupied. Made once; nobody can write to it.
    #[getter]
    fn array<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i8>>> {
        let array = self
            .array
            .get_or_try_init(py, || cells::to_array(py, self.grid.cells()).map(Bound::unbind))?;
        Ok(array.bind(py).clone())
    }

    /// Metres a cell.
    #[getter]
    fn resolution(&self) -> f64 {
        self.grid.frame().resolution()
    }

    /// The pose of the lower-left corner of cell (0, 0) in the frame of the map.
    #[getter]
    fn origin(&self) -> Transform {
        Transform(self.grid.frame().map_from_grid())
    }

    /// Cells along x.
    #[getter]
    fn width(&self) -> usize {
        self.grid.width()
    }

    /// Cells along y.
    #[getter]
    fn height(&self) -> usize {
        self.grid.height()
    }

    /// (height, width), the shape of `array`.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        (self.grid.height(), self.grid.width())
    }

    /// What is suspicious about the files that it was loaded from.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// The map in greys: free light, occupied dark.
    pub(crate) fn picture(&self, py: Python<'_>) -> PyResult<Picture> {
        py.detach(|| Picture::of_map(&self.grid))
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(self.picture(py)?.png(py))
    }

    /// Draws the map into `ax`, axes of Matplotlib (the current ones by default), in metres of its
    /// frame, and returns them.
    #[pyo3(signature = (ax = None))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        ax: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("ogm_maps._plot")?.call_method1("draw_map", (slf, ax))
    }

    #[pyo3(signature = (dtype = None, copy = None))]
    fn __array__<'py>(
        &self,
        py: Python<'py>,
        dtype: Option<Bound<'py, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let array = self.array(py)?.into_any();
        match (dtype, copy) {
            (Some(dtype), _) => array.call_method1("astype", (dtype,)),
            (None, Some(true)) => array.call_method0("copy"),
            (None, _) => Ok(array),
        }
    }

    fn __repr__(&self) -> String {
        let (width, height) = (self.grid.width(), self.grid.height());
        format!("Map({width} x {height} cells of {:?} m)", self.resolution())
    }

    #[expect(clippy::type_complexity, reason = "a constructor and its arguments")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>, usize, f64, Transform, Vec<String>))>
    {
        let map = slf.get();
        let bytes: Vec<u8> = map.grid.cells().cells().iter().map(|cell| cell.byte()).collect();
        let restore = slf.get_type().getattr("_restore")?;
        let cells = PyBytes::new(slf.py(), &bytes);
        let arguments = (cells, map.width(), map.resolution(), map.origin(), map.warnings());
        Ok((restore, arguments))
    }

    /// The map of a pickle.
    #[staticmethod]
    fn _restore(
        bytes: &[u8],
        width: usize,
        resolution: f64,
        origin: &Bound<'_, Transform>,
        warnings: Vec<String>,
    ) -> PyResult<Self> {
        let height = bytes.len().checked_div(width).unwrap_or(0);
        let cells = bytes.iter().copied().map(Occupancy::from_byte).collect();
        let cells = Grid::new(width, height, cells).map_err(map_error)?;
        let frame = GridFrame::new(resolution, origin.get().0).map_err(map_error)?;
        Ok(Self { warnings, ..OccupancyGrid::new(frame, cells).into() })
    }
}

/// The source laid on the target: walls of the target blue, of the source orange, of both black.
///
/// `transform` maps points of `source` into `target`.
#[pyfunction]
pub(crate) fn overlay(
    py: Python<'_>,
    target: &Bound<'_, Map>,
    source: &Bound<'_, Map>,
    transform: &Bound<'_, PyAny>,
) -> PyResult<Picture> {
    let target_from_source = pose(transform)?;
    let [target, source] = [target, source].map(|map| Arc::clone(&map.get().grid));
    py.detach(|| Picture::of_two(&target, &source, target_from_source))
}
