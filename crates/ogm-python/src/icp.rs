//! Local refinement of a start that is nearly right.

use std::sync::Arc;

use icp2d::{Alignment, IcpError, IcpParams, Metric, Termination, WallPoints, align};
use ogm_core::{ClassThresholds, Outcome, Refusal};
use pyo3::prelude::{Bound, PyAny, PyResult, Python, pyclass, pyfunction, pymethods};

use crate::background::Background;
use crate::error::MapError;
use crate::map::Map;
use crate::transform::{Transform, optional, pose};

/// Refines `start`, which maps points of `source` into `target`, on the walls of the two maps that
/// were seen from the same side (Tsardoulias, Thallas, Petrou, section 4.3).
///
/// The start must be good to about half a metre. `metric` is "point-to-point" or "point-to-line".
#[pyfunction]
#[pyo3(signature = (target, source, start, *, metric = None))]
pub(crate) fn icp(
    py: Python<'_>,
    target: &Bound<'_, Map>,
    source: &Bound<'_, Map>,
    start: &Bound<'_, PyAny>,
    metric: Option<&str>,
) -> PyResult<Refinement> {
    let metric = match metric {
        None => Metric::default(),
        Some("point-to-point") => Metric::PointToPoint,
        Some("point-to-line") => Metric::PointToLine,
        Some(metric) => {
            let text =
                format!("no metric is called {metric:?}; there are point-to-point, point-to-line");
            return Err(MapError::new_err(text));
        }
    };
    let start_target_from_source = pose(start)?;
    let params = IcpParams { metric, ..IcpParams::default() };
    let maps = [target, source].map(|map| Arc::clone(&map.get().grid));
    let outcome = Background::new(Some(1), None)?.run(py, |_progress| -> Result<_, IcpError> {
        let thresholds = ClassThresholds::default();
        let target = WallPoints::from_grid(&maps[0], &thresholds)?;
        let source = WallPoints::from_grid(&maps[1], &thresholds)?;
        align(&target, &source, start_target_from_source, &params)
    })?;
    Ok(match outcome {
        Outcome::Found(found) => Refinement { found: Some(found), refusal: None },
        Outcome::Refused(refusal) => Refinement { found: None, refusal: Some(refusal) },
    })
}

/// Where a refinement came to rest.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Refinement {
    found: Option<Alignment>,
    refusal: Option<Refusal>,
}

#[pymethods]
impl Refinement {
    /// Maps points of the source into the target; the start again where `termination` says that it
    /// was kept, `None` where nothing could be paired.
    #[getter]
    fn transform(&self) -> Option<Transform> {
        optional(self.found.as_ref().map(|found| &found.target_from_source))
    }

    /// Why there is none; `None` where there is.
    #[getter]
    fn reason(&self) -> Option<String> {
        self.refusal.as_ref().map(ToString::to_string)
    }

    /// "converged", "iteration-limit", or, with the start kept, "worse-fit" or "moved-too-far";
    /// `None` where nothing could be paired.
    #[getter]
    fn termination(&self) -> Option<&'static str> {
        self.found.map(|found| match found.termination {
            Termination::Converged => "converged",
            Termination::IterationLimit => "iteration-limit",
            Termination::WorseFit { .. } => "worse-fit",
            Termination::MovedTooFar { .. } => "moved-too-far",
            _ => "not-converged",
        })
    }

    /// Iterations done.
    #[getter]
    fn iterations(&self) -> usize {
        self.found.map_or(0, |found| found.iterations)
    }

    /// Wall points that were paired at the end.
    #[getter]
    fn correspondences(&self) -> usize {
        self.found.map_or(0, |found| found.correspondences)
    }

    /// Root mean square distance of the pairs, metres.
    #[getter]
    fn rmse(&self) -> Option<f64> {
        self.found.map(|found| found.rmse)
    }

    fn __bool__(&self) -> bool {
        self.found.is_some_and(|found| found.termination.is_converged())
    }

    fn __repr__(&self) -> String {
        match (&self.found, self.termination()) {
            (Some(found), Some(ended)) => {
                let pose = found.target_from_source;
                let (x, y, theta) = (pose.x(), pose.y(), pose.theta());
                format!("Refinement({ended}, x={x:.3}, y={y:.3}, theta={theta:.4})")
            }
            _ => format!("Refinement({})", self.reason().unwrap_or_default()),
        }
    }
}
