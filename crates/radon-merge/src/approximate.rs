//! A first pose from two segments that look alike.

use nalgebra::{Point2, Vector2, center};
use ogm_core::{Se2, wrap_angle};

/// How the translation follows from the rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PoseRule {
    /// The source segment is turned and its mean is brought onto that of the target's.
    #[default]
    Corrected,
    /// As in Eq. 13, which turns the target segment by the angle of the source: off by tens of
    /// cells even on exact data.
    AsPrinted,
}

/// The transform that brings one segment onto another, from the directions of their
/// total-least-squares lines and their means (Saeedi et al., Eqs. 12 and 13).
///
/// Both segments must run the same way: the line is directed from the first to the last point, so
/// that the whole turn is covered. `None` if a segment has no direction.
#[must_use]
pub fn approximate_pose(
    target: &[Point2<f64>],
    source: &[Point2<f64>],
    rule: PoseRule,
) -> Option<Se2> {
    let (target, source) = (Line::fit(target)?, Line::fit(source)?);
    Some(pose_between(&target, &source, rule))
}

pub(crate) fn pose_between(target: &Line, source: &Line, rule: PoseRule) -> Se2 {
    let turn = wrap_angle(target.direction - source.direction);
    let turned = Se2::new(0.0, 0.0, turn);
    let translation = match rule {
        PoseRule::Corrected => target.mean - turned * source.mean,
        PoseRule::AsPrinted => turned * target.mean - source.mean,
    };
    Se2::new(translation.x, translation.y, turn)
}

/// Where a segment lies and which way it runs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line {
    pub(crate) mean: Point2<f64>,
    /// Radians, from the first towards the last point.
    pub(crate) direction: f64,
}

impl Line {
    pub(crate) fn fit(points: &[Point2<f64>]) -> Option<Self> {
        let (first, last) = (points.first()?, points.last()?);
        let sum = points.iter().fold(Vector2::zeros(), |sum, point| sum + point.coords);
        let mean = Point2::from(sum / points.len() as f64);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for point in points {
            let offset = point - mean;
            xx += offset.x * offset.x;
            xy += offset.x * offset.y;
            yy += offset.y * offset.y;
        }
        let anisotropy = (2.0 * xy).hypot(xx - yy);
        if !anisotropy.is_finite() || anisotropy <= 1e-12 * (xx + yy) {
            return None;
        }
        let along = 0.5 * (2.0 * xy).atan2(xx - yy);
        let forward = (last - first).dot(&Vector2::new(along.cos(), along.sin())) >= 0.0;
        let direction = if forward { along } else { along + std::f64::consts::PI };
        Some(Self { mean, direction: wrap_angle(direction) })
    }
}

/// The middle of the smallest upright box around `points`; the origin if there are none.
pub(crate) fn box_centre(points: &[Point2<f64>]) -> Point2<f64> {
    let corners = points.iter().map(|&point| (point, point));
    let merged = corners.reduce(|(low, high), (point, _)| (low.inf(&point), high.sup(&point)));
    merged.map_or_else(Point2::origin, |(low, high)| center(&low, &high))
}

#[cfg(test)]
mod tests {
    use super::{PoseRule, approximate_pose};
    use nalgebra::Point2;
    use ogm_core::Se2;

    fn rms(target: &[Point2<f64>], source: &[Point2<f64>], target_from_source: Se2) -> f64 {
        let squares = target.iter().zip(source);
        let sum: f64 = squares.map(|(&t, &s)| (t - target_from_source * s).norm_squared()).sum();
        (sum / target.len() as f64).sqrt()
    }

    #[test]
    fn t_s4_the_source_is_turned_and_not_the_target() {
        let along = Se2::new(30.0, 5.0, 10.0_f64.to_radians());
        let source: Vec<_> =
            (0..20).map(|i| along * Point2::new(50.0 * f64::from(i) / 19.0, 0.0)).collect();
        let true_target_from_source = Se2::new(12.0, -7.0, 20.0_f64.to_radians());
        let target: Vec<_> = source.iter().map(|&p| true_target_from_source * p).collect();

        let target_from_source = approximate_pose(&target, &source, PoseRule::Corrected).unwrap();
        assert!((target_from_source.theta().to_degrees() - 20.0).abs() < 1e-9);
        assert!(rms(&target, &source, target_from_source) < 1e-9);

        let printed_target_from_source =
            approximate_pose(&target, &source, PoseRule::AsPrinted).unwrap();
        assert!((printed_target_from_source.x() + 5.112656).abs() < 1e-6);
        assert!((printed_target_from_source.y() - 30.450151).abs() < 1e-6);
        assert!((rms(&target, &source, printed_target_from_source) - 41.17).abs() < 0.005);
    }

    #[test]
    fn every_turn_is_found_upright_segments_included() {
        let source: Vec<_> = (0..30).map(|i| Point2::new(0.0, f64::from(i) * 0.05)).collect();
        for degrees in [0.0, 12.8, 89.0, 135.0, 192.8, -90.0, 179.9] {
            let true_target_from_source = Se2::new(1.0, -2.0, f64::to_radians(degrees));
            let target: Vec<_> = source.iter().map(|&p| true_target_from_source * p).collect();
            let target_from_source =
                approximate_pose(&target, &source, PoseRule::Corrected).unwrap();
            assert!(rms(&target, &source, target_from_source) < 1e-9, "{degrees}");
        }
    }

    #[test]
    fn a_segment_without_direction_gives_no_pose() {
        let point = [Point2::new(1.0, 1.0); 3];
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let square = square.map(|(x, y)| Point2::new(x, y));
        let line = [Point2::new(0.0, 0.0), Point2::new(1.0, 0.0)];
        assert_eq!(approximate_pose(&line, &point, PoseRule::Corrected), None);
        assert_eq!(approximate_pose(&square, &line, PoseRule::Corrected), None);
        assert_eq!(approximate_pose(&[], &line, PoseRule::Corrected), None);
    }
}
