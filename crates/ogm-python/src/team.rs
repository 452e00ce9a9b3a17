//! More than two maps, or maps of which something is known.

use std::collections::BTreeMap;
use std::mem::take;
use std::sync::Arc;

use ogm_core::{OccupancyGrid, Stage, TagEstimate};
use ogm_merge::{KnownPose, MergeError, Method, PairAlignment, RobotMap, TeamParams, merge_team};
use pyo3::prelude::{Bound, Py, PyAny, PyResult, Python};

use crate::alignment::{Alignment, Hypothesis};
use crate::background::Background;
use crate::component::{Component, Fusion};
use crate::error::MapError;
use crate::outcome::{Merge, Pair};
use crate::search::Search;
use crate::transform::{optional, pose};

/// Share of a merge that its search takes; the rest is the fusion.
const SEARCH: f64 = 0.9;

/// What is known of a team before it is looked for.
#[derive(Debug, Default)]
pub(crate) struct Known {
    poses: Vec<KnownPose>,
    alignments: Vec<PairAlignment>,
    reference: usize,
}

/// What was found about pairs of maps, by their places: target, source.
pub(crate) type Alignments<'py> = BTreeMap<(usize, usize), Vec<Bound<'py, Hypothesis>>>;

impl Known {
    /// Map `reference` gives the frame, and in it some maps lie as `poses` say, with standard
    /// deviations `sigma` in metres and radians, or to the letter.
    pub(crate) fn new(
        poses: BTreeMap<usize, Bound<'_, PyAny>>,
        sigma: Option<(f64, f64)>,
        alignments: Alignments<'_>,
        reference: usize,
    ) -> PyResult<Self> {
        let known = |(map, given): (usize, Bound<'_, PyAny>)| {
            let (sigma_m, sigma_rad) = sigma.unwrap_or_default();
            Ok(KnownPose { map, reference_from_map: pose(&given)?, sigma_m, sigma_rad })
        };
        let poses = poses.into_iter().map(known).collect::<PyResult<_>>()?;
        let alignments = alignments.into_iter().map(|((target, source), found)| {
            let hypotheses = found.iter().map(|found| found.get().0.clone()).collect();
            PairAlignment { target, source, hypotheses }
        });
        Ok(Self { poses, alignments: alignments.collect(), reference })
    }

    /// Whether nothing is known, and the first map gives the frame.
    pub(crate) fn is_nothing(&self) -> bool {
        self.poses.is_empty() && self.alignments.is_empty() && self.reference == 0
    }
}

/// Merges any number of maps.
#[expect(clippy::too_many_arguments, reason = "what the caller wrote, one by one")]
pub(crate) fn merge_known(
    py: Python<'_>,
    maps: &[Arc<OccupancyGrid>],
    tags: &[Vec<TagEstimate>],
    known: Known,
    search: Search,
    fusion: &Fusion,
    background: &Background,
) -> PyResult<Merge> {
    if !matches!(search.method, Method::Auto | Method::Match) {
        let name = search.method.name();
        let text = format!("the method {name} is for two maps; use auto or match");
        return Err(MapError::new_err(text));
    }
    if search.params.prior.is_some() {
        return Err(MapError::new_err("a prior is for two maps; use poses"));
    }
    let Known { poses, alignments, reference } = known;
    let params = TeamParams { align: search.params, poses, alignments, reference };
    let (mut report, parts) = background.run(py, |progress| {
        let robots: Vec<RobotMap<'_>> =
            maps.iter().zip(tags).map(|(map, tags)| RobotMap { map, tags }).collect();
        let report = merge_team(&robots, &params, &Stage::new(progress, 0.0, SEARCH))?;
        let grids: Vec<&OccupancyGrid> = maps.iter().map(AsRef::as_ref).collect();
        let whole = Stage::new(progress, SEARCH, 1.0);
        let parts = fusion.of_each(&grids, &report.components, &whole)?;
        Ok::<_, MergeError>((report, parts))
    })?;
    let pairs = take(&mut report.pairs).into_iter().map(|pair| {
        let both = [pair.target, pair.source].map(|map| Arc::clone(&maps[map]));
        let alignment = pair.report.map(|report| Py::new(py, Alignment::new(report, both)));
        Py::new(
            py,
            Pair {
                target: pair.target,
                source: pair.source,
                alignment: alignment.transpose()?,
                transform: optional(pair.target_from_source.as_ref()),
            },
        )
    });
    let pairs = pairs.collect::<PyResult<_>>()?;
    let components = Component::each(py, take(&mut report.components), parts)?;
    Ok(Merge { components, pairs, team: Some(report) })
}
