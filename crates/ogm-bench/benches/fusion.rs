//! A map turned by 30°, and two maps fused of which one is turned by 30°.

use std::f64::consts::FRAC_PI_6;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use grid_merge::{FusionParams, PlacedMap, merge};
use nalgebra::{Point2, Vector2};
use ogm_bench::{maps, settings};
use ogm_core::{Occupancy, OccupancyGrid, Se2, warp_nearest};

/// A turn by 30° about the middle of `map`.
fn target_from_turned(map: &OccupancyGrid) -> Se2 {
    let middle = Point2::new(map.width() as f64 / 2.0, map.height() as f64 / 2.0);
    Se2::about(map.frame().point_from_cells(middle), FRAC_PI_6, Vector2::zeros())
}

/// Nearest cell, onto the lattice of the map itself; the corners fall outside.
fn warp(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("warp");
    for (name, map) in &maps() {
        let (frame, size) = (map.frame(), (map.width(), map.height()));
        let target_from_source = target_from_turned(map);
        group.throughput(Throughput::Elements((size.0 * size.1) as u64));
        group.bench_function(*name, |bencher| {
            bencher.iter(|| {
                let (cells, outside) = (black_box(map.cells()), Occupancy::UNKNOWN);
                warp_nearest(cells, frame, frame, size, &target_from_source, outside)
                    .expect("a map of the same size")
            });
        });
    }
    group.finish();
}

/// The map and its turned self, onto the box that holds both.
fn warp_and_fuse(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("warp and fuse");
    for (name, map) in &maps() {
        let placed = [Se2::identity(), target_from_turned(map)]
            .map(|reference_from_map| PlacedMap::new(map, reference_from_map));
        group.throughput(Throughput::Elements((map.width() * map.height()) as u64));
        group.bench_function(*name, |bencher| {
            bencher.iter(|| {
                let merged = merge(black_box(&placed), &FusionParams::default(), &());
                merged.expect("the box of both is no larger than a grid may be")
            });
        });
    }
    group.finish();
}

criterion_group! { name = benches; config = settings(); targets = warp, warp_and_fuse }
criterion_main!(benches);
