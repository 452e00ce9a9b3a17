//! Distances from every cell of a map to its nearest wall.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use ogm_bench::{maps, settings};
use ogm_core::{ClassThresholds, l1_distance, l2_distance_sq};

fn distances(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("distance");
    for (name, map) in &maps() {
        let walls = map.occupied_mask(&ClassThresholds::default());
        group.throughput(Throughput::Elements(walls.cells().len() as u64));
        group.bench_function(BenchmarkId::new("l1", name), |bencher| {
            bencher.iter(|| l1_distance(black_box(&walls)));
        });
        group.bench_function(BenchmarkId::new("l2 squared", name), |bencher| {
            bencher.iter(|| l2_distance_sq(black_box(&walls)));
        });
    }
    group.finish();
}

criterion_group! { name = benches; config = settings(); targets = distances }
criterion_main!(benches);
