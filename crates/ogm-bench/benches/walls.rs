//! The direction of a building, from its map: lines, their vector, and both together.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use line_ransac::extract_segments;
use ogm_bench::{reference_map, settings};
use ogm_vector::ogm_vector;

fn walls(criterion: &mut Criterion) {
    let map = reference_map();
    let (lines, vector) = (line_ransac::Params::default(), ogm_vector::Params::default());
    let segments =
        extract_segments(&map, &lines).found().expect("plan A has straight walls").segments;

    let mut group = criterion.benchmark_group("walls");
    group.bench_function("lines", |bencher| {
        bencher.iter(|| extract_segments(black_box(&map), &lines));
    });
    group.bench_function("vector of lines", |bencher| {
        bencher.iter(|| ogm_vector(black_box(&segments), &vector));
    });
    group.bench_function("vector of map", |bencher| {
        bencher.iter(|| {
            extract_segments(black_box(&map), &lines)
                .found()
                .map(|extraction| ogm_vector(&extraction.segments, &vector))
        });
    });
    group.finish();
}

criterion_group! { name = benches; config = settings(); targets = walls }
criterion_main!(benches);
