//! How certainty grows with what the robot does: on a curve, in a line, standing still.

use nalgebra::{Point2, Vector2};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use rfid_loc::{FilterParams, TagFilter};

/// Mean sliding certainty and RMS distance in metres over six random tags near the path's start,
/// after each of `counts` readings, one every 3 cm.
fn outcomes<const N: usize>(path: fn(f64) -> Point2<f64>, counts: [u32; N]) -> [(f64, f64); N] {
    let noise = Normal::new(0.0, 0.05).expect("a finite sigma");
    let tags = 6;
    // The model is right here, and believed.
    let params = FilterParams { check_fit: false, ..FilterParams::default() };
    let mut sums = [(0.0, 0.0); N];
    for tag_id in 0..tags {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        random.set_stream(u64::from(tag_id));
        let bearing: f64 = random.random_range(0.3..2.8);
        let distance: f64 = random.random_range(0.5..2.0);
        let tag = path(0.45) + distance * Vector2::new(bearing.cos(), bearing.sin());
        let mut filter = TagFilter::around(path(0.0), &params).expect("usable parameters");
        let mut step = 0;
        for (sums, count) in sums.iter_mut().zip(counts) {
            while step < count {
                let robot = path(0.03 * f64::from(step));
                let range = (tag - robot).norm() + noise.sample(&mut random);
                filter.update(robot, range.clamp(0.0, 3.2)).expect("a usable reading");
                step += 1;
            }
            let estimate = filter.estimate(tag_id.into()).expect("readings");
            sums.0 += estimate.certainty;
            sums.1 += (estimate.position - tag).norm_squared();
        }
    }
    let tags = f64::from(tags);
    sums.map(|(certainty, error_sq)| (certainty / tags, (error_sq / tags).sqrt()))
}

/// A circle of 0.8 m, driven again and again.
fn curve(s: f64) -> Point2<f64> {
    Point2::new(0.8 * (s / 0.8).sin(), 0.8 - 0.8 * (s / 0.8).cos())
}

/// Three metres back and forth.
fn line(s: f64) -> Point2<f64> {
    Point2::new(1.5 - (s % 3.0 - 1.5).abs(), 0.0)
}

fn still(_: f64) -> Point2<f64> {
    Point2::origin()
}

#[test]
fn on_a_curve_certainty_grows_with_the_readings() {
    let [(at_30, _), (at_100, _), (at_300, error)] = outcomes(curve, [30, 100, 300]);
    assert!(at_30 + 0.05 < at_100 && at_100 < at_300, "{at_30} {at_100} {at_300}");
    assert!(at_100 > 0.75 && at_300 > 0.95, "{at_100} {at_300}");
    assert!(error < 0.02, "more than a cell: {error} m");
}

#[test]
fn in_a_line_certainty_stops_at_one_half() {
    let [(at_300, _)] = outcomes(line, [300]);
    assert!((0.45..0.55).contains(&at_300), "{at_300}");
}

#[test]
fn standing_still_leaves_a_ring() {
    let [(at_1, _), (at_30, _), (at_300, _)] = outcomes(still, [1, 30, 300]);
    assert!(at_1 < 0.02, "{at_1}");
    assert!(at_30 < at_300 && at_300 < 0.03, "{at_30} {at_300}");
}
