//! What a user sees of a map that is made straight.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use nalgebra::Point2;
use ogm_core::{ClassThresholds, NearestWall};
use ogm_merge::{BendParams, BendReport, unbend};
use ogm_sim::{FloorKind, LabelledPair, bent_pair};

fn unbent(pair: &LabelledPair) -> BendReport {
    let pose = pair.truth.unwrap().target_from_source;
    unbend(&pair.target, &pair.source, &pose, &BendParams::default(), &()).unwrap()
}

/// Root mean square distance of common walls of the source, after being moved, from where the
/// target shows them, metres.
fn residual(pair: &LabelledPair, moved: impl Fn(Point2<f64>) -> Point2<f64>) -> f64 {
    let thresholds = ClassThresholds::default();
    let (truth, bend) = (pair.truth.unwrap(), pair.bend.as_ref().unwrap());
    let walls = NearestWall::new(&pair.target, &thresholds).unwrap();
    let reach = 2.0 * pair.target.frame().resolution();
    let (mut sum, mut count) = (0.0, 0.0);
    for wall in pair.source.occupied_points(&thresholds) {
        let Some(belongs) = bend.in_target(wall) else { continue };
        if (walls.nearest_to(belongs) - belongs).norm() <= reach {
            sum += (truth.target_from_source * moved(wall) - belongs).norm_squared();
            count += 1.0;
        }
    }
    assert!(count > 500.0, "{count} common walls");
    f64::sqrt(sum / count)
}

#[test]
fn walls_of_a_bent_map_come_to_lie_where_the_other_map_shows_them() {
    for (kind, bends, seed) in [
        (FloorKind::Offices, [0.0, 0.2], 722),
        (FloorKind::Offices, [0.0, 0.2], 707),
        (FloorKind::Hall, [0.2, 0.2], 423),
    ] {
        let pair = bent_pair(kind, bends, seed).unwrap();
        let report = unbent(&pair);
        assert!(report.is_borne_out, "{} scores", report.score);
        let before = residual(&pair, |wall| wall);
        let after = residual(&pair, |wall| report.warp.apply(wall));
        assert!(after <= 0.4 * before, "{before} m became {after} m");
        assert!(report.rms_m > 0.5 * before && report.max_m >= report.rms_m);
        let farthest = report.motion(report.at).norm();
        assert!((farthest - report.max_m).abs() < 1e-12);
    }
}

#[test]
fn the_straightened_map_lies_at_the_pose_of_the_bent_one() {
    let pair = bent_pair(FloorKind::Offices, [0.0, 0.2], 722).unwrap();
    let report = unbent(&pair);
    let thresholds = ClassThresholds::default();
    let straight = report.straightened(&pair.source, &()).unwrap();
    let out = NearestWall::new(&straight, &thresholds).unwrap();
    let cell = straight.frame().resolution();
    for wall in pair.source.occupied_points(&thresholds) {
        let place = report.warp.apply(wall);
        // The nearest to the middle of a cell, of a wall that is within a cell.
        assert!((out.nearest_to(place) - place).norm() <= 2.5 * cell, "{wall} is lost");
    }
}

#[test]
fn a_map_that_is_not_bent_is_left_alone() {
    for kind in [FloorKind::Offices, FloorKind::Flat, FloorKind::Ring] {
        let mut judged = 0;
        for seed in 740..743 {
            let Ok(pair) = bent_pair(kind, [0.0, 0.0], seed) else { continue };
            let report = unbent(&pair);
            assert!(!report.is_borne_out, "{kind:?} {seed}: {} scores", report.score);
            judged += 1;
        }
        assert!(judged >= 1, "{kind:?}: {judged} pairs");
    }
}

#[test]
fn a_pose_that_is_off_is_no_bend() {
    for (shift_m, turn) in [(0.1, 0.0), (0.2, 0.0), (0.1, 0.01)] {
        let pair = bent_pair(FloorKind::Offices, [0.0, 0.0], 741).unwrap();
        let off = ogm_core::Se2::new(shift_m, -shift_m, turn);
        let pose = off * pair.truth.unwrap().target_from_source;
        let report =
            unbend(&pair.target, &pair.source, &pose, &BendParams::default(), &()).unwrap();
        assert!(!report.is_borne_out, "{off}: {} scores", report.score);
    }
}

#[test]
fn maps_with_nothing_in_common_bend_nothing() {
    let a = bent_pair(FloorKind::Offices, [0.0, 0.0], 741).unwrap();
    let b = bent_pair(FloorKind::Flat, [0.0, 0.3], 706).unwrap();
    let far = ogm_core::Se2::new(500.0, 0.0, 0.3);
    let report = unbend(&a.target, &b.source, &far, &BendParams::default(), &()).unwrap();
    assert!(!report.is_borne_out);
    assert!(report.max_m == 0.0 && report.patches == 0, "{report:?}");
    let nan = ogm_core::Se2::new(f64::NAN, 0.0, 0.0);
    assert!(unbend(&a.target, &b.source, &nan, &BendParams::default(), &()).is_err());
}
