//! What the tag filter does with input that cannot be meant, and with the oddest that can.

use nalgebra::Point2;
use proptest::prelude::{prop_assert, proptest};
use rfid_loc::{FilterParams, TagError, TagFilter};

fn corner() -> Point2<f64> {
    Point2::new(-3.0, -3.0)
}

#[test]
fn impossible_readings_are_errors_and_leave_the_filter_as_it_was() {
    let mut filter = TagFilter::new(corner(), &FilterParams::default()).unwrap();
    filter.update(Point2::new(1.0, 0.5), 0.8).unwrap();
    let before = filter.estimate(1.into());
    let here = Point2::origin();
    for range in [f64::NAN, f64::INFINITY, -0.01, 3.21] {
        let error = filter.update(here, range).unwrap_err();
        assert!(matches!(error, TagError::Range { .. }), "{range}: {error}");
    }
    for robot in [Point2::new(f64::NAN, 0.0), Point2::new(0.0, f64::INFINITY)] {
        let error = filter.update(robot, 1.0).unwrap_err();
        assert!(matches!(error, TagError::Position { .. }), "{robot}: {error}");
    }
    assert_eq!(filter.estimate(1.into()), before);
    filter.update(here, 3.19).unwrap();
}

#[test]
fn nothing_is_known_before_the_first_reading() {
    let filter = TagFilter::new(corner(), &FilterParams::default()).unwrap();
    assert_eq!((filter.readings(), filter.estimate(1.into())), (0, None));
}

#[test]
fn parameters_that_describe_no_filter_are_errors() {
    let good = FilterParams::default();
    for bad in [
        FilterParams { cell_size: 0.0, ..good },
        FilterParams { cell_size: f64::NAN, ..good },
        FilterParams { range_sigma: 0.0, ..good },
        FilterParams { range_sigma: f64::INFINITY, ..good },
        FilterParams { max_range: -1.0, ..good },
        FilterParams { max_range: f64::NAN, ..good },
        FilterParams { sub_sampling: 0, ..good },
        FilterParams { sub_sampling: 327, ..good },
        FilterParams { side_cells: 0, ..good },
    ] {
        for filter in [TagFilter::new(corner(), &bad), TagFilter::around(corner(), &bad)] {
            assert!(matches!(filter, Err(TagError::Parameter(_))), "{bad:?}");
        }
    }
    let huge = FilterParams { side_cells: 1_000_000, ..good };
    assert!(matches!(TagFilter::new(corner(), &huge), Err(TagError::Grid(_))));
    let nowhere = Point2::new(f64::NAN, 0.0);
    assert!(matches!(TagFilter::around(nowhere, &good), Err(TagError::Position { .. })));
}

proptest! {
    #[test]
    fn whatever_it_reads_the_posterior_is_a_distribution_and_the_tag_inside(
        readings in proptest::collection::vec(
            (-1e9_f64..1e9, -4.0_f64..4.0, 0.0_f64..3.2), 1..70),
        far in proptest::bool::ANY,
        sub_sampling in 1_usize..=20,
    ) {
        let params = FilterParams { side_cells: 20, cell_size: 0.3, sub_sampling, ..FilterParams::default() };
        let mut filter = TagFilter::new(corner(), &params).unwrap();
        for &(x, y, range) in &readings {
            let x = if far { x } else { x * 4e-9 };
            filter.update(Point2::new(x, y), range).unwrap();
        }
        let sum: f64 = filter.posterior().cells().iter().sum();
        prop_assert!((sum - 1.0).abs() < 1e-9, "{sum}");
        let estimate = filter.estimate(1.into()).unwrap();
        prop_assert!(estimate.certainty > 0.0 && estimate.certainty <= 1.0);
        let cells = filter.frame().cells_from_point(estimate.position);
        prop_assert!(cells.iter().all(|x| (-1e-9..20.0 + 1e-9).contains(x)), "{cells}");
        prop_assert!((0.0..=1.0).contains(&estimate.second_peak_ratio));
    }
}
