//! Worked examples with known numbers, in cells of 1.

use icp2d::{IcpParams, Metric, Pairing, WallPoint, align, translate_then_rotate};
use nalgebra::{Point2, Vector2};
use ogm_core::Se2;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::walls::{found, in_cells, room, set, wall};

#[test]
fn t_i1_the_printed_order_needs_the_converted_translation() {
    let tag_in_source = Point2::new(120.0, 80.0);
    let tag_in_target = Point2::new(310.0, 205.0);
    let (turn, icp_turn) = (92_f64.to_radians(), 1.3_f64.to_radians());
    let rotation = |angle| Se2::new(0.0, 0.0, angle);
    let point = Point2::new(400.0, 350.0);
    let about_tag = rotation(turn) * (point - tag_in_source);

    // Eqs. 10 and 11: translate, then rotate, about the tag.
    let in_print = |t: Vector2<f64>| tag_in_target + rotation(icp_turn) * (about_tag + t);
    let shift = Vector2::new(6.0, -4.0);
    assert!((in_print(shift) - Point2::new(30.418_987, 465.130_575)).norm() < 1e-6);

    // Eqs. 12 and 13.
    let x_c = tag_in_target + rotation(icp_turn) * shift
        - rotation(icp_turn + turn) * tag_in_source.coords;
    let composed = x_c + rotation(icp_turn + turn) * point.coords;
    assert!((composed - in_print(shift)).norm() < 1e-9);

    // What ICP returns rotates first.
    let icp = Se2::new(shift.x, shift.y, icp_turn);
    let rotated_first = tag_in_target + (icp * Point2::from(about_tag)).coords;
    assert!((rotated_first - Point2::new(30.329_782, 464.993_421)).norm() < 1e-6);
    let difference = (rotated_first - in_print(shift)).norm();
    assert!((difference - 0.163_611).abs() < 1e-6, "{difference}");
    assert!((in_print(translate_then_rotate(&icp)) - rotated_first).norm() < 1e-9);
}

#[test]
fn t_i2_random_points_are_recovered_to_rounding() {
    let truth = Se2::about(Point2::origin(), 1_f64.to_radians(), Vector2::new(3.0, -2.0));
    for seed in 0..20 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let source: Vec<_> = (0..500)
            .map(|_| WallPoint {
                position: Point2::new(
                    rng.random_range(-150.0..150.0),
                    rng.random_range(-150.0..150.0),
                ),
                free_side: None,
            })
            .collect();
        let target = set(crate::walls::moved(&source, truth));
        let start = Se2::identity();
        let found = found(align(&target, &set(source), start, &in_cells()).unwrap());
        assert!(found.termination.is_converged(), "seed {seed}: {found:?}");
        let error = (found.target_from_source.translation() - truth.translation()).norm();
        let turned = (found.target_from_source.theta() - truth.theta()).abs();
        assert!(error < 1e-9 && turned < 1e-9, "seed {seed}: {error} m, {turned} rad");
    }
}

#[test]
fn t_i3_along_a_corridor_the_start_is_kept() {
    let angle = 0.4;
    let direction = Vector2::new(f64::cos(angle), f64::sin(angle));
    let corridor =
        [wall([0, 0], [200, 0], Some(Vector2::y())), wall([0, 20], [200, 20], Some(-Vector2::y()))]
            .concat();
    let corridor = crate::walls::moved(&corridor, Se2::new(5.0, 7.0, angle));
    let normal = Vector2::new(-direction.y, direction.x);
    let centre = Point2::from(Vector2::new(5.0, 7.0) + direction * 100.0 + normal * 10.0);
    let start = Se2::about(centre, 0.5_f64.to_radians(), direction * 3.3 + normal * 2.0);
    let walls = set(corridor);
    for metric in [Metric::PointToPoint, Metric::PointToLine] {
        let params = IcpParams { metric, ..in_cells() };
        let found = found(align(&walls, &walls, start, &params).unwrap());
        let unobservable = found.unobservable.unwrap();
        assert!(unobservable.dot(&direction).abs() > 1.0 - 1e-9, "{unobservable}");
        let shift = found.target_from_source * centre - centre;
        assert!((shift.dot(&direction) - 3.3).abs() < 0.05, "{metric:?}: {found:?}");
        assert!(shift.perp(&direction).abs() < 1e-3, "{metric:?}: {found:?}");
        assert!(found.target_from_source.theta().abs() < 1e-5, "{metric:?}: {found:?}");
    }
}

/// A box of 200 × 160 with inner walls at the given x, seen from `side`.
fn toy(at: [[i32; 3]; 3], side: Vector2<f64>) -> Vec<WallPoint> {
    let inner = at.map(|[x, from, to]| wall([x, from], [x, to], Some(side)));
    [room(200, 160), inner.concat()].concat()
}

fn left_faces() -> Vec<WallPoint> {
    toy([[60, 0, 110], [130, 50, 160], [90, 30, 130]], -Vector2::x())
}

fn right_faces() -> Vec<WallPoint> {
    toy([[66, 0, 110], [136, 50, 160], [96, 30, 130]], Vector2::x())
}

fn shift_from_truth(target: Vec<WallPoint>, pairing: Pairing) -> f64 {
    // The printed numbers are those of point to point.
    let params = IcpParams { pairing, metric: Metric::PointToPoint, ..in_cells() };
    let start = Se2::identity();
    let outcome = align(&set(target), &set(left_faces()), start, &params).unwrap();
    found(outcome).target_from_source.translation().norm()
}

#[test]
fn t_i4_only_free_sides_tell_the_two_faces_of_a_wall_apart() {
    for (pairing, expected, tolerance) in [
        (Pairing::NormalsReciprocal, 0.0, 1e-9),
        (Pairing::Normals, 0.0, 1e-9),
        // Known failures: these pairings shift the map by half the thickness of its walls.
        (Pairing::OneWay, 2.99, 0.02),
        (Pairing::Reciprocal, 3.03, 0.02),
        // How far a trimmed one goes depends on what it does with equal distances.
        (Pairing::Trimmed(0.8), 1.92, 0.02),
    ] {
        let shift = shift_from_truth(right_faces(), pairing);
        assert!((shift - expected).abs() <= tolerance, "{pairing:?}: {shift}");
    }
}

#[test]
fn t_i4_where_the_target_has_both_faces_no_pairing_shifts() {
    for pairing in [
        Pairing::NormalsReciprocal,
        Pairing::Normals,
        Pairing::OneWay,
        Pairing::Reciprocal,
        Pairing::Trimmed(0.8),
    ] {
        let both = [left_faces(), right_faces()].concat();
        let shift = shift_from_truth(both, pairing);
        assert!(shift < 1e-9, "{pairing:?}: {shift}");
    }
}
