//! Two maps of one building laid over each other by their walls.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use icp2d::{IcpParams, StartParams, WallPoints, align, search_start};
use nalgebra::{Point2, Vector2};
use ogm_bench::{plan_a, settings};
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Se2};

/// Metres a cell, so that a map has about 20 000 wall points.
const RESOLUTION: f64 = 0.017;

/// Heading of the source map in the target's, radians.
const HEADING: f64 = 0.5;

fn wall_points(map: &OccupancyGrid) -> WallPoints {
    WallPoints::from_grid(map, &ClassThresholds::default()).expect("a map has wall points")
}

fn icp(criterion: &mut Criterion) {
    let maps = [(0.0, 1), (HEADING, 2)].map(|(heading, seed)| plan_a(RESOLUTION, heading, seed));
    let [target, source] = maps.each_ref().map(wall_points);
    for walls in [&target, &source] {
        let count = walls.points().len();
        assert!((18_000..22_000).contains(&count), "{count} wall points");
    }
    let true_target_from_source = Se2::new(0.0, 0.0, HEADING);
    // 1° about the middle of the building and some 12 cm off.
    let middle = Point2::new(7.0, 6.0);
    let start_target_from_source =
        Se2::about(middle, 1_f64.to_radians(), Vector2::new(0.1, -0.06)) * true_target_from_source;
    let aligned = |target: &WallPoints, source: &WallPoints| {
        align(target, source, start_target_from_source, &IcpParams::default())
    };
    let found = aligned(&target, &source).ok().and_then(Outcome::found).expect("the maps overlap");
    let error = found.target_from_source.between(&true_target_from_source);
    assert!(error.translation().norm() < 0.01 && error.theta().abs() < 1e-3, "{found:?}");

    let mut group = criterion.benchmark_group("icp");
    group.bench_function("wall points", |bencher| {
        bencher.iter(|| wall_points(black_box(&maps[0])));
    });
    group.bench_function("align", |bencher| {
        bencher.iter(|| aligned(black_box(&target), &source));
    });
    group.bench_function("wall points and align", |bencher| {
        bencher.iter(|| {
            let [target, source] = black_box(&maps).each_ref().map(wall_points);
            aligned(&target, &source)
        });
    });
    group.bench_function("search start", |bencher| {
        bencher.iter(|| {
            let params = StartParams::default();
            search_start(black_box(&target), &source, start_target_from_source, &params)
        });
    });
    group.finish();
}

criterion_group! { name = benches; config = settings(); targets = icp }
criterion_main!(benches);
