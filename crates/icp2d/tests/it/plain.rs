//! Plain points, noise, outliers, and what is said about the answer.

use icp2d::{
    Alignment, IcpError, IcpParams, Kernel, Metric, Pairing, Target, Termination, WallPoints,
    align, align_points, align_to, correspondences,
};
use nalgebra::{Point2, Vector2, Vector3};
use ogm_core::{Length, Refusal, Se2};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use crate::walls::{distance, floor, found, in_cells, moved, room, set};

fn truth() -> Se2 {
    Se2::new(1.2, -0.7, 0.4)
}

/// What a scanner returns of a room of 8 × 6 m and a pillar, in the frame that `truth` maps into
/// it: `count` points anywhere on the walls, with `noise` metres.
fn scan(count: usize, noise: f64, seed: u64, frame_from_room: Se2) -> Vec<Point2<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let noise = Normal::new(0.0, noise).unwrap();
    let points = (0..count).map(|_| {
        let at: f64 = random.random_range(0.0..32.0);
        let on_wall = match at {
            at if at < 8.0 => [at, 0.0],
            at if at < 14.0 => [8.0, at - 8.0],
            at if at < 22.0 => [at - 14.0, 6.0],
            at if at < 28.0 => [0.0, at - 22.0],
            at if at < 30.0 => [2.0 + 0.5 * (at - 28.0), 2.0],
            at => [2.0, 2.0 + 0.5 * (at - 30.0)],
        };
        let off = Vector2::from_fn(|_, _| noise.sample(&mut random));
        frame_from_room * (Point2::from(on_wall) + off)
    });
    points.collect()
}

/// The start, 0.15 m and 2° off.
fn start() -> Se2 {
    Se2::about(Point2::new(4.0, 3.0), 0.035, Vector2::new(0.12, -0.09)) * truth()
}

/// How far the ends of the room come to lie off, metres.
fn error(alignment: &Alignment) -> f64 {
    let ends = [[0.0, 0.0], [8.0, 0.0], [0.0, 6.0], [8.0, 6.0]];
    let off = ends.map(|[x, y]| {
        let in_source = truth().inverse() * Point2::new(x, y);
        (alignment.target_from_source * in_source - Point2::new(x, y)).norm()
    });
    off.into_iter().fold(0.0, f64::max)
}

#[test]
fn plain_points_align_without_a_word_about_their_spacing() {
    let target = scan(1500, 0.0, 1, Se2::identity());
    let source = scan(900, 0.0, 2, truth().inverse());
    let params = IcpParams::default();
    let found = found(align_points(&target, &source, start(), &params).unwrap());
    assert!(found.termination.is_converged(), "{found:?}");
    assert!(error(&found) < 1e-3, "{found:?}");
    assert!(found.inlier_ratio > 0.3 && found.inlier_ratio <= 1.0, "{found:?}");

    let nowhere = [Point2::new(f64::NAN, 0.0)];
    let refused = align_points(&nowhere, &source, start(), &params).unwrap_err();
    assert!(matches!(refused, IcpError::InvalidPoint { index: 0, .. }));
    let none = align_points(&[], &source, start(), &params).unwrap();
    assert_eq!(none.refusal(), Some(&Refusal::TooLittleStructure { have: 0, need: 10 }));
}

#[test]
fn a_shared_lattice_does_not_hold_the_default() {
    let room = set(room(40, 160));
    let found = found(align(&room, &room, Se2::new(0.0, 6.0, 0.0), &in_cells()).unwrap());
    assert!(distance(found.target_from_source, Se2::identity()) < 1e-6, "{found:?}");
}

#[test]
fn a_spacing_that_is_stated_too_small_changes_no_answer() {
    for spacing in [1.0, 0.1] {
        let walls = WallPoints::from_points(floor(), spacing).unwrap();
        // Lengths that do not follow the spacing.
        let params = IcpParams {
            initial_correspondence_distance: Length::metres(25.0),
            max_correspondence_distance: Length::metres(5.0),
            reciprocity: Length::metres(1.5),
            max_translation: Length::metres(50.0),
            section_margin: Length::metres(25.0),
            ..IcpParams::default()
        };
        let start = Se2::about(Point2::new(100.0, 80.0), 0.02, Vector2::new(3.0, -4.0));
        let found = found(align(&walls, &walls, start, &params).unwrap());
        assert!(distance(found.target_from_source, Se2::identity()) < 1e-6, "{spacing}: {found:?}");
    }
}

#[test]
fn a_robust_kernel_keeps_what_was_moved_from_pulling() {
    let target = scan(3000, 0.002, 3, Se2::identity());
    let mut source = scan(2000, 0.002, 4, truth().inverse());
    // One wall in five stands 8 cm further in.
    for point in &mut source {
        let in_room = truth() * *point;
        if in_room.y > 5.9 {
            *point = truth().inverse() * (in_room - Vector2::new(0.0, 0.08));
        }
    }
    let off = |kernel| {
        let params = IcpParams { pairing: Pairing::OneWay, kernel, ..IcpParams::default() };
        error(&found(align_points(&target, &source, start(), &params).unwrap()))
    };
    let plain = off(Kernel::None);
    assert!(plain > 0.02, "the test must be able to fail: {plain}");
    assert!(off(Kernel::Huber(Length::metres(0.01))) < 0.5 * plain);
    let cauchy = off(Kernel::Cauchy(Length::metres(0.01)));
    assert!(cauchy < 0.2 * plain, "{cauchy} of {plain}");
}

#[test]
fn the_covariance_is_that_of_the_errors() {
    let runs = 60;
    let target = scan(4000, 0.0, 5, Se2::identity());
    let target = Target::new(WallPoints::from_positions(&target).unwrap());
    let params = IcpParams { pairing: Pairing::OneWay, ..IcpParams::default() };
    let mut nees = 0.0;
    for seed in 0..runs {
        let source = scan(600, 0.01, 100 + seed, truth().inverse());
        let source = WallPoints::from_positions(&source).unwrap();
        let found = found(align_to(&target, &source, start(), &params).unwrap());
        let off = Vector3::new(
            found.target_from_source.x() - truth().x(),
            found.target_from_source.y() - truth().y(),
            found.target_from_source.theta() - truth().theta(),
        );
        nees += (off.transpose() * found.covariance.unwrap().try_inverse().unwrap() * off)[0];
    }
    // χ² with 180 degrees of freedom over 60: 2.4 to 3.6 in 95 of 100.
    let mean = nees / runs as f64;
    assert!((2.2..3.9).contains(&mean), "{mean} where 3 is expected");
}

#[test]
fn an_index_that_is_kept_gives_the_same_answer_as_a_fresh_one() {
    let target = set(floor());
    let start = Se2::new(2.0, -1.0, 0.01);
    let fresh = found(align(&target, &target, start, &in_cells()).unwrap());
    let kept = Target::new(target.clone());
    let kept = found(align_to(&kept, &target, start, &in_cells()).unwrap());
    assert!(distance(fresh.target_from_source, kept.target_from_source) < 1e-9);
    assert_eq!(fresh.correspondences, kept.correspondences);
    assert_eq!(kept.inlier_ratio, 1.0);
}

#[test]
fn correspondences_name_the_points_by_their_places() {
    let target = set(floor());
    let pose = Se2::new(0.05, 0.0, 0.0);
    let source = set(moved(&floor(), pose.inverse()));
    let count = floor().len();
    let target = Target::new(target);
    let all = correspondences(&target, &source, pose, &in_cells()).unwrap();
    assert_eq!(all.len(), count);
    assert!(all.iter().all(|pair| pair.source == pair.target && pair.distance < 1e-12));
    assert_eq!(target.points().points().len(), count);
    let far = Se2::new(1000.0, 0.0, 0.0);
    assert!(correspondences(&target, &source, far, &in_cells()).unwrap().is_empty());
}

#[test]
fn a_fit_that_got_worse_gives_back_its_start() {
    // The row pairs exactly; a second one, a metre beside it, pulls only while it is in reach.
    let row = |y: f64, count: u32| (0..count).map(move |i| Point2::new(f64::from(i), y));
    let target: Vec<_> = row(0.0, 60).collect();
    let source: Vec<_> = row(0.0, 60).chain(row(1.0, 40)).collect();
    let params = IcpParams {
        initial_correspondence_distance: Length::metres(30.0),
        max_correspondence_distance: Length::metres(0.5),
        section_margin: Length::metres(2.0),
        max_translation: Length::metres(100.0),
        pairing: Pairing::OneWay,
        metric: Metric::PointToPoint,
        min_eigenvalue_ratio: 0.0,
        max_iterations: 1,
        ..IcpParams::default()
    };
    let found = found(align_points(&target, &source, Se2::identity(), &params).unwrap());
    let Termination::WorseFit { rmse } = found.termination else { panic!("{found:?}") };
    assert!(rmse > 0.01, "{rmse}");
    assert_eq!(found.target_from_source, Se2::identity());
    assert_eq!(found.rmse, 0.0);
}
