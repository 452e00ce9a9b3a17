//! Which source point corresponds to which target point.

use nalgebra::{distance, distance_squared};
use ogm_core::Se2;

use crate::cloud::Cloud;
use crate::tracking::Tracker;
use crate::{IcpParams, Pairing};

/// A source point and a target point by index.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair {
    pub(crate) source: u32,
    pub(crate) target: u32,
    pub(crate) distance_sq: f64,
}

/// Finds pairs again and again, in the same buffers.
#[derive(Debug)]
pub(crate) struct Matcher<'a> {
    pub(crate) target: &'a Cloud,
    pub(crate) source: &'a Cloud,
    pairing: Pairing,
    min_side_cosine: f64,
    /// Metres.
    reciprocity: f64,
    forth: Tracker,
    back: Tracker,
    pub(crate) pairs: Vec<Pair>,
    /// Partly sorted squared lengths of the pairs.
    sorted: Vec<f64>,
}

impl<'a> Matcher<'a> {
    pub(crate) fn new(
        target: &'a Cloud,
        source: &'a Cloud,
        params: &IcpParams,
        spacing: f64,
    ) -> Self {
        Self {
            target,
            source,
            pairing: params.pairing,
            min_side_cosine: params.min_side_cosine,
            reciprocity: params.reciprocity.resolve(spacing),
            forth: Tracker::new(source.positions.len(), target.spacing),
            back: Tracker::new(target.positions.len(), source.spacing),
            pairs: Vec::with_capacity(source.positions.len()),
            sorted: Vec::new(),
        }
    }

    /// Fills [`pairs`](Self::pairs) with those at most `reach` metres apart.
    pub(crate) fn pair(&mut self, target_from_source: &Se2, reach: f64) {
        self.pair_one_way(target_from_source, reach);
        if let Pairing::Normals | Pairing::NormalsReciprocal = self.pairing {
            self.reject_other_sides(target_from_source);
        }
        if let Pairing::Reciprocal | Pairing::NormalsReciprocal = self.pairing {
            self.reject_one_sided(target_from_source);
        }
        if let Pairing::Trimmed(share) = self.pairing {
            self.keep_best(share);
        }
    }

    /// Root mean square distance of the pairs, metres; NaN if there are none.
    pub(crate) fn rmse(&self) -> f64 {
        let sum: f64 = self.pairs.iter().map(|pair| pair.distance_sq).sum();
        (sum / self.pairs.len() as f64).sqrt()
    }

    fn pair_one_way(&mut self, target_from_source: &Se2, reach: f64) {
        self.pairs.clear();
        for (source, (index, &point)) in (0..).zip(self.source.positions.iter().enumerate()) {
            let query = *target_from_source * point;
            let found = self.forth.nearest(index, query, self.target, reach);
            self.pairs.extend(found.map(|(target, distance_sq)| Pair {
                source,
                target,
                distance_sq,
            }));
        }
    }

    fn reject_other_sides(&mut self, target_from_source: &Se2) {
        let (target, source) = (self.target, self.source);
        let min_cosine = self.min_side_cosine;
        self.pairs.retain(|pair| {
            let target_side = target.free_sides[pair.target as usize];
            let source_side = source.free_sides[pair.source as usize];
            target_side
                .zip(source_side)
                .is_none_or(|(a, b)| a.dot(&(*target_from_source * b)) > min_cosine)
        });
    }

    /// Rejects pairs of which the target point is nearest to a source point elsewhere.
    fn reject_one_sided(&mut self, target_from_source: &Se2) {
        let source_from_target = target_from_source.inverse();
        let (target, source, back) = (self.target, self.source, &mut self.back);
        let tolerance_sq = self.reciprocity * self.reciprocity;
        self.pairs.retain(|pair| {
            let index = pair.target as usize;
            let query = source_from_target * target.positions[index];
            let point = source.positions[pair.source as usize];
            let radius = distance(&point, &query);
            // The source point itself is at that radius, so none found means none nearer.
            back.nearest(index, query, source, radius).is_none_or(|(nearest, _)| {
                distance_squared(&source.positions[nearest as usize], &point) <= tolerance_sq
            })
        });
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share in (0, 1] of a length"
    )]
    fn keep_best(&mut self, share: f64) {
        let count = (share * self.pairs.len() as f64).ceil() as usize;
        self.sorted.clear();
        self.sorted.extend(self.pairs.iter().map(|pair| pair.distance_sq));
        if count == 0 || count >= self.sorted.len() {
            return;
        }
        let (_, &mut longest, _) = self.sorted.select_nth_unstable_by(count - 1, f64::total_cmp);
        // With all of equal length, so that the order of the points decides nothing.
        self.pairs.retain(|pair| pair.distance_sq <= longest);
    }
}
