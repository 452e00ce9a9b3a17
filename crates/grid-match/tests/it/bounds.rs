//! Priors, budgets and parameters.

use grid_match::{MatchError, MatchParams, PreparedMap, Prior, match_maps, score_pose};
use ogm_core::{GridError, ParameterError, Se2, wrap_angle};
use std::f64::consts::PI;

use crate::world::{OFFICE, ROOM, apart, draw, left_part, right_part};

fn believing(target_from_source: Se2, sigma_m: f64, sigma_rad: f64) -> MatchParams {
    let prior = Some(Prior { target_from_source, sigma_m, sigma_rad });
    MatchParams { prior, ..MatchParams::default() }
}

#[test]
fn a_prior_decides_between_the_two_ways_a_symmetric_room_fits() {
    let world_from_source = Se2::new(3.0, 2.0, 1.0);
    let whole = [-0.3, -0.3, 8.3, 5.3];
    let target = draw(ROOM, whole, 0.1, Se2::identity());
    let source = draw(ROOM, whole, 0.1, world_from_source);
    for world_from_world in [Se2::identity(), Se2::new(8.0, 5.0, PI)] {
        let expected = world_from_world * world_from_source;
        let rough = Se2::new(expected.x() + 0.4, expected.y() - 0.3, expected.theta() + 0.1);
        let report = match_maps(&target, &source, &believing(rough, 0.3, 0.1), &()).unwrap();
        let target_from_source = report.outcome.found().unwrap();
        let (shift, turn) = apart(target_from_source, expected, world_from_source);
        assert!(shift < 0.03 && turn < 0.005, "{shift} m, {turn} rad");
    }
}

#[test]
fn nothing_outside_three_sigmas_of_a_prior_is_returned() {
    let (target_pose, source_pose) = (Se2::new(2.0, 3.0, 0.35), Se2::new(9.0, 1.0, -2.1));
    let target = left_part(OFFICE, target_pose);
    let source = right_part(OFFICE, source_pose);
    let truth = target_pose.between(&source_pose);
    for (x, y, theta) in [(3.0, 0.0, 0.0), (0.0, -4.0, 1.0), (0.0, 0.0, PI)] {
        let wrong = Se2::new(truth.x() + x, truth.y() + y, truth.theta() + theta);
        for (a, b, prior) in [(&target, &source, wrong), (&source, &target, wrong.inverse())] {
            let report = match_maps(a, b, &believing(prior, 0.5, 0.1), &()).unwrap();
            assert!(report.outcome.refusal().is_some(), "{:?}", report.outcome);
            for hypothesis in &report.hypotheses {
                let pose = hypothesis.pose.target_from_source;
                assert!((pose.translation() - prior.translation()).norm() <= 1.5);
                assert!(wrap_angle(pose.theta() - prior.theta()).abs() <= 0.3);
            }
        }
    }
}

#[test]
fn a_budget_ends_the_search_at_the_same_place_each_time() {
    let target = left_part(OFFICE, Se2::identity());
    let source = right_part(OFFICE, Se2::new(9.0, 1.0, -2.1));
    let within = |limit| {
        let params = MatchParams { work_limit: Some(limit), ..MatchParams::default() };
        match_maps(&target, &source, &params, &()).unwrap()
    };
    let free = match_maps(&target, &source, &MatchParams::default(), &()).unwrap();
    assert!(!free.exhausted);
    let full = within(free.work);
    assert_eq!(format!("{full:?}"), format!("{free:?}"));
    let short = within(free.work / 3);
    assert!(short.exhausted && short.work <= free.work / 3);
    assert_eq!(format!("{:?}", within(0)), format!("{:?}", within(0)));
}

#[test]
fn parameters_that_cannot_be_meant_are_errors() {
    let map = left_part(OFFICE, Se2::identity());
    let fails = |params: MatchParams| match_maps(&map, &map, &params, &()).unwrap_err();
    for accept in [0.0, 1.1, f64::NAN] {
        let error = fails(MatchParams { accept, ..MatchParams::default() });
        assert!(
            matches!(error, MatchError::Parameter(ParameterError { name: "accept", .. })),
            "{error}"
        );
    }
    let nowhere = Se2::new(f64::NAN, 0.0, 0.0);
    let error = fails(believing(nowhere, 1.0, 1.0));
    assert!(matches!(error, MatchError::Grid(GridError::NonFiniteTransform { .. })), "{error}");
    let error = fails(believing(Se2::identity(), -1.0, 1.0));
    assert!(
        matches!(error, MatchError::Parameter(ParameterError { name: "prior.sigma_m", .. })),
        "{error}"
    );
}

#[test]
fn the_truth_scores_above_a_shifted_pose() {
    let params = MatchParams::default();
    let (target_pose, source_pose) = (Se2::new(2.0, 3.0, 0.35), Se2::new(9.0, 1.0, -2.1));
    let target =
        PreparedMap::new(&left_part(OFFICE, target_pose), &params.thresholds, &()).unwrap();
    let source =
        PreparedMap::new(&right_part(OFFICE, source_pose), &params.thresholds, &()).unwrap();
    let truth = target_pose.between(&source_pose);
    let score = |x: f64| {
        let moved_from_target = Se2::new(x, 0.0, 0.0);
        score_pose(&target, &source, &(moved_from_target * truth)).unwrap().score()
    };
    assert!(score(0.0) > score(0.5) + 2.0, "{} and {}", score(0.0), score(0.5));
    assert!(score_pose(&target, &source, &Se2::new(0.0, f64::INFINITY, 0.0)).is_err());
}
