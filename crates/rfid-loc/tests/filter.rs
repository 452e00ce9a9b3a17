//! The tag filter against closed forms and an `f64` reference.

use nalgebra::{Point2, Vector2};
use ogm_core::Grid;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use rfid_loc::{FilterParams, Likelihood, PositionRule, TagFilter};

const SIGMA: f64 = 0.05;

fn corner() -> Point2<f64> {
    Point2::new(-3.0, -3.0)
}

/// The paper's measurement model, with the corrected reading of the posterior.
fn gaussian() -> FilterParams {
    let likelihood = Likelihood::Gaussian;
    FilterParams { side_cells: 300, likelihood, check_fit: false, ..FilterParams::default() }
}

fn noisy_circle(count: u32, tag: Point2<f64>, seed: u64) -> Vec<(Point2<f64>, f64)> {
    let noise = Normal::new(0.0, SIGMA).expect("a finite sigma");
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|step| {
            let angle = 0.03 * f64::from(step);
            let robot = Point2::new(angle.cos(), angle.sin());
            (robot, (tag - robot).norm() + noise.sample(&mut random))
        })
        .collect()
}

fn filtered(readings: &[(Point2<f64>, f64)], params: &FilterParams) -> TagFilter {
    let mut filter = TagFilter::new(corner(), params).expect("usable parameters");
    for &(robot, range) in readings {
        filter.update(robot, range).expect("a usable reading");
    }
    filter
}

/// The posterior of `filter` in double precision, cell by cell.
fn reference(filter: &TagFilter, readings: &[(Point2<f64>, f64)]) -> Grid<f64> {
    let mut grid = filter.posterior();
    for position in 0..grid.cells().len() {
        let centre = filter.frame().cell_centre(grid.index_of(position));
        let residuals =
            readings.iter().map(|&(robot, range)| ((centre - robot).norm() - range) / SIGMA);
        grid.cells_mut()[position] =
            -0.5 * residuals.map(|residual| residual * residual).sum::<f64>();
    }
    let largest = grid.cells().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let weights = grid.map(|cell| (cell - largest).exp());
    let sum: f64 = weights.cells().iter().sum();
    weights.map(|weight| weight / sum)
}

fn largest_difference(a: &Grid<f64>, b: &Grid<f64>) -> f64 {
    let differences = a.cells().iter().zip(b.cells()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

#[test]
fn t_r1_four_corners_locate_a_tag_in_its_cell() {
    let tag = Point2::new(1.01, 0.73);
    let lower_left = Point2::new(-2.0, -2.0);
    let mut filter = TagFilter::new(lower_left, &gaussian()).unwrap();
    let mut repeats = 0;
    for (until, certainty) in [(1, 0.3721), (5, 0.9175), (10, 0.9952)] {
        while repeats < until {
            for (x, y) in [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)] {
                let robot = Point2::new(x, y);
                filter.update(robot, (tag - robot).norm()).unwrap();
            }
            repeats += 1;
        }
        let estimate = filter.estimate(1.into()).unwrap();
        assert!((estimate.mode - tag).norm() < 1e-9, "{}", estimate.mode);
        assert!((estimate.position - tag).norm() < 1e-3, "{}", estimate.position);
        let error = (estimate.certainty - certainty).abs();
        assert!(error < 0.0005, "{repeats}: {}", estimate.certainty);
    }
}

#[test]
fn t_r2_three_thousand_readings_underflow_the_product_and_not_the_filter() {
    let params = FilterParams { side_cells: 150, cell_size: 0.04, ..gaussian() };
    let tag = Point2::new(0.5, -0.4);
    let readings = noisy_circle(3000, tag, 2);
    let filter = filtered(&readings, &params);
    let posterior = filter.posterior();
    let sum: f64 = posterior.cells().iter().sum();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    assert!(posterior.cells().iter().all(|mass| mass.is_finite()));
    let error = (filter.estimate(1.into()).unwrap().position - tag).norm();
    assert!(error < 0.03, "more than half a diagonal of a cell: {error}");

    // Where the product is largest, and all around.
    for offset in 0..441 {
        let (dx, dy) = (offset % 21 - 10, offset / 21 - 10);
        let place = tag + 0.01 * Vector2::new(f64::from(dx), f64::from(dy));
        let factors = readings.iter().map(|&(robot, range)| {
            let residual = ((place - robot).norm() - range) / SIGMA;
            (-residual * residual / 2.0).exp()
        });
        assert_eq!(factors.product::<f64>(), 0.0, "at {place}");
    }
}

#[test]
fn t_r3_a_straight_path_leaves_two_mirror_images() {
    let noise = Normal::new(0.0, SIGMA).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let tag = Point2::new(0.4, 1.1);
    // The line y = 0 lies between two rows of cells, so each cell has a mirror cell.
    let readings: Vec<_> = (0..300)
        .map(|step| Point2::new(-1.5 + 0.01 * f64::from(step), 0.0))
        .map(|robot| (robot, (tag - robot).norm() + noise.sample(&mut random)))
        .collect();
    let filter = filtered(&readings, &gaussian());
    let estimate = filter.estimate(1.into()).unwrap();
    assert!(estimate.certainty < 0.55, "{}", estimate.certainty);
    assert!(estimate.second_peak_ratio > 0.99, "{}", estimate.second_peak_ratio);
    let mirrored = Point2::new(estimate.position.x, estimate.position.y.abs());
    assert!((mirrored - tag).norm() < 0.02, "{mirrored}");

    let posterior = filter.posterior();
    let upside_down: Vec<f64> = posterior.rows().rev().flatten().copied().collect();
    let upside_down = Grid::new(posterior.width(), posterior.height(), upside_down).unwrap();
    assert!(largest_difference(&posterior, &upside_down) < 1e-4);
}

#[test]
fn single_precision_sums_agree_with_double_ones() {
    let params = FilterParams { side_cells: 40, ..gaussian() };
    let tag = Point2::new(0.3, 0.2);
    for count in [300, 2000] {
        // Offsets of three sigma either way make the costs ten times larger.
        for offset in [0.0, 0.15] {
            let mut readings = noisy_circle(count, tag, 5);
            let signs = [1.0, -1.0].into_iter().cycle();
            for (reading, sign) in readings.iter_mut().zip(signs) {
                reading.1 += sign * offset;
            }
            let mut filter = TagFilter::new(Point2::new(-0.1, -0.2), &params).unwrap();
            for &(robot, range) in &readings {
                filter.update(robot, range).unwrap();
            }
            let reference = reference(&filter, &readings);
            let difference = largest_difference(&filter.posterior(), &reference);
            assert!(difference < 1e-4, "{count}, {offset}: {difference}");
        }
    }
}

#[test]
fn far_from_the_map_origin_a_tag_is_found_as_precisely() {
    let params = FilterParams::default();
    let readings = noisy_circle(100, Point2::new(0.7, 0.5), 8);
    let near = filtered(&readings, &params).estimate(1.into()).unwrap();
    let shift = Vector2::new(2e5, -7e5);
    let mut filter = TagFilter::new(corner() + shift, &params).unwrap();
    for &(robot, range) in &readings {
        filter.update(robot + shift, range).unwrap();
    }
    let far = filter.estimate(1.into()).unwrap();
    assert!((far.position - shift - near.position).norm() < 1e-6);
    assert!((far.certainty - near.certainty).abs() < 1e-6);
}

#[test]
fn around_aligns_the_area_to_the_map() {
    let params = FilterParams::default();
    for (x, y) in [(0.0, 0.0), (1.237, -8.881), (-0.001, 12.019)] {
        let robot = Point2::new(x, y);
        let frame = TagFilter::around(robot, &params).unwrap().frame();
        assert_eq!(frame.lattice_cell(robot), [163, 163]);
        let corner = frame.map_from_grid().translation() / params.cell_size;
        assert!((corner - corner.map(f64::round)).norm() < 1e-9, "{corner}");
    }
}

#[test]
fn a_tag_first_read_straight_ahead_at_the_longest_range_lies_inside() {
    for (max_range, sigma) in [(3.0, 0.05), (8.0, 0.1), (20.0, 0.5)] {
        let params = FilterParams::for_reader(max_range, sigma);
        let noise = Normal::new(0.0, sigma).unwrap();
        for (seed, ahead) in [(1, Vector2::x()), (2, -Vector2::x()), (3, Vector2::y())] {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let tag = Point2::origin() + max_range * ahead;
            let mut filter = TagFilter::around(Point2::origin(), &params).unwrap();
            // A bow towards the tag, so that it is told from its mirror image.
            for step in 0..150 {
                let way = max_range / 150.0 * f64::from(step);
                let bow =
                    Vector2::new(-ahead.y, ahead.x) * 0.5 * max_range * (way / max_range).sin();
                let robot = Point2::origin() + way * ahead + bow;
                let read = (tag - robot).norm() + noise.sample(&mut random);
                let limit = max_range + 4.0 * sigma;
                filter.update(robot, read.clamp(0.0, limit)).unwrap();
            }
            let estimate = filter.estimate(1.into()).unwrap();
            assert!(!estimate.touches_border, "{max_range} m: {estimate:?}");
            assert!((estimate.position - tag).norm() < 2.0 * params.cell_size, "{estimate:?}");
        }
    }
    let robot = Point2::origin();
    let frame = TagFilter::around(robot, &FilterParams::paper()).unwrap().frame();
    assert_eq!(frame.lattice_cell(robot), [150, 150], "the paper's 3 m end on the border");
}

#[test]
fn the_mode_is_a_cell_centre_and_the_paper_reports_it() {
    let readings = noisy_circle(200, Point2::new(0.7, 0.5), 4);
    let filter = filtered(&readings, &gaussian());
    let estimate = filter.estimate(1.into()).unwrap();
    let cells = filter.frame().cells_from_point(estimate.mode);
    assert!((cells - cells.map(|x| x.floor() + 0.5)).norm() < 1e-6);

    let printed = filtered(&readings, &FilterParams::paper()).estimate(1.into()).unwrap();
    assert_eq!(FilterParams::paper().position, PositionRule::Mode);
    assert_eq!((printed.position, printed.mode), (estimate.mode, estimate.mode));
    assert!(printed.certainty <= estimate.certainty);
}

#[test]
fn a_tag_outside_the_search_area_touches_its_border() {
    let params = FilterParams { side_cells: 150, ..FilterParams::default() };
    let lower_left = Point2::new(-1.5, -1.5);
    for (y, outside) in [(1.6, true), (1.45, false)] {
        let mut filter = TagFilter::new(lower_left, &params).unwrap();
        for (robot, range) in noisy_circle(120, Point2::new(0.0, y), 6) {
            filter.update(robot, range).unwrap();
        }
        let estimate = filter.estimate(1.into()).unwrap();
        assert_eq!(estimate.touches_border, outside, "{estimate:?}");
    }
}

#[test]
fn the_border_is_two_cells_wide() {
    let params = FilterParams { side_cells: 150, ..gaussian() };
    let lower_left = Point2::new(-1.5, -1.5);
    for (cells_inside, touches) in [(1.5, true), (2.5, false)] {
        let tag = Point2::new(0.01, 1.5 - cells_inside * params.cell_size);
        let mut filter = TagFilter::new(lower_left, &params).unwrap();
        for step in 0..120 {
            let angle = 0.05 * f64::from(step);
            let robot = Point2::new(angle.cos(), angle.sin());
            filter.update(robot, (tag - robot).norm()).unwrap();
        }
        let estimate = filter.estimate(1.into()).unwrap();
        assert!((estimate.mode - tag).norm() < 1e-6, "{estimate:?}");
        assert_eq!(estimate.touches_border, touches, "{cells_inside} cells");
    }
}
