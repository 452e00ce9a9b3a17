//! Maps into one map: by a search, or in poses that are known.

use std::sync::Arc;

use numpy::PyArray2;
use ogm_core::{OccupancyGrid, Stage};
use ogm_merge::{Component as Members, Member, RobotMap, align_pair};
use pyo3::prelude::{Bound, Py, PyAny, PyResult, Python, pyclass, pyfunction, pymethods};
use pyo3::types::PyBytes;

use crate::align::Alignment;
use crate::background::Background;
use crate::component::{Component, Fusion};
use crate::error::MapError;
use crate::map::Map;
use crate::search::Search;
use crate::tags::of_maps;
use crate::transform::{Transform, optional, pose};

/// Share of a merge that its search takes; the rest is the fusion.
const SEARCH: f64 = 0.8;

/// Finds how two maps lie to each other and makes one map of them.
///
/// Maps that do not hang together are a value, not an exception: `bool(result)` says whether they
/// do, `result.reason` why not, and `result.components` has each alone.
#[pyfunction]
#[pyo3(signature = (
    maps, *, method = "auto", tags = None, prior = None, prior_sigma = None, accept = None,
    repeats = false, seed = 0, fusion = None, resolution = None, threads = None, progress = None
))]
#[expect(clippy::too_many_arguments, reason = "keywords")]
pub(crate) fn merge(
    py: Python<'_>,
    maps: Vec<Bound<'_, Map>>,
    method: &str,
    tags: Option<&Bound<'_, PyAny>>,
    prior: Option<&Bound<'_, PyAny>>,
    prior_sigma: Option<(f64, f64)>,
    accept: Option<f64>,
    repeats: bool,
    seed: u64,
    fusion: Option<&str>,
    resolution: Option<f64>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Merge> {
    let search = Search::new(method, accept, repeats, seed)?.starting_at(prior, prior_sigma)?;
    let fusion = Fusion::new(fusion, resolution)?;
    let background = Background::new(threads, progress)?;
    let [target, source] = &grids_of(&maps)[..] else {
        let count = maps.len();
        let text = format!("merge takes two maps for now, not {count}; align pairs, then fuse");
        return Err(MapError::new_err(text));
    };
    let tags = of_maps(tags, 2)?;
    search.check_tags(&tags)?;
    let (report, parts) = background.run(py, |progress| {
        let [target, source] =
            [(target, 0), (source, 1)].map(|(map, index)| RobotMap { map, tags: &tags[index] });
        let part = Stage::new(progress, 0.0, SEARCH);
        let report = align_pair(search.method, &target, &source, &search.params, &part)?;
        let found = report.components();
        let mut parts = Vec::with_capacity(found.len());
        for (index, members) in found.iter().enumerate() {
            let part = Stage::new(progress, SEARCH, 1.0);
            let part = Stage::nth(&part, index, found.len());
            parts.push(fusion.of(&[target.map, source.map], members, &part)?);
        }
        Ok::<_, ogm_merge::MergeError>((report, found.into_iter().zip(parts).collect::<Vec<_>>()))
    })?;
    let components = parts
        .into_iter()
        .map(|(members, merged)| Py::new(py, Component::new(py, members, merged)?))
        .collect::<PyResult<_>>()?;
    let transform = optional(report.outcome.clone().found().as_ref());
    let alignment = Alignment::new(report, [Arc::clone(target), Arc::clone(source)]);
    let pair = Pair { target: 0, source: 1, alignment: Py::new(py, alignment)?, transform };
    Ok(Merge { components, pairs: vec![Py::new(py, pair)?] })
}

/// Makes one map of maps whose poses are known: nothing is searched and nothing is doubted.
///
/// `poses` has for each map the transform that maps its points into the frame of the result.
#[pyfunction]
#[pyo3(signature = (
    maps, poses, *, fusion = None, resolution = None, threads = None, progress = None
))]
#[expect(clippy::too_many_arguments, reason = "keywords")]
pub(crate) fn fuse(
    py: Python<'_>,
    maps: Vec<Bound<'_, Map>>,
    poses: Vec<Bound<'_, PyAny>>,
    fusion: Option<&str>,
    resolution: Option<f64>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Component> {
    let fusion = Fusion::new(fusion, resolution)?;
    let background = Background::new(threads, progress)?;
    if maps.len() != poses.len() {
        let (maps, poses) = (maps.len(), poses.len());
        return Err(MapError::new_err(format!("one pose for each of {maps} maps, not {poses}")));
    }
    let place = |(map, given): (usize, &Bound<'_, PyAny>)| {
        Ok(Member { map, reference_from_map: pose(given)?, covariance: None })
    };
    let members = poses.iter().enumerate().map(place).collect::<PyResult<_>>()?;
    let members = Members { members };
    let grids = grids_of(&maps);
    let merged = background.run(py, |progress| {
        let maps: Vec<&OccupancyGrid> = grids.iter().map(AsRef::as_ref).collect();
        fusion.of(&maps, &members, progress)
    })?;
    Component::new(py, members, merged)
}

fn grids_of(maps: &[Bound<'_, Map>]) -> Vec<Arc<OccupancyGrid>> {
    maps.iter().map(|map| Arc::clone(&map.get().grid)).collect()
}

/// What was found about maps, and what was made of them.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Merge {
    components: Vec<Py<Component>>,
    pairs: Vec<Py<Pair>>,
}

/// Two of the maps that were merged.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Pair {
    /// Which map is the target, from 0.
    #[pyo3(get)]
    target: usize,
    /// Which map is the source.
    #[pyo3(get)]
    source: usize,
    /// What the two maps say by themselves.
    #[pyo3(get)]
    alignment: Py<Alignment>,
    /// Where the merge puts the source in the target; `None` if they do not hang together.
    #[pyo3(get)]
    transform: Option<Transform>,
}

#[pymethods]
impl Pair {
    fn __repr__(&self) -> String {
        let (target, source) = (self.target, self.source);
        let together = if self.transform.is_some() { "together" } else { "apart" };
        format!("Pair({target}, {source}, {together})")
    }
}

impl Merge {
    /// The component of all maps, if they hang together.
    fn whole(&self) -> Option<&Component> {
        let [whole] = &self.components[..] else { return None };
        Some(whole.get())
    }
}

#[pymethods]
impl Merge {
    /// Maps that hang together, that of the first map first; a map that could not be placed is
    /// alone.
    #[getter]
    fn components(&self, py: Python<'_>) -> Vec<Py<Component>> {
        self.components.iter().map(|component| component.clone_ref(py)).collect()
    }

    /// The pairs that were searched.
    #[getter]
    fn pairs(&self, py: Python<'_>) -> Vec<Py<Pair>> {
        self.pairs.iter().map(|pair| pair.clone_ref(py)).collect()
    }

    /// All maps as one; `None` unless they hang together.
    #[getter]
    fn map(&self, py: Python<'_>) -> Option<Py<Map>> {
        self.whole().map(|whole| whole.map(py))
    }

    /// Cells of `map` where one map says wall and another says free; `None` without it.
    #[getter]
    fn conflicts(&self, py: Python<'_>) -> Option<Py<PyArray2<bool>>> {
        self.whole().map(|whole| whole.conflicts(py))
    }

    /// Why not all maps hang together; `None` where they do.
    #[getter]
    fn reason(&self) -> Option<String> {
        self.pairs
            .iter()
            .find_map(|pair| pair.get().alignment.get().reason())
            .filter(|_| self.whole().is_none())
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        self.whole().map(|whole| whole._repr_png_(py)).transpose()
    }

    fn __bool__(&self) -> bool {
        self.whole().is_some()
    }

    fn __repr__(&self) -> String {
        let members = self.components.iter().map(|component| component.get().members());
        format!("Merge(components={:?})", members.collect::<Vec<_>>())
    }
}
