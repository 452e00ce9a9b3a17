//! The random walk of Carpin and Birk.

use std::sync::Arc;

use numpy::PyArray1;
use ogm_core::Outcome;
use ogm_merge::{CarpinParams, CarpinReport, align_carpin};
use pyo3::prelude::{Bound, PyAny, PyResult, Python, pyclass, pyfunction, pymethods};

use crate::background::Background;
use crate::map::Map;
use crate::transform::{Transform, optional, pose};

/// Walks at random from `start`, which maps points of `source` into `target`, to where the maps
/// look most alike (Carpin and Birk, Stochastic map merging in rescue environments).
///
/// A walk always ends somewhere: a small `psi` is no proof of a match. `samples` is those of a
/// walk, `walks` how many start there, of which the best counts.
#[pyfunction]
#[pyo3(signature = (
    target, source, start, *, samples = None, walks = None, seed = 0, threads = None,
    progress = None
))]
#[expect(clippy::too_many_arguments, reason = "keywords")]
pub(crate) fn random_walk(
    py: Python<'_>,
    target: &Bound<'_, Map>,
    source: &Bound<'_, Map>,
    start: &Bound<'_, PyAny>,
    samples: Option<usize>,
    walks: Option<usize>,
    seed: u64,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Walk> {
    let start_target_from_source = pose(start)?;
    let mut params = CarpinParams::default();
    params.search.seed = seed;
    params.search.samples = samples.unwrap_or(params.search.samples);
    params.search.walks = walks.unwrap_or(params.search.walks);
    let [target, source] = [target, source].map(|map| Arc::clone(&map.get().grid));
    let report = Background::new(threads, progress)?.run(py, |progress| {
        align_carpin(&target, &source, start_target_from_source, &params, progress)
    })?;
    Ok(Walk(report))
}

/// Where a random walk ended.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Walk(CarpinReport);

impl Walk {
    fn found<T>(&self, of: impl Fn(&carpin_walk::Alignment) -> T) -> Option<T> {
        match &self.0.outcome {
            Outcome::Found(found) => Some(of(found)),
            Outcome::Refused(_) => None,
        }
    }
}

#[pymethods]
impl Walk {
    /// Maps points of the source into the target, where psi was least; `None` if the maps could
    /// nowhere be compared.
    #[getter]
    fn transform(&self) -> Option<Transform> {
        optional(self.found(|found| found.target_from_source).as_ref())
    }

    /// Why there is none; `None` where there is.
    #[getter]
    fn reason(&self) -> Option<String> {
        self.0.outcome.refusal().map(ToString::to_string)
    }

    /// Picture distance at the end, cells.
    #[getter]
    fn psi(&self) -> Option<f64> {
        self.found(|found| found.psi)
    }

    /// Picture distance at the start, cells.
    #[getter]
    fn start_psi(&self) -> Option<f64> {
        self.found(|found| found.start_psi)
    }

    /// Least psi up to each sample of the walk.
    #[getter]
    fn trace<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let least = |found: &carpin_walk::Alignment| {
            found.trace.iter().map(|sample| sample.best_psi).collect()
        };
        PyArray1::from_vec(py, self.found(least).unwrap_or_default())
    }

    /// Metres a cell of the maps as they were compared.
    #[getter]
    fn resolution(&self) -> f64 {
        self.0.resolution
    }

    fn __bool__(&self) -> bool {
        self.found(|_| ()).is_some()
    }

    fn __repr__(&self) -> String {
        match (self.transform(), self.psi()) {
            (Some(transform), Some(psi)) => {
                let pose = transform.0;
                let (x, y, theta) = (pose.x(), pose.y(), pose.theta());
                format!("Walk(x={x:.3}, y={y:.3}, theta={theta:.4}, psi={psi:.3})")
            }
            _ => format!("Walk({})", self.reason().unwrap_or_default()),
        }
    }
}
