//! Maps into one map: by a search, or in poses that are known.

use std::collections::BTreeMap;
use std::sync::Arc;

use ogm_core::{OccupancyGrid, Stage};
use ogm_merge::{Component as Members, Member, MergeError, RobotMap, align_pair};
use pyo3::prelude::{Bound, Py, PyAny, PyResult, Python, pyfunction};

use crate::alignment::Alignment;
use crate::background::Background;
use crate::component::{Component, Fusion};
use crate::error::MapError;
use crate::map::Map;
use crate::outcome::{Merge, Pair};
use crate::search::Search;
use crate::tags::of_maps;
use crate::team::{Alignments, Known, merge_known};
use crate::transform::{optional, pose};

/// Share of a merge that its search takes; the rest is the fusion.
const SEARCH: f64 = 0.8;

/// Finds how maps lie to each other and makes one map of them.
///
/// Two maps are aligned as by `align`. Of more, every pair is; then groups of maps are joined by
/// what all of their walls say together. `poses` has the poses of maps that are known, by their
/// place in `maps`, in the frame of map `reference`, with standard deviations `poses_sigma` in
/// metres and radians; without them the poses are taken as given. `alignments` has the hypotheses
/// of pairs, (target, source), that were searched elsewhere and are not searched again.
///
/// Maps that do not hang together are a value, not an exception: `bool(result)` says whether they
/// do, and `result.components` has each group as one map.
#[pyfunction]
#[pyo3(signature = (
    maps, *, method = "auto", tags = None, prior = None, prior_sigma = None, accept = None,
    repeats = false, seed = 0, poses = None, poses_sigma = None,
    alignments = None, reference = 0,
    fusion = None, resolution = None, threads = None, progress = None
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
    poses: Option<BTreeMap<usize, Bound<'_, PyAny>>>,
    poses_sigma: Option<(f64, f64)>,
    alignments: Option<Alignments<'_>>,
    reference: usize,
    fusion: Option<&str>,
    resolution: Option<f64>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Merge> {
    let search = Search::new(method, accept, repeats, seed)?.starting_at(prior, prior_sigma)?;
    let fusion = Fusion::new(fusion, resolution)?;
    let background = Background::new(threads, progress)?;
    let grids = grids_of(&maps);
    let known = Known::new(
        poses.unwrap_or_default(),
        poses_sigma,
        alignments.unwrap_or_default(),
        reference,
    )?;
    let tags = of_maps(tags, grids.len())?;
    let [target, source] = match &grids[..] {
        [target, source] if known.is_nothing() => [target, source],
        [_, _, ..] => return merge_known(py, &grids, &tags, known, search, &fusion, &background),
        _ => {
            let text = format!("merge takes at least two maps, not {}", grids.len());
            return Err(MapError::new_err(text));
        }
    };
    search.check_tags(&tags)?;
    let (report, parts) = background.run(py, |progress| {
        let [target, source] =
            [(target, 0), (source, 1)].map(|(map, index)| RobotMap { map, tags: &tags[index] });
        let part = Stage::new(progress, 0.0, SEARCH);
        let report = align_pair(search.method, &target, &source, &search.params, &part)?;
        let whole = Stage::new(progress, SEARCH, 1.0);
        let parts = fusion.of_each(&[target.map, source.map], &report.components(), &whole)?;
        Ok::<_, MergeError>((report, parts))
    })?;
    let components = Component::each(py, report.components(), parts)?;
    let transform = optional(report.outcome.clone().found().as_ref());
    let alignment = Alignment::new(report, [Arc::clone(target), Arc::clone(source)]);
    let alignment = Some(Py::new(py, alignment)?);
    let pair = Py::new(py, Pair { target: 0, source: 1, alignment, transform })?;
    Ok(Merge { components, pairs: vec![pair], team: None })
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
        Ok(Member { map, reference_from_map: pose(given)?, covariance: None, bend_m: 0.0 })
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
