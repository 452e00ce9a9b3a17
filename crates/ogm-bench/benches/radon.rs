//! What the blocks of radon-merge cost on a map of 700 × 600 cells.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use ogm_core::{ClassThresholds, l2_distance_sq};
use ogm_sim::{FloorPlan, MappingParams, PairParams, survey};
use radon_merge::{EdgeParams, detect_edges, radon, smooth_edges};

fn blocks(criterion: &mut Criterion) {
    let mapping = MappingParams { resolution: 0.02, ..MappingParams::default() };
    let params = PairParams { seed: 1, mapping, ..PairParams::default() };
    let map = survey(&FloorPlan::plan_a(), 0.0, &params).expect("plan A can be explored").map;
    let thresholds = ClassThresholds::default();
    let walls = map.occupied_points(&thresholds);
    let edges = detect_edges(&map, &thresholds, &EdgeParams::default()).expect("valid parameters");
    let mask = map.occupied_mask(&thresholds);

    let mut group = criterion.benchmark_group(format!("700x600, {} walls", walls.len()));
    group.sample_size(20);
    let degree = 1.0_f64.to_radians();
    group.bench_function("radon, 180 angles", |b| {
        b.iter(|| radon(black_box(&walls), 0.02, degree));
    });
    group.bench_function("radon, 720 angles", |b| {
        b.iter(|| radon(black_box(&walls), 0.02, degree / 4.0));
    });
    group.bench_function("canny", |b| {
        b.iter(|| detect_edges(black_box(&map), &thresholds, &EdgeParams::default()));
    });
    group.bench_function("edge smoothing", |b| b.iter(|| smooth_edges(black_box(&edges), 7)));
    group.bench_function("distance field", |b| {
        b.iter(|| l2_distance_sq(black_box(&mask)));
    });
    group.finish();
}

criterion_group!(benches, blocks);
criterion_main!(benches);
