//! What stays of a wall segment under rotation and translation.

use nalgebra::Point2;
use ogm_core::wrap_angle;

/// Distance and angle vectors of a segment P(0), …, P(n) (Saeedi et al., Eqs. 3 to 7, with their
/// indices repaired).
///
/// Mirror images differ in the sign of `turn` and `arc`. Together with P(0) the signature leaves
/// the direction of the segment open: Theorem 1 of the paper does not hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Signature {
    /// d_i = |P(i) − P(0)|, i = 1, …, n, metres.
    pub distance: Vec<f64>,
    /// δ_i, i = 1, …, n − 1: by how much the direction from P(0) turns from P(i) to P(i + 1),
    /// radians in [−π, π).
    pub turn: Vec<f64>,
    /// ω_i = d_(i+1) (δ_1 + … + δ_i), i = 1, …, n − 1: the arc at that radius, metres.
    pub arc: Vec<f64>,
}

/// The signature of a segment, or `None` for fewer than three points, a point that is not finite,
/// or a later point that coincides with the first: then there is no direction to turn from.
#[must_use]
pub fn signature(points: &[Point2<f64>]) -> Option<Signature> {
    let (start, rest) = points.split_first()?;
    let distance: Vec<f64> = rest.iter().map(|point| (point - start).norm()).collect();
    if rest.len() < 2 || !distance.iter().all(|d| d.is_finite() && *d > 0.0) {
        return None;
    }
    let direction = |point: &Point2<f64>| (point.y - start.y).atan2(point.x - start.x);
    let turns = rest.windows(2).map(|pair| wrap_angle(direction(&pair[1]) - direction(&pair[0])));
    let turn: Vec<f64> = turns.collect();
    let mut turned = 0.0;
    let arcs = turn.iter().zip(&distance[1..]).map(|(turn, distance)| {
        turned += turn;
        distance * turned
    });
    let arc = arcs.collect();
    Some(Signature { distance, turn, arc })
}

#[cfg(test)]
mod tests {
    use super::signature;
    use nalgebra::Point2;
    use ogm_core::Se2;
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::f64::consts::{FRAC_PI_2, PI};

    const T_S2: [(f64, f64); 7] =
        [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0), (3.0, 2.0), (2.0, 3.0), (1.0, 3.0)];

    fn points(coordinates: &[(f64, f64)]) -> Vec<Point2<f64>> {
        coordinates.iter().map(|&(x, y)| Point2::new(x, y)).collect()
    }

    fn assert_close(ours: &[f64], expected: &[f64]) {
        assert_eq!(ours.len(), expected.len());
        for (a, b) in ours.iter().zip(expected) {
            assert!((a - b).abs() < 1e-6, "{ours:?} {expected:?}");
        }
    }

    #[test]
    fn t_s2_worked_signature_and_its_mirror_image() {
        let ours = signature(&points(&T_S2)).unwrap();
        assert_close(&ours.distance, &[1.0, 2.0, 3.162278, 3.605551, 3.605551, 3.162278]);
        let degrees: Vec<f64> = ours.turn.iter().map(|turn| turn.to_degrees()).collect();
        assert_close(&degrees, &[0.0, 18.434949, 15.255119, 22.619865, 15.255119]);
        assert_close(&ours.arc, &[0.0, 1.017465, 2.120074, 3.543513, 3.949830]);

        let mirrored = signature(&points(&T_S2.map(|(x, y)| (x, -y)))).unwrap();
        assert_close(&mirrored.distance, &ours.distance);
        let opposite: Vec<f64> = ours.turn.iter().map(|turn| -turn).collect();
        assert_close(&mirrored.turn, &opposite);
    }

    #[test]
    fn t_s3_first_point_and_signature_do_not_fix_a_segment() {
        let segment = points(&T_S2);
        let start_from_start = Se2::new(0.0, 0.0, FRAC_PI_2);
        let turned: Vec<_> = segment.iter().map(|&p| start_from_start * p).collect();
        let (a, b) = (signature(&segment).unwrap(), signature(&turned).unwrap());
        assert_close(&a.distance, &b.distance);
        assert_close(&a.turn, &b.turn);
        assert_eq!(segment[0], turned[0]);
        assert!((segment[6] - turned[6]).norm() > 4.0, "and yet they lie elsewhere");
    }

    #[test]
    fn a_turn_across_the_cut_of_the_angle_is_small() {
        let crossing = points(&[(0.0, 0.0), (-1.0, 0.1763270), (-1.0, -0.1763270)]);
        let turn = signature(&crossing).unwrap().turn[0].to_degrees();
        assert!((turn - 20.0).abs() < 1e-5, "{turn}");
    }

    #[test]
    fn there_is_no_signature_without_directions() {
        assert_eq!(signature(&[]), None);
        assert_eq!(signature(&points(&T_S2[..2])), None);
        assert_eq!(signature(&points(&[(0.0, 0.0), (1.0, 0.0), (0.0, 0.0)])), None);
        assert_eq!(signature(&points(&[(0.0, 0.0), (1.0, 0.0), (f64::NAN, 0.0)])), None);
    }

    proptest! {
        #[test]
        fn a_rigid_motion_changes_nothing(
            steps in prop::collection::vec((0.2_f64..1.0, -0.3_f64..0.3), 2..30),
            x in -50.0_f64..50.0, y in -50.0_f64..50.0, theta in -PI..PI,
        ) {
            let mut at = Point2::origin();
            let mut segment = vec![at];
            for (forward, aside) in steps {
                at += nalgebra::Vector2::new(forward, aside);
                segment.push(at);
            }
            let target_from_source = Se2::new(x, y, theta);
            let moved: Vec<_> = segment.iter().map(|&p| target_from_source * p).collect();
            let (a, b) = (signature(&segment).unwrap(), signature(&moved).unwrap());
            let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
            prop_assert!(close(&a.distance, &b.distance));
            prop_assert!(close(&a.turn, &b.turn));
            prop_assert!(close(&a.arc, &b.arc));
        }
    }
}
