//! Maps that hang together, fused.

use numpy::PyArray2;
use ogm_core::{OccupancyGrid, Progress, Stage};
use ogm_merge::{Component as Members, FusionParams, FusionRule, MergeError, Merged, fuse};
use pyo3::prelude::{Bound, Py, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyBytes;

use crate::cells::mask;
use crate::error::MapError;
use crate::map::Map;
use crate::transform::{Transform, array};

/// Maps that hang together, in the frame of the first of them, as one map.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Component {
    members: Members,
    fused: FusedMap,
}

/// A merged map on its way to Python.
#[derive(Debug)]
struct FusedMap {
    map: Py<Map>,
    conflicts: Py<PyArray2<bool>>,
    compared: usize,
    conflict_count: usize,
}

impl Component {
    pub(crate) fn new(py: Python<'_>, members: Members, merged: Merged) -> PyResult<Self> {
        let fused = FusedMap {
            conflicts: mask(py, &merged.conflicts.to_grid())?.unbind(),
            map: Py::new(py, Map::from(merged.map))?,
            compared: merged.compared,
            conflict_count: merged.conflict_count,
        };
        Ok(Self { members, fused })
    }

    pub(crate) fn each(
        py: Python<'_>,
        components: Vec<Members>,
        merged: Vec<Merged>,
    ) -> PyResult<Vec<Py<Self>>> {
        let one = |(members, merged)| Py::new(py, Self::new(py, members, merged)?);
        components.into_iter().zip(merged).map(one).collect()
    }
}

/// How the cells of a component become one map.
#[derive(Debug, Clone)]
pub(crate) struct Fusion(FusionParams);

impl Fusion {
    /// By the rule that the command calls `rule`, into cells of `resolution` metres.
    pub(crate) fn new(rule: Option<&str>, resolution: Option<f64>) -> PyResult<Self> {
        let mut params = FusionParams { resolution, ..FusionParams::default() };
        if let Some(rule) = rule {
            params.fusion = rule_of(rule)?;
        }
        Ok(Self(params))
    }

    pub(crate) fn params(&self) -> &FusionParams {
        &self.0
    }

    pub(crate) fn of(
        &self,
        maps: &[&OccupancyGrid],
        members: &Members,
        progress: &dyn Progress,
    ) -> Result<Merged, MergeError> {
        fuse(maps, members, &self.0, progress)
    }

    pub(crate) fn of_each(
        &self,
        maps: &[&OccupancyGrid],
        components: &[Members],
        progress: &dyn Progress,
    ) -> Result<Vec<Merged>, MergeError> {
        let count = components.len();
        let one = |(index, members)| self.of(maps, members, &Stage::nth(progress, index, count));
        components.iter().enumerate().map(one).collect()
    }
}

fn rule_of(name: &str) -> PyResult<FusionRule> {
    Ok(match name {
        "keep-walls" => FusionRule::KeepWalls,
        "log-odds" => FusionRule::LogOdds,
        "max-confidence" => FusionRule::MaxConfidence,
        "occupied" => FusionRule::Occupied,
        "first" => FusionRule::First,
        "last" => FusionRule::Last,
        _ => {
            let text = format!(
                "no fusion is called {name:?}; there are keep-walls, log-odds, max-confidence, \
                 occupied, first, last"
            );
            return Err(MapError::new_err(text));
        }
    })
}

#[pymethods]
impl Component {
    /// Which of the maps, from 0; the first is the reference.
    #[getter]
    pub(crate) fn members(&self) -> Vec<usize> {
        self.members.members.iter().map(|member| member.map).collect()
    }

    /// For each member the transform that maps its points into the frame of the first.
    #[getter]
    fn poses(&self) -> Vec<Transform> {
        self.members.members.iter().map(|member| Transform(member.reference_from_map)).collect()
    }

    /// For each member the covariance of (x, y, theta) of its pose, m2, m rad, rad2; shape (3, 3),
    /// zero for the first, `None` where the method has none.
    #[getter]
    fn covariances<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Vec<Option<Bound<'py, PyArray2<f64>>>>> {
        let members = self.members.members.iter();
        members
            .map(|member| member.covariance.as_ref().map(|of| array(py, of)).transpose())
            .collect()
    }

    /// The fused map, in the frame of the first member.
    #[getter]
    pub(crate) fn map(&self, py: Python<'_>) -> Py<Map> {
        self.fused.map.clone_ref(py)
    }

    /// Cells of the fused map where one map says wall and another says free; an array of bool of
    /// its shape that nobody can write to.
    #[getter]
    pub(crate) fn conflicts(&self, py: Python<'_>) -> Py<PyArray2<bool>> {
        self.fused.conflicts.clone_ref(py)
    }

    /// Cells that two or more maps know.
    #[getter]
    fn compared_cells(&self) -> usize {
        self.fused.compared
    }

    /// How many of them are conflicts.
    #[getter]
    fn conflict_cells(&self) -> usize {
        self.fused.conflict_count
    }

    pub(crate) fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(self.fused.map.get().picture(py)?.png(py))
    }

    fn __len__(&self) -> usize {
        self.members.members.len()
    }

    fn __repr__(&self) -> String {
        format!("Component(members={:?})", self.members())
    }
}
