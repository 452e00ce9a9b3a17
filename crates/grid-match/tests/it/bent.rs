//! Maps that drift has bent.

use grid_match::{PreparedMap, score_pose};
use nalgebra::Vector2;
use ogm_core::{ClassThresholds, Se2};

use crate::world::{OFFICE, WORKSHOP, Wall, draw, matched};

const VIEW: [f64; 4] = [-0.2, -0.2, 12.2, 9.2];

/// The office with its right half moved up by 0.25 m.
fn bent() -> Vec<Wall> {
    let lift = |x: f64| if x > 6.0 { 0.25 } else { 0.0 };
    OFFICE.iter().map(|&[x0, y0, x1, y1]| [x0, y0 + lift(x0), x1, y1 + lift(x1)]).collect()
}

/// How far the halves of a broken map lie apart, metres: further than its walls are thick.
const LIFT: f64 = 0.35;

/// The office with its right half moved up; walls that cross the middle are broken there.
fn broken() -> Vec<Wall> {
    let halves = OFFICE.iter().flat_map(|&[x0, y0, x1, y1]| {
        let crosses = (x0 - 6.0) * (x1 - 6.0) < 0.0;
        let middle = y0 + (y1 - y0) * (6.0 - x0) / (x1 - x0);
        let whole = [Some([x0, y0, x1, y1]), None];
        let parts = [Some([x0, y0, 6.0, middle]), Some([6.0, middle, x1, y1])];
        if crosses { parts } else { whole }
    });
    halves
        .flatten()
        .map(|[x0, y0, x1, y1]| {
            let lift = if x0 + x1 > 12.0 { LIFT } else { 0.0 };
            [x0, y0 + lift, x1, y1 + lift]
        })
        .collect()
}

fn prepared(walls: &[Wall]) -> PreparedMap {
    PreparedMap::new(&draw(walls, VIEW, 0.05, Se2::identity()), &ClassThresholds::default(), &())
        .unwrap()
}

#[test]
fn a_bent_map_fits_once_its_parts_give_way() {
    let evidence = score_pose(&prepared(OFFICE), &prepared(&bent()), &Se2::identity()).unwrap();
    let relaxed = evidence.relaxed;
    let wall = evidence.hit_m + evidence.near_miss_m + evidence.conflict_m;
    assert!(evidence.hit_m < 0.9 * wall, "{evidence:?}");
    let (hit, against) = (relaxed.mean().hit_m, relaxed.mean().against_m());
    assert!(hit > 0.95 * wall && against < 0.02 * wall, "{evidence:?}");
    assert!((0.03..0.25).contains(&relaxed.moved_m), "{evidence:?}");
}

#[test]
fn giving_way_does_not_turn_one_building_into_another() {
    let evidence = score_pose(&prepared(OFFICE), &prepared(WORKSHOP), &Se2::identity()).unwrap();
    let relaxed = evidence.relaxed;
    assert!(relaxed.mean().against_m() > 8.0, "{evidence:?}");
}

#[test]
fn a_report_says_how_far_its_parts_lie_from_its_pose() {
    let target = draw(OFFICE, VIEW, 0.05, Se2::identity());
    let source = draw(&broken(), VIEW, 0.05, Se2::new(1.0, 2.0, 0.4));
    let report = matched(&target, &source);
    let best = &report.hypotheses[0];
    let bend = &best.bend;
    assert!(bend.rms_m > 0.03, "{bend:?}");
    // Where each part really lies: the halves were moved apart, whatever the pose makes of it.
    let mut errors: Vec<f64> = bend
        .patches
        .iter()
        .map(|patch| {
            let place = Se2::new(1.0, 2.0, 0.4) * patch.at;
            let truth = place - Vector2::new(0.0, if place.x > 6.0 { LIFT } else { 0.0 });
            (best.pose.target_from_source * patch.at + patch.shift - truth).norm()
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    assert!(errors[errors.len() / 2] < 0.1 * LIFT, "{errors:?}");

    let same = matched(&target, &draw(OFFICE, VIEW, 0.05, Se2::new(1.0, 2.0, 0.4)));
    assert!(same.hypotheses[0].bend.rms_m < 0.02, "{:?}", same.hypotheses[0].bend);
}

#[test]
fn with_the_maps_swapped_a_report_says_the_same_the_other_way_round() {
    let target = draw(OFFICE, VIEW, 0.05, Se2::new(-3.0, 1.0, 2.0));
    let source = draw(&broken(), VIEW, 0.05, Se2::new(1.0, 2.0, 0.4));
    let (forth, back) = (matched(&target, &source), matched(&source, &target));
    assert_eq!(forth.hypotheses.len(), back.hypotheses.len());
    for (forth, back) in forth.hypotheses.iter().zip(&back.hypotheses) {
        let covariance = forth.pose.covariance;
        assert!((covariance - back.pose.inverse().covariance).norm() < 1e-6 * covariance.norm());
        assert_eq!(forth.bend.rms_m, back.bend.rms_m);
        assert_eq!(forth.bend.patches.len(), back.bend.patches.len());
        for (there, here) in forth.bend.patches.iter().zip(&back.bend.patches) {
            let on_target = forth.pose.target_from_source * there.at + there.shift;
            assert!((on_target - here.at).norm() < 1e-6, "{on_target} is not {}", here.at);
            let on_source = back.pose.target_from_source * here.at + here.shift;
            assert!((on_source - there.at).norm() < 1e-6, "{on_source} is not {}", there.at);
            assert_eq!(there.turn, -here.turn);
        }
    }
}

#[test]
fn a_map_that_is_longer_one_way_is_said_to_be() {
    let longer: Vec<Wall> =
        OFFICE.iter().map(|&[x0, y0, x1, y1]| [1.04 * x0, y0, 1.04 * x1, y1]).collect();
    let view = [-0.2, -0.2, 12.7, 9.2];
    let target = draw(&longer, view, 0.05, Se2::identity());
    let source = draw(OFFICE, VIEW, 0.05, Se2::new(1.0, 2.0, 0.4));
    let report = matched(&target, &source);
    // Along the axes of the source, which is turned by 0.4 against the building.
    let stretch = report.hypotheses[0].bend.stretch;
    let (sin, cos) = 0.4_f64.sin_cos();
    let expected = [0.04 * cos * cos, 0.04 * sin * sin];
    assert!((stretch.x - expected[0]).abs() < 0.012, "{stretch:?} instead of {expected:?}");
    assert!((stretch.y - expected[1]).abs() < 0.012, "{stretch:?} instead of {expected:?}");
}
