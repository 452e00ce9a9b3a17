//! Points that are searched again and again, and the wall around each.

use ogm_core::Se2;

use crate::cloud::Cloud;
use crate::pairing::Matcher;
use crate::structure::{Shape, shapes};
use crate::{Correspondence, IcpError, IcpParams, WallPoint, WallPoints};

/// Wall points with an index over them, to align many sources to.
#[derive(Debug)]
pub struct Target {
    points: WallPoints,
    pub(crate) index: Index,
}

impl Target {
    /// Sorts the points and finds the walls around them.
    #[must_use]
    pub fn new(points: WallPoints) -> Self {
        let index = Index::of_points(points.points().iter().copied(), points.spacing());
        Self { points, index }
    }

    /// The points.
    #[must_use]
    pub fn points(&self) -> &WallPoints {
        &self.points
    }
}

/// Points that are searched, and the wall around each.
#[derive(Debug)]
pub(crate) struct Index {
    pub(crate) cloud: Cloud,
    pub(crate) shapes: Vec<Shape>,
}

impl Index {
    pub(crate) fn of_points(points: impl Iterator<Item = WallPoint>, spacing: f64) -> Self {
        let cloud = Cloud::new(points, spacing);
        Self { shapes: shapes(&cloud), cloud }
    }
}

/// Which point of `source` corresponds to which of `target` under a pose, at most
/// [`IcpParams::max_correspondence_distance`] apart and as [`IcpParams::pairing`] asks; in the order
/// of the source.
///
/// # Errors
/// A non-finite pose, or a parameter outside its range.
pub fn correspondences(
    target: &Target,
    source: &WallPoints,
    target_from_source: Se2,
    params: &IcpParams,
) -> Result<Vec<Correspondence>, IcpError> {
    params.check()?;
    target_from_source.check_finite()?;
    let spacing = target.points.spacing().max(source.spacing());
    let source = Cloud::new(source.points().iter().copied(), source.spacing());
    let mut matcher = Matcher::new(&target.index.cloud, &source, params, spacing);
    matcher.pair(&target_from_source, params.max_correspondence_distance.resolve(spacing));
    let pairs = matcher.pairs.iter().map(|pair| Correspondence {
        source: pair.source as usize,
        target: pair.target as usize,
        distance: pair.distance_sq.sqrt(),
    });
    Ok(pairs.collect())
}
