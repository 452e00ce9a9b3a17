//! What a deformation must do, against drift that is known.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use map_warp::{Motion, Warp, WarpError, WarpParams};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_core::Se2;
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn covariance(shift_m: f64, turn: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(shift_m.powi(2), shift_m.powi(2), turn.powi(2)))
}

fn fit(motions: &[Motion]) -> Warp {
    Warp::fit(motions, &WarpParams::default()).unwrap()
}

/// A corridor along x of 30 m that drift bent to the left, as an arc.
const CORRIDOR_M: f64 = 30.0;
const BEND_M: f64 = 0.6;

fn bent(place: Point2<f64>) -> Vector2<f64> {
    let along = place.x / CORRIDOR_M;
    let turn = turned(place);
    // The surroundings turn with the arc: a wall beside it is longer or shorter than its middle.
    Vector2::new(-turn * place.y, 4.0 * BEND_M * along * (1.0 - along))
}

fn turned(place: Point2<f64>) -> f64 {
    4.0 * BEND_M * (1.0 - 2.0 * place.x / CORRIDOR_M) / CORRIDOR_M
}

/// Patches on both sides of the corridor, measured with noise of 2 cm and 0.3°.
fn corridor(seed: u64) -> Vec<Motion> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = |sigma: f64| sigma * 3.0_f64.sqrt() * rng.random_range(-1.0..1.0);
    let places = (0..=10).flat_map(|i| [-1.5, 1.5].map(|y| Point2::new(3.0 * f64::from(i), y)));
    places
        .map(|at| Motion {
            at,
            shift: bent(at) + Vector2::new(noise(0.02), noise(0.02)),
            turn: turned(at) + noise(0.005),
            covariance: covariance(0.02, 0.005),
        })
        .collect()
}

fn worst_error(warp: &Warp) -> f64 {
    let places =
        (0..=60).flat_map(|i| [-1.5, 0.0, 1.5].map(|y| Point2::new(0.5 * f64::from(i), y)));
    places.map(|at| (warp.apply(at) - at - bent(at)).norm()).fold(0.0, f64::max)
}

#[test]
fn no_motions_move_nothing_and_leave_all_uncertain() {
    let warp = fit(&[]);
    let place = Point2::new(3.0, -4.0);
    assert_eq!(warp.apply(place), place);
    assert_eq!(warp.inverse(place), place);
    assert_eq!(warp.jacobian(place), nalgebra::Matrix2::identity());
    assert!((warp.sigma(place) - WarpParams::default().drift_sigma_m).abs() < 1e-12);
}

#[test]
fn a_rigid_motion_comes_back_exactly_however_far_it_turns() {
    for (x, y, theta) in [(3.0, -2.0, 0.3), (-40.0, 7.0, 3.1), (0.0, 0.0, -1.6)] {
        let truth_straight_from_map = Se2::new(x, y, theta);
        let motions: Vec<Motion> = [(0.0, 0.0), (8.0, 1.0), (3.0, 9.0), (-6.0, 4.0)]
            .map(|(x, y)| Point2::new(x, y))
            .map(|at| Motion {
                at,
                shift: truth_straight_from_map * at - at,
                turn: theta,
                covariance: covariance(0.03, 0.01),
            })
            .to_vec();
        let warp = fit(&motions);
        for place in [Point2::new(1.0, 2.0), Point2::new(50.0, -30.0)] {
            let error = (warp.apply(place) - truth_straight_from_map * place).norm();
            assert!(error < 1e-9, "{error}");
        }
    }
}

#[test]
fn a_bent_corridor_is_recovered_to_a_fifth_of_the_bend_everywhere() {
    for seed in 0..20 {
        let warp = fit(&corridor(seed));
        let worst = worst_error(&warp);
        assert!(worst < BEND_M / 5.0, "seed {seed}: {worst} m");
        assert!(warp.believed().iter().all(|&believed| believed), "seed {seed}");
    }
}

#[test]
fn patches_that_lie_do_not_matter() {
    for seed in 0..20 {
        let mut motions = corridor(seed);
        let mut rng = ChaCha8Rng::seed_from_u64(1_000 + seed);
        let liars = [1, 6, 11, 16, 20];
        for liar in liars {
            let direction: f64 = rng.random_range(-3.0..3.0);
            motions[liar].shift += Vector2::new(direction.cos(), direction.sin()) * 1.5;
            motions[liar].turn += rng.random_range(-0.3..0.3);
        }
        let warp = fit(&motions);
        let worst = worst_error(&warp);
        assert!(worst < BEND_M / 5.0, "seed {seed}: {worst} m");
        assert!(liars.iter().all(|&liar| !warp.believed()[liar]), "seed {seed}");
    }
}

#[test]
fn a_turned_frame_turns_the_deformation() {
    let turn_b_from_a = Se2::new(12.0, -7.0, 2.2);
    let motions = corridor(3);
    let turned: Vec<Motion> = motions
        .iter()
        .map(|motion| Motion {
            at: turn_b_from_a * motion.at,
            shift: turn_b_from_a * motion.shift,
            ..*motion
        })
        .collect();
    let (a, b) = (fit(&motions), fit(&turned));
    for place in [Point2::new(2.0, 1.0), Point2::new(17.0, -3.0), Point2::new(40.0, 9.0)] {
        let there = turn_b_from_a * place;
        assert!((turn_b_from_a * a.apply(place) - b.apply(there)).norm() < 1e-8);
        assert!((a.sigma(place) - b.sigma(there)).abs() < 1e-8);
    }
}

#[test]
fn a_place_is_surer_the_nearer_a_patch_and_errs_no_more_than_it_says() {
    let near = fit(&corridor(0)).sigma(Point2::new(15.0, 0.0));
    let far = fit(&corridor(0)).sigma(Point2::new(15.0, 30.0));
    assert!(near < 0.05 && far > 0.29, "{near} {far}");
    let places = (0..30).map(|i| Point2::new(f64::from(i) + 0.5, 0.0));
    let squares: Vec<f64> = places
        .flat_map(|at| (0..20).map(move |seed| (at, seed)))
        .map(|(at, seed)| {
            let warp = fit(&corridor(seed));
            ((warp.apply(at) - at - bent(at)).norm() / warp.sigma(at)).powi(2)
        })
        .collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!((0.2..6.0).contains(&mean), "normalised square of the error {mean}");
}

#[test]
fn the_jacobian_is_the_derivative() {
    let params = WarpParams { detail_sigma_m: 0.1, ..WarpParams::default() };
    let warp = Warp::fit(&corridor(5), &params).unwrap();
    let (at, step) = (Point2::new(7.0, 2.0), 1e-5);
    for axis in [Vector2::x(), Vector2::y()] {
        let change = warp.apply(at + axis * step) - warp.apply(at - axis * step);
        assert!((change / (2.0 * step) - warp.jacobian(at) * axis).norm() < 1e-7);
    }
}

#[test]
fn walls_of_one_room_are_displaced_apart_by_detail_alone() {
    let apart = |y: f64| Motion {
        at: Point2::new(12.0, y),
        shift: Vector2::new(0.0, 0.03 * (y - 2.0)),
        turn: 0.0,
        covariance: covariance(0.01, 0.1),
    };
    let walls = [apart(0.0), apart(4.0)];
    let around =
        (0..4).map(|i| Motion { shift: Vector2::zeros(), ..apart(2.0 + 8.0 * f64::from(i)) });
    let motions: Vec<Motion> = walls.into_iter().chain(around).collect();
    let error = |detail_sigma_m: f64| {
        let params = WarpParams { correlation_m: 12.0, detail_sigma_m, ..WarpParams::default() };
        let warp = Warp::fit(&motions, &params).unwrap();
        let off = |wall: &Motion| (warp.apply(wall.at) - wall.at - wall.shift).norm();
        walls.iter().map(off).fold(0.0, f64::max)
    };
    assert!(error(0.05) < 0.012 && error(0.0) > 0.024, "{} {}", error(0.05), error(0.0));
}

#[test]
fn motions_that_cannot_be_meant_are_errors_that_say_which() {
    let good = corridor(0)[0];
    let broken = |motion: Motion| Warp::fit(&[good, motion], &WarpParams::default()).unwrap_err();
    let nan = broken(Motion { turn: f64::NAN, ..good });
    assert_eq!(nan, WarpError::NonFinite { motion: 1 });
    let negative = broken(Motion { covariance: -good.covariance, ..good });
    assert!(matches!(negative, WarpError::BadCovariance { motion: 1, .. }), "{negative}");
    let far = broken(Motion { at: Point2::new(1e9, 0.0), ..good });
    assert!(matches!(far, WarpError::TooFar { motion: 1, .. }), "{far}");
    let many = Warp::fit(&vec![good; 501], &WarpParams::default()).unwrap_err();
    assert!(matches!(many, WarpError::TooManyMotions { have: 501, .. }), "{many}");
    let params = WarpParams { correlation_m: 0.0, ..WarpParams::default() };
    assert!(matches!(Warp::fit(&[good], &params), Err(WarpError::Parameter(_))));
    let params = WarpParams { detail_sigma_m: f64::NAN, ..WarpParams::default() };
    assert!(matches!(Warp::fit(&[good], &params), Err(WarpError::Parameter(_))));
}

fn any_motion() -> impl Strategy<Value = Motion> {
    let place = (-15.0..15.0, -15.0..15.0);
    let motion = (-2.0..2.0, -2.0..2.0, -0.8..0.8);
    (place, motion, -3.0..0.0, -3.0..0.0).prop_map(|(at, (x, y, turn), shift_sigma, turn_sigma)| {
        let sigma = |exponent: f64| 10.0_f64.powf(exponent);
        Motion {
            at: Point2::new(at.0, at.1),
            shift: Vector2::new(x, y),
            turn,
            covariance: covariance(sigma(shift_sigma), sigma(turn_sigma)),
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn nothing_folds_and_the_way_back_leads_back(
        motions in prop::collection::vec(any_motion(), 0..16),
        drift_sigma_m in 0.05..3.0,
        correlation_m in 0.5..8.0,
        detail in prop_oneof![Just((0.0, 2.0)), (0.01..0.5, 0.5..3.0)],
        // Above any misfit: lies that tear at each other are kept.
        outlier_sigmas in prop_oneof![Just(4.0), Just(1e9)],
    ) {
        let (detail_sigma_m, detail_m) = detail;
        let params =
            WarpParams { drift_sigma_m, correlation_m, detail_sigma_m, detail_m, outlier_sigmas };
        let warp = Warp::fit(&motions, &params).unwrap();
        let between = motions.windows(2).map(|pair| nalgebra::center(&pair[0].at, &pair[1].at));
        let lattice = (0..100).map(|i| {
            Point2::new(f64::from(i % 10) * 3.7 - 17.0, f64::from(i / 10) * 3.7 - 17.0)
        });
        for place in motions.iter().map(|motion| motion.at).chain(between).chain(lattice) {
            let determinant = warp.jacobian(place).determinant();
            prop_assert!(determinant >= 0.04 - 1e-9, "{place}: det J = {determinant}");
            let back = warp.inverse(warp.apply(place));
            prop_assert!((back - place).norm() < 1e-9, "{place} came back to {back}");
            let there = warp.apply(warp.inverse(place));
            prop_assert!((there - place).norm() < 1e-9, "{place} led to {there}");
        }
    }
}
