//! A team whose maps grow.

use std::sync::{Mutex, MutexGuard, PoisonError};

use numpy::PyArray2;
use ogm_merge::{
    Because, Change as Found, ChangeKind, MergeError, MergeSession, RobotPrior, RobotState,
    SessionParams,
};
use pyo3::prelude::{Bound, PyAny, PyResult, Python, pyclass, pymethods};

use crate::background::Background;
use crate::component::Fusion;
use crate::error::{MapError, map_error};
use crate::map::Map;
use crate::search::Search;
use crate::transform::{Transform, array, optional, pose as pose_of};

/// The maps of a running team, and what is known about where they lie in one world.
///
/// The world is the frame of the first robot's map, or that in which its pose was given, and never
/// moves. What stands is kept unless walls contradict it or another answer is better by evidence.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Session {
    session: Mutex<MergeSession>,
}

impl Session {
    fn held(&self) -> MutexGuard<'_, MergeSession> {
        // A session is in order after every call, also after one that ended in a panic.
        self.session.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(
        &self,
        py: Python<'_>,
        background: &Background,
        work: impl FnOnce(&mut MergeSession, &dyn ogm_core::Progress) -> Result<Vec<Found>, MergeError>
        + Send,
    ) -> PyResult<Vec<Change>> {
        let found = background.run(py, |progress| work(&mut self.held(), progress))?;
        Ok(found.into_iter().map(Change).collect())
    }
}

#[pymethods]
impl Session {
    #[new]
    #[pyo3(signature = (*, accept = None, repeats = false, seed = 0))]
    fn new(accept: Option<f64>, repeats: bool, seed: u64) -> PyResult<Self> {
        let align = Search::new("auto", accept, repeats, seed)?.params;
        let session = MergeSession::new(SessionParams { align, ..SessionParams::default() });
        Ok(Self { session: Mutex::new(session.map_err(map_error)?) })
    }

    /// Takes the map that `robot` has by now and says what this changes.
    #[pyo3(signature = (robot, map, *, threads = None, progress = None))]
    fn update(
        &self,
        py: Python<'_>,
        robot: &str,
        map: &Bound<'_, Map>,
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Vec<Change>> {
        let grid = std::sync::Arc::clone(&map.get().grid);
        let background = Background::new(threads, progress)?;
        self.change(py, &background, |session, progress| session.update(robot, &grid, progress))
    }

    /// Takes in where the map of `robot` lies in the world, with standard deviations `sigma` in
    /// metres and radians; without them it is pinned there.
    #[pyo3(signature = (robot, pose, sigma = None, *, threads = None, progress = None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn set_pose(
        &self,
        py: Python<'_>,
        robot: &str,
        pose: &Bound<'_, PyAny>,
        sigma: Option<(f64, f64)>,
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Vec<Change>> {
        let (sigma_m, sigma_rad) = sigma.unwrap_or_default();
        let prior = RobotPrior { world_from_map: pose_of(pose)?, sigma_m, sigma_rad };
        let background = Background::new(threads, progress)?;
        self.change(py, &background, |session, progress| session.set_prior(robot, prior, progress))
    }

    /// Takes the map of `robot` out of what it hangs together with, and keeps it out.
    fn separate(&self, py: Python<'_>, robot: &str) -> PyResult<Vec<Change>> {
        let background = Background::new(None, None)?;
        self.change(py, &background, |session, progress| session.separate(robot, progress))
    }

    /// Forgets what `set_pose` and `separate` said about `robot`.
    fn release(&self, py: Python<'_>, robot: &str) -> PyResult<Vec<Change>> {
        let background = Background::new(None, None)?;
        self.change(py, &background, |session, progress| session.release(robot, progress))
    }

    /// Forgets `robot`; whether there was one.
    fn remove(&self, robot: &str) -> bool {
        self.held().remove(robot)
    }

    /// Forgets what stands and asks what `merge` would.
    #[pyo3(signature = (*, threads = None, progress = None))]
    fn reconsider(
        &self,
        py: Python<'_>,
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Vec<Change>> {
        let background = Background::new(threads, progress)?;
        self.change(py, &background, MergeSession::reconsider)
    }

    /// The robots, in the order in which they came.
    #[getter]
    fn robots(&self) -> Vec<Robot> {
        self.held().robots().into_iter().map(Robot).collect()
    }

    /// All maps that have a place in the world as one, in its frame; `None` without maps.
    #[pyo3(signature = (*, fusion = None, resolution = None, threads = None, progress = None))]
    fn map(
        &self,
        py: Python<'_>,
        fusion: Option<&str>,
        resolution: Option<f64>,
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Option<Map>> {
        let fusion = Fusion::new(fusion, resolution)?;
        let background = Background::new(threads, progress)?;
        let merged = background.run(py, |progress| self.held().fuse(fusion.params(), progress))?;
        Ok(merged.map(|merged| merged.map.into()))
    }

    /// All that the session knows, as text, to go on with by `resume`.
    fn save(&self) -> PyResult<String> {
        serde_json::to_string(&self.held().save()).map_err(map_error)
    }

    /// Goes on where a session was saved.
    #[staticmethod]
    #[pyo3(signature = (saved, *, accept = None, repeats = false, seed = 0))]
    fn resume(
        py: Python<'_>,
        saved: &str,
        accept: Option<f64>,
        repeats: bool,
        seed: u64,
    ) -> PyResult<Self> {
        let align = Search::new("auto", accept, repeats, seed)?.params;
        let params = SessionParams { align, ..SessionParams::default() };
        let saved = serde_json::from_str(saved)
            .map_err(|error| MapError::new_err(format!("this is no saved session: {error}")))?;
        let background = Background::new(None, None)?;
        let session =
            background.run(py, |progress| MergeSession::resume(saved, params, progress))?;
        Ok(Self { session: Mutex::new(session) })
    }

    fn __repr__(&self) -> String {
        let robots = self.held().robots();
        let placed = robots.iter().filter(|robot| robot.placement.is_some()).count();
        format!("Session({placed} of {} robots placed)", robots.len())
    }
}

/// Where a robot's map stands in a session.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Robot(RobotState);

#[pymethods]
impl Robot {
    /// The robot.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Maps points of its map into the world; `None` as long as nobody is sure enough.
    #[getter]
    fn transform(&self) -> Option<Transform> {
        optional(self.0.placement.as_ref().map(|placement| &placement.world_from_map))
    }

    /// Probability that it lies there.
    #[getter]
    fn probability(&self) -> Option<f64> {
        self.0.placement.as_ref().map(|placement| placement.probability)
    }

    /// Covariance of (x, y, theta) in the axes of the world, m2, m rad, rad2; shape (3, 3).
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let covariance = self.0.placement.as_ref().and_then(|found| found.covariance.as_ref());
        covariance.map(|covariance| array(py, covariance)).transpose()
    }

    /// The robots whose maps hang together with it.
    #[getter]
    fn together_with(&self) -> Vec<String> {
        self.0.with.clone()
    }

    /// The robot whose map it matches best by the two maps alone, and the probability of that.
    #[getter]
    fn best_match(&self) -> Option<(String, f64)> {
        self.0.best_match.clone()
    }

    fn __repr__(&self) -> String {
        let place = if self.0.placement.is_some() { "placed" } else { "not placed" };
        format!("Robot({:?}, {place})", self.0.name)
    }
}

/// What a call changed about a robot's map.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Change(Found);

#[pymethods]
impl Change {
    /// Whose map.
    #[getter]
    fn robot(&self) -> &str {
        &self.0.robot
    }

    /// "placed", "moved", "undone" or "new-frame".
    #[getter]
    fn kind(&self) -> &'static str {
        match self.0.kind {
            ChangeKind::Placed { .. } => "placed",
            ChangeKind::Moved { .. } => "moved",
            ChangeKind::Undone { .. } => "undone",
            ChangeKind::NewFrame => "new-frame",
            _ => "changed",
        }
    }

    /// Where it now lies in the world.
    #[getter]
    fn transform(&self) -> Option<Transform> {
        match &self.0.kind {
            ChangeKind::Placed { world_from_map, .. }
            | ChangeKind::Moved { world_from_map, .. } => optional(Some(world_from_map)),
            _ => None,
        }
    }

    /// Why it lost its place; `None` unless it did.
    #[getter]
    fn reason(&self) -> Option<String> {
        let ChangeKind::Undone { because, .. } = &self.0.kind else { return None };
        Some(match because {
            Because::Contradicted { conflict_m, hit_m } => {
                format!("{conflict_m:.1} m of wall contradict it, {hit_m:.1} m fit")
            }
            Because::Outweighed { lead } => {
                format!("without it the walls are better explained, by {lead:.1} in log-odds")
            }
            Because::Asked => "as asked".to_owned(),
            Because::NewFrame => "it started anew in another frame".to_owned(),
            _ => "another answer stands".to_owned(),
        })
    }

    fn __repr__(&self) -> String {
        format!("Change({:?}, {:?})", self.0.robot, self.kind())
    }
}
