//! Tag pairs for tests.

use nalgebra::{Matrix2, Point2};
use ogm_core::{Se2, TagEstimate};

use crate::{TagPair, common_tags};

/// A certain estimate at (`x`, `y`).
pub(crate) fn estimate(tag_id: u32, x: f64, y: f64) -> TagEstimate {
    let position = Point2::new(x, y);
    TagEstimate {
        tag_id: tag_id.into(),
        position,
        mode: position,
        covariance: Matrix2::from_diagonal_element(1e-4),
        certainty: 0.99,
        misfit: 1.0,
        readings: 300,
        dropped: 0,
        touches_border: false,
        second_peak_ratio: 0.0,
    }
}

/// Pairs of tags 1, 2, … at (target, source), the first the most certain.
pub(crate) fn pairs_at<const N: usize>(places: [([f64; 2], [f64; 2]); N]) -> [TagPair; N] {
    let mut certainty = 1.0;
    let mut id = 0;
    let (targets, sources): (Vec<_>, Vec<_>) = places
        .into_iter()
        .map(|(target, source)| {
            certainty -= 0.01;
            id += 1;
            let at = |[x, y]: [f64; 2]| TagEstimate { certainty, ..estimate(id, x, y) };
            (at(target), at(source))
        })
        .unzip();
    let pairs = common_tags(&targets, &sources).expect("usable estimates");
    pairs.try_into().expect("every tag is in both maps")
}

/// Pairs of tags at `sources`, exactly where `target_from_source` puts them in the target.
pub(crate) fn moved_pairs<const N: usize>(
    target_from_source: Se2,
    sources: [[f64; 2]; N],
) -> [TagPair; N] {
    pairs_at(sources.map(|source| {
        let target = target_from_source * Point2::from(source);
        ([target.x, target.y], source)
    }))
}
