//! A map made ready for many matches.

use std::sync::Arc;

use ogm_core::OccupancyGrid;
use ogm_merge::{
    MapSignature as Signature, MatchParams, PreparedMap as Ready, View, align_prepared,
    candidate_pairs as alike,
};
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python, pyclass, pyfunction, pymethods};

use crate::alignment::Alignment;
use crate::background::Background;
use crate::map::Map;
use crate::search::Search;

/// A map made ready to be matched with many others.
#[pyclass(frozen, module = "ogm_maps")]
pub(crate) struct PreparedMap {
    grid: Arc<OccupancyGrid>,
    ready: Ready,
}

#[pymethods]
impl PreparedMap {
    #[new]
    #[pyo3(signature = (map, *, threads = None))]
    fn new(py: Python<'_>, map: &Bound<'_, Map>, threads: Option<usize>) -> PyResult<Self> {
        let grid = Arc::clone(&map.get().grid);
        let thresholds = MatchParams::default().thresholds;
        let background = Background::new(threads, None)?;
        let ready = background.run(py, |progress| Ready::new(&grid, &thresholds, progress))?;
        Ok(Self { grid, ready })
    }

    /// What `align` finds by the maps alone, this one being the target.
    #[pyo3(signature = (
        source, *, accept = None, repeats = false, seed = 0, threads = None, progress = None
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn align(
        &self,
        py: Python<'_>,
        source: &Bound<'_, Self>,
        accept: Option<f64>,
        repeats: bool,
        seed: u64,
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Alignment> {
        let search = Search::new("match", accept, repeats, seed)?;
        let background = Background::new(threads, progress)?;
        let source = source.get();
        let report = background.run(py, |progress| {
            align_prepared(&self.ready, &source.ready, &search.params, progress)
        })?;
        Ok(Alignment::new(report, [&self.grid, &source.grid].map(Arc::clone)))
    }

    /// What the map looks like from inside, for `candidate_pairs`.
    fn signature(&self, py: Python<'_>) -> MapSignature {
        MapSignature(py.detach(|| self.ready.signature()))
    }

    /// Metres of wall that the matcher sees.
    #[getter]
    fn wall_length(&self) -> f64 {
        self.ready.wall_length()
    }

    fn __repr__(&self) -> String {
        format!("PreparedMap({:.1} m of wall)", self.ready.wall_length())
    }
}

/// What a map looks like from inside, whatever its heading.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug, Clone)]
pub(crate) struct MapSignature(Signature);

#[pymethods]
impl MapSignature {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Vec<View>,))> {
        Ok((slf.get_type().getattr("_restore")?, (slf.get().0.views().to_vec(),)))
    }

    /// The signature of a pickle.
    #[staticmethod]
    fn _restore(views: Vec<View>) -> Self {
        Self(Signature::from_views(views))
    }

    fn __len__(&self) -> usize {
        self.0.views().len()
    }

    fn __repr__(&self) -> String {
        format!("MapSignature({} places)", self.0.views().len())
    }
}

/// Pairs of maps that look alike from inside, `partners` for each map or more: places among
/// `signatures`, ascending.
#[pyfunction]
pub(crate) fn candidate_pairs(
    py: Python<'_>,
    signatures: Vec<Bound<'_, MapSignature>>,
    partners: usize,
) -> Vec<(usize, usize)> {
    let signatures: Vec<Signature> =
        signatures.iter().map(|signature| signature.get().0.clone()).collect();
    py.detach(|| alike(&signatures, partners))
}
