//! The motion between two scans, by ICP, with its covariance.

use icp2d::{IcpParams, WallPoint, WallPoints, align};
use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, RelativePose, Se2};

/// Metres between the points of a scan, about: of beams 0.36° apart at a few metres, and wide enough
/// that the direction of a wall stands out of the noise of its points.
const SPACING: f64 = 0.05;

/// The covariance of ICP takes its residuals as those of independent points of one wall; pairs that
/// are nearest to each other have smaller ones, and their directions share neighbours. Mean NEES
/// over three on 1866 matches of the seeds from 9 million on, which is as good as the same at the
/// median and at 99 %.
const COVARIANCE_SCALE: f64 = 3.4;

/// The points of one scan.
pub(super) struct Scan {
    /// For the match with the scan before.
    pub(super) odd: WallPoints,
    /// For the match with the scan after.
    pub(super) even: WallPoints,
}

impl Scan {
    pub(super) fn new(beams: &[Vector2<f64>], ranges: &[f64]) -> anyhow::Result<Self> {
        let points = |rest: usize| {
            let of_beam = |(&beam, &range): (&Vector2<f64>, &f64)| WallPoint {
                position: Point2::from(beam * range),
                free_side: Some(-beam),
            };
            let beams = beams.iter().zip(ranges).skip(rest).step_by(2);
            let points = beams.filter(|(_, range)| range.is_finite()).map(of_beam).collect();
            WallPoints::from_points(points, SPACING)
        };
        Ok(Self { odd: points(1)?, even: points(0)? })
    }
}

/// Where `now` lies in the frame of `last`; `None` where walls do not say.
pub(super) fn motion(
    last: &Scan,
    now: &Scan,
    start_last_from_now: Se2,
) -> anyhow::Result<Option<RelativePose>> {
    let found = align(&last.even, &now.odd, start_last_from_now, &IcpParams::default())?;
    let Outcome::Found(found) = found else { return Ok(None) };
    let is_held = found.termination.is_converged() && found.unobservable.is_none();
    Ok(found.covariance.filter(|_| is_held).map(|covariance| RelativePose {
        target_from_source: found.target_from_source,
        covariance: COVARIANCE_SCALE * covariance,
        probability: 1.0,
    }))
}
