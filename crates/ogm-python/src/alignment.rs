//! The transform between two maps, or why there is none.

use std::sync::Arc;

use numpy::PyArray2;
use ogm_core::{OccupancyGrid, Se2};
use ogm_merge::{Hypothesis as Found, PairReport, RobotMap, Verdict, align_pair};
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python, pyclass, pyfunction, pymethods};
use pyo3::types::PyBytes;

use crate::background::Background;
use crate::error::{MapError, map_error};
use crate::map::Map;
use crate::picture::Picture;
use crate::search::Search;
use crate::tags::of_maps;
use crate::transform::{Transform, array, optional};

/// Finds the transform that maps points of `source` into the frame of `target`.
///
/// A pair that does not match is a value, not an exception: `bool(result)` says whether it does,
/// and `result.reason` why not.
#[pyfunction]
#[pyo3(signature = (
    target, source, *, method = "auto", tags = None, prior = None, prior_sigma = None,
    accept = None, repeats = false, seed = 0, threads = None, progress = None
))]
#[expect(clippy::too_many_arguments, reason = "keywords")]
pub(crate) fn align(
    py: Python<'_>,
    target: &Bound<'_, Map>,
    source: &Bound<'_, Map>,
    method: &str,
    tags: Option<&Bound<'_, PyAny>>,
    prior: Option<&Bound<'_, PyAny>>,
    prior_sigma: Option<(f64, f64)>,
    accept: Option<f64>,
    repeats: bool,
    seed: u64,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Alignment> {
    let search = Search::new(method, accept, repeats, seed)?.starting_at(prior, prior_sigma)?;
    let background = Background::new(threads, progress)?;
    let tags = of_maps(tags, 2)?;
    search.check_tags(&tags)?;
    let maps = [target, source].map(|map| Arc::clone(&map.get().grid));
    let report = background.run(py, |progress| {
        let robot = |map: usize| RobotMap { map: &maps[map], tags: &tags[map] };
        align_pair(search.method, &robot(0), &robot(1), &search.params, progress)
    })?;
    Ok(Alignment { report, maps })
}

/// What was found about two maps.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Alignment {
    report: PairReport,
    /// Target, source.
    maps: [Arc<OccupancyGrid>; 2],
}

impl Alignment {
    /// The answer about `maps`, target first.
    pub(crate) fn new(report: PairReport, maps: [Arc<OccupancyGrid>; 2]) -> Self {
        Self { report, maps }
    }
}

#[pymethods]
impl Alignment {
    /// Maps points of the source into the target; `None` unless it is believed. The best that was
    /// found, believed or not, is that of `hypotheses[0]`.
    #[getter]
    fn transform(&self) -> Option<Transform> {
        optional(self.report.outcome.clone().found().as_ref())
    }

    /// Probability that the best transform is right; `None` for a method without a calibrated one.
    #[getter]
    pub(crate) fn probability(&self) -> Option<f64> {
        self.report.probability()
    }

    /// Covariance of (x, y, theta) of the best transform in target axes, m2, m rad, rad2; shape
    /// (3, 3), or `None` for a method without one.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let best = self.report.hypotheses.first();
        best.and_then(|best| best.covariance.as_ref()).map(|best| array(py, best)).transpose()
    }

    /// The ways to lay the source on the target, best first, at most five.
    #[getter]
    fn hypotheses(&self) -> Vec<Hypothesis> {
        self.report.hypotheses.iter().cloned().map(Hypothesis).collect()
    }

    /// "merged", "ambiguous" or "no-match".
    #[getter]
    fn verdict(&self) -> &'static str {
        self.report.verdict().name()
    }

    /// Why no transform is believed, and what would help; `None` where one is.
    #[getter]
    pub(crate) fn reason(&self) -> Option<String> {
        self.report.outcome.refusal().map(ToString::to_string)
    }

    /// What makes the answer less sure than it looks.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.report.warnings.iter().map(ToString::to_string).collect()
    }

    /// The method that gave the answer.
    #[getter]
    fn method(&self) -> &'static str {
        self.report.method.name()
    }

    /// Seed of everything random.
    #[getter]
    fn seed(&self) -> u64 {
        self.report.seed
    }

    /// Known in both maps over known in the smaller one, under the best transform.
    #[getter]
    fn overlap(&self) -> Option<f64> {
        self.report.overlap
    }

    /// Share of the compared wall that fits, under the best transform.
    #[getter]
    fn agreement(&self) -> Option<f64> {
        self.report.agreement
    }

    /// All of it as the dictionary that `ogm align --json` prints, but for the files and the time.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let json = serde_json::to_string(&self.report).map_err(map_error)?;
        py.import("json")?.call_method1("loads", (json,))
    }

    /// The source laid on the target under the best transform, believed or not; `None` if none was
    /// found.
    fn picture(&self, py: Python<'_>) -> PyResult<Option<Picture>> {
        let [target, source] = &self.maps;
        let draw = |best| py.detach(|| Picture::of_two(target, source, best));
        self.report.target_from_source.map(draw).transpose()
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        Ok(self.picture(py)?.map(|picture| picture.png(py)))
    }

    fn __bool__(&self) -> bool {
        self.report.verdict() == Verdict::Merged
    }

    fn __repr__(&self) -> String {
        let probability =
            self.probability().map_or_else(String::new, |p| format!(", probability={p:.3}"));
        match self.transform() {
            Some(transform) => {
                let (x, y) = (transform.0.x(), transform.0.y());
                let theta = transform.0.theta();
                format!("Alignment(merged, x={x:.3}, y={y:.3}, theta={theta:.4}{probability})")
            }
            None => format!("Alignment({}{probability})", self.reason().unwrap_or_default()),
        }
    }
}

/// What a hypothesis is made of again: x, y, cosine and sine, probability, score, covariance, bend.
type Restored = ([f64; 4], Option<f64>, f64, Option<[[f64; 3]; 3]>, Option<f64>);

/// One way to lay the source on the target.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug, Clone)]
pub(crate) struct Hypothesis(pub(crate) Found);

#[pymethods]
impl Hypothesis {
    /// Maps points of the source into the target.
    #[getter]
    fn transform(&self) -> Transform {
        Transform(self.0.target_from_source)
    }

    /// Probability that it is right; `None` for a method without a calibrated one.
    #[getter]
    pub(crate) fn probability(&self) -> Option<f64> {
        self.0.probability
    }

    /// Log-odds, by what the maps say, that it is right against that no pose is.
    #[getter]
    fn score(&self) -> f64 {
        self.0.score
    }

    /// Covariance of (x, y, theta) in target axes, m2, m rad, rad2; shape (3, 3), or `None`.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        self.0.covariance.as_ref().map(|covariance| array(py, covariance)).transpose()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Restored)> {
        let found = &slf.get().0;
        let covariance = found.covariance.map(|rows| rows.into());
        let pose = found.target_from_source.parts();
        let restored = (pose, found.probability, found.score, covariance, found.bend_m);
        Ok((slf.get_type().getattr("_restore")?, restored))
    }

    /// The hypothesis of a pickle.
    #[staticmethod]
    fn _restore(
        pose: [f64; 4],
        probability: Option<f64>,
        score: f64,
        covariance: Option<[[f64; 3]; 3]>,
        bend_m: Option<f64>,
    ) -> PyResult<Self> {
        let target_from_source = Se2::from_parts(pose)
            .ok_or_else(|| MapError::new_err(format!("{pose:?} is no transform")))?;
        let covariance = covariance.map(Into::into);
        Ok(Self(Found { target_from_source, probability, score, covariance, bend_m }))
    }

    fn __repr__(&self) -> String {
        let pose = self.0.target_from_source;
        let (x, y, theta) = (pose.x(), pose.y(), pose.theta());
        format!("Hypothesis(x={x:.3}, y={y:.3}, theta={theta:.4}, score={:.2})", self.0.score)
    }
}
