//! What an alignment found and how it ended.

use nalgebra::{Matrix3, Point2, Vector2};
use ogm_core::Se2;

/// Where a source map lies in a target map, and how surely.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Alignment {
    /// Maps source points into the target map; it includes the start.
    pub target_from_source: Se2,
    /// How it ended. Short of [`Termination::Converged`] it is no better than its start promised.
    pub termination: Termination,
    /// Iterations done.
    pub iterations: usize,
    /// Covariance of (x, y, θ) of `target_from_source` in target axes, m², m·rad, rad², as if the
    /// residuals of the correspondences were independent of each other; those of neighbouring
    /// cells are not. `None` where walls leave a direction open.
    pub covariance: Option<Matrix3<f64>>,
    /// Correspondences at the final distance under `target_from_source`.
    pub correspondences: usize,
    /// Their share of the source points in the section.
    pub inlier_ratio: f64,
    /// Root mean square distance of their points, metres.
    pub rmse: f64,
    /// Correspondences at the final distance under the start.
    pub initial_correspondences: usize,
    /// Root mean square distance of those, metres; `None` if they were too few to say.
    pub initial_rmse: Option<f64>,
    /// Unit vector in the target frame along which the walls of the pairs say nothing, as in a
    /// corridor; along it the translation is that of the start.
    pub unobservable: Option<Vector2<f64>>,
    /// The part of the target frame that was compared.
    pub section: Section,
}

/// Points that are taken for the same place of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correspondence {
    /// The source point, by its place in its set.
    pub source: usize,
    /// The target point, by its place in its set.
    pub target: usize,
    /// Metres between them under the pose.
    pub distance: f64,
}

/// How an alignment ended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Termination {
    /// The last iteration at the final distance moved less than the stop.
    Converged,
    /// Still moving after the last allowed iteration; the last estimate is returned.
    IterationLimit,
    /// The pairs lie further apart than those of the start without being more, and the start is
    /// returned.
    WorseFit {
        /// Root mean square distance of the pairs where it ended, metres.
        rmse: f64,
    },
    /// It left the surroundings of the start, and the start is returned.
    MovedTooFar {
        /// How far the centre of the source points moved, metres.
        translation: f64,
        /// How far it turned, radians.
        rotation: f64,
    },
}

impl Termination {
    /// Whether the alignment converged.
    #[must_use]
    pub fn is_converged(&self) -> bool {
        matches!(self, Self::Converged)
    }
}

/// The rectangle of the target frame in which both maps are expected to have walls (Tsardoulias
/// et al., Fig. 18), axis-aligned, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Lower-left corner.
    pub min: Point2<f64>,
    /// Upper-right corner.
    pub max: Point2<f64>,
}

impl Section {
    /// Whether `point` of the target frame lies inside or on the border.
    #[must_use]
    pub fn contains(&self, point: Point2<f64>) -> bool {
        self.min <= point && point <= self.max
    }

    /// The intersection of the bounding boxes of two point sets in one frame, grown by `margin`.
    pub(crate) fn common(
        a: impl Iterator<Item = Point2<f64>>,
        b: impl Iterator<Item = Point2<f64>>,
        margin: f64,
    ) -> Option<Self> {
        let (a, b) = (bounding_box(a)?, bounding_box(b)?);
        let margin = Vector2::repeat(margin);
        let section = Self { min: a.min.sup(&b.min) - margin, max: a.max.inf(&b.max) + margin };
        (section.min <= section.max).then_some(section)
    }
}

fn bounding_box(mut points: impl Iterator<Item = Point2<f64>>) -> Option<Section> {
    let first = points.next()?;
    let start = Section { min: first, max: first };
    Some(points.fold(start, |sides, point| Section {
        min: sides.min.inf(&point),
        max: sides.max.sup(&point),
    }))
}
