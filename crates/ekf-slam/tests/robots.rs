//! Robots of known truth: what the filter says of them, and how sure it is.

#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

use ekf_slam::{Ekf, EkfError, EkfParams, Reading, Verdict};
use nalgebra::{Matrix3, Vector3};
use ogm_core::{RelativePose, Se2, wrap_angle};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::PI;

const SEEDS: u64 = 60;

fn start() -> Ekf {
    Ekf::new(EkfParams::default(), 0.0, Se2::identity(), Matrix3::zeros()).unwrap()
}

fn error_of(filter: &Ekf, truth: Se2) -> Vector3<f64> {
    let pose = filter.estimate().map_from_robot;
    let turn = wrap_angle(pose.theta() - truth.theta());
    Vector3::new(pose.x() - truth.x(), pose.y() - truth.y(), turn)
}

fn nees(filter: &Ekf, truth: Se2) -> f64 {
    let error = error_of(filter, truth);
    error.dot(&(filter.estimate().covariance.try_inverse().unwrap() * error))
}

fn scan_covariance() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1e-5, 1e-5, 1e-6))
}

/// Two minutes of a winding drive; the filter with and without corrections, and the truth.
fn drive(seed: u64, begin: Se2) -> (Ekf, Ekf, Se2) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
    let params = EkfParams::default();
    let fresh = Ekf::new(params, 0.0, begin, Matrix3::zeros()).unwrap();
    let (mut blind, mut full) = (fresh.clone(), fresh);
    let (mut truth, mut last_scan) = (begin, begin);
    let bias = params.bias_sigma * normal();
    for tick in 1..=1200_u32 {
        let time = 0.1 * f64::from(tick);
        let rate = 0.5 * (0.2 * time).sin();
        let (travel, turn) = (0.03, 0.1 * rate);
        truth = truth * Se2::exp(Vector3::new(travel, 0.0, turn));
        let mut wheel = |side: f64| {
            let exact = travel + side * turn * params.track_m / 2.0;
            exact + params.wheel_sigma_per_root_m * exact.abs().sqrt() * normal()
        };
        let odometry = Reading::Odometry { left_m: wheel(-1.0), right_m: wheel(1.0) };
        blind.add(time, &odometry).unwrap();
        full.add(time, &odometry).unwrap();
        if tick % 5 == 0 {
            let exact = last_scan.between(&truth);
            let noise = Vector3::new(normal(), normal(), normal());
            let noise = noise.component_mul(&scan_covariance().diagonal().map(f64::sqrt));
            let noisy = Se2::new(exact.x() + noise.x, exact.y() + noise.y, exact.theta() + noise.z);
            let scan = RelativePose {
                target_from_source: noisy,
                covariance: scan_covariance(),
                probability: 1.0,
            };
            full.add(time, &Reading::ScanMatch(scan)).unwrap();
            last_scan = truth;
        }
        let yaw_rate = rate + bias + params.yaw_rate_sigma * normal();
        full.add(time, &Reading::Imu { yaw_rate }).unwrap();
    }
    (blind, full, truth)
}

#[test]
fn the_covariance_is_that_of_the_error_and_scans_cut_the_error_to_a_third() {
    let (mut sum, mut mean) = (0.0, Vector3::zeros());
    let (mut blind_errors, mut full_errors) = (Vec::new(), Vec::new());
    for seed in 0..SEEDS {
        let (blind, full, truth) = drive(seed, Se2::new(2.0, -1.0, 2.5));
        sum += nees(&full, truth);
        let deviations = full.estimate().covariance.diagonal().map(f64::sqrt);
        mean += error_of(&full, truth).component_div(&deviations) / SEEDS as f64;
        blind_errors.push(error_of(&blind, truth).xy().norm());
        full_errors.push(error_of(&full, truth).xy().norm());
    }
    // χ² of 180 degrees of freedom, 95 %.
    assert!((144.7..219.0).contains(&sum), "NEES {sum}");
    // Of the mean of sixty unit errors, three deviations.
    assert!(mean.amax() < 3.0 / (SEEDS as f64).sqrt(), "{mean}");
    blind_errors.sort_by(f64::total_cmp);
    full_errors.sort_by(f64::total_cmp);
    let (blind, full) = (blind_errors[30], full_errors[30]);
    assert!(full <= 0.3 * blind, "{full} against {blind} m");
}

#[test]
fn straight_ahead_turning_in_place_and_back_again() {
    let mut filter = start();
    let quarter = EkfParams::default().track_m * PI / 4.0;
    let steps = [(1.0, 1.0), (-quarter, quarter), (0.5, 0.5)];
    for (time, (left_m, right_m)) in (1..).map(f64::from).zip(steps) {
        filter.add(time, &Reading::Odometry { left_m, right_m }).unwrap();
    }
    assert!(error_of(&filter, Se2::new(1.0, 0.5, PI / 2.0)).norm() < 1e-12);
    for (time, (left, right)) in (4..).map(f64::from).zip(steps.into_iter().rev()) {
        filter.add(time, &Reading::Odometry { left_m: -left, right_m: -right }).unwrap();
    }
    assert!(error_of(&filter, Se2::identity()).norm() < 1e-12);
}

#[test]
fn a_start_elsewhere_moves_the_answer_and_nothing_else() {
    let map_from_start = Se2::new(-3.0, 4.0, 1.2);
    let (_, here, _) = drive(3, Se2::identity());
    let (_, there, _) = drive(3, map_from_start);
    assert!(error_of(&there, map_from_start * here.estimate().map_from_robot).norm() < 1e-6);
    let turn = nalgebra::Rotation2::new(1.2).matrix().to_homogeneous();
    let turned = turn * here.estimate().covariance * turn.transpose();
    let difference = there.estimate().covariance - turned;
    assert!(difference.norm() < 1e-6 * turned.norm());
}

#[test]
fn an_outlier_is_left_out_and_the_next_scan_is_used() {
    let mut filter = start();
    let scan = |x| {
        Reading::ScanMatch(RelativePose {
            target_from_source: Se2::new(x, 0.0, 0.0),
            covariance: scan_covariance(),
            probability: 1.0,
        })
    };
    filter.add(1.0, &Reading::Odometry { left_m: 0.1, right_m: 0.1 }).unwrap();
    let before = filter.estimate();
    assert!(matches!(filter.add(1.0, &scan(0.9)).unwrap(), Verdict::Gated { .. }));
    assert_eq!(filter.estimate(), before);
    filter.add(2.0, &Reading::Odometry { left_m: 0.1, right_m: 0.1 }).unwrap();
    assert!(matches!(filter.add(2.0, &scan(0.1)).unwrap(), Verdict::Used { .. }));
}

#[test]
fn after_a_scan_without_a_match_the_next_counts_from_there() {
    let mut filter = start();
    let odometry = Reading::Odometry { left_m: 0.1, right_m: 0.1 };
    let scan = Reading::ScanMatch(RelativePose {
        target_from_source: Se2::new(0.1, 0.0, 0.0),
        covariance: scan_covariance(),
        probability: 1.0,
    });
    filter.add(1.0, &odometry).unwrap();
    assert_eq!(filter.add(1.0, &Reading::UnmatchedScan).unwrap(), Verdict::Predicted);
    filter.add(2.0, &odometry).unwrap();
    let Verdict::Used { distance_sq } = filter.add(2.0, &scan).unwrap() else { panic!() };
    assert!(distance_sq < 1e-9, "{distance_sq}");
}

#[test]
fn what_cannot_be_meant_is_an_error_and_leaves_the_filter_as_it_was() {
    let mut filter = start();
    filter.add(1.0, &Reading::Odometry { left_m: 0.1, right_m: 0.1 }).unwrap();
    let before = filter.estimate();
    let still = Reading::Imu { yaw_rate: 0.0 };
    assert!(matches!(filter.add(0.5, &still), Err(EkfError::TimeGoesBack { .. })));
    let limit = EkfParams::default().max_gap_s;
    assert!(filter.clone().add(1.0 + limit, &still).is_ok());
    let gap = limit + 0.5;
    assert_eq!(filter.add(1.0 + gap, &still), Err(EkfError::Gap { gap, limit }));
    assert!(matches!(filter.add(f64::NAN, &still), Err(EkfError::NonFiniteTime { .. })));
    for value in [f64::NAN, f64::INFINITY, 1e300] {
        let odometry = Reading::Odometry { left_m: value, right_m: 0.0 };
        assert!(filter.add(1.1, &odometry).is_err());
        assert!(filter.add(1.1, &Reading::Imu { yaw_rate: value }).is_err() || value == 1e300);
        let scan = RelativePose {
            target_from_source: Se2::identity(),
            covariance: Matrix3::from_diagonal_element(-value),
            probability: 1.0,
        };
        assert!(filter.add(1.1, &Reading::ScanMatch(scan)).is_err());
    }
    assert_eq!(filter.estimate().map_from_robot, before.map_from_robot);
    let params = EkfParams { track_m: 0.0, ..EkfParams::default() };
    assert!(Ekf::new(params, 0.0, Se2::identity(), Matrix3::zeros()).is_err());
}
