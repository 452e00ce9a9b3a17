//! What it costs to match two maps, and to refuse to.
#![expect(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use criterion::{Criterion, criterion_group, criterion_main};
use grid_match::{MatchParams, PreparedMap, match_maps, match_prepared};
use ogm_sim::{FloorPlan, MappingParams, PairParams, SimulatedPair, simulate_pair};
use std::hint::black_box;

fn explored(plan: &FloorPlan, seed: u64, resolution: f64) -> SimulatedPair {
    let mapping = MappingParams { resolution, ..MappingParams::default() };
    let world = PairParams { seed, mapping, ..PairParams::default() };
    simulate_pair(plan, &world).unwrap()
}

fn grid_match(criterion: &mut Criterion) {
    let params = MatchParams::default();
    let fine = explored(&FloorPlan::plan_a(), 1, 0.02);
    let usual = explored(&FloorPlan::random(1).unwrap(), 1, 0.05);
    let elsewhere = explored(&FloorPlan::random(2).unwrap(), 2, 0.05);
    let mut group = criterion.benchmark_group("grid_match");
    group.sample_size(10);
    for (name, target, source) in [
        ("one_floor_5cm", &usual.target.map, &usual.source.map),
        ("one_floor_2cm", &fine.target.map, &fine.source.map),
        ("two_floors_5cm_refused", &usual.target.map, &elsewhere.source.map),
    ] {
        group.bench_function(name, |bencher| {
            bencher
                .iter(|| match_maps(black_box(target), black_box(source), &params, &()).unwrap());
        });
    }
    let prepare = |map| PreparedMap::new(map, &params.thresholds, &()).unwrap();
    group.bench_function("prepare_2cm", |bencher| {
        bencher.iter(|| prepare(black_box(&fine.target.map)));
    });
    let (target, source) = (prepare(&fine.target.map), prepare(&fine.source.map));
    group.bench_function("prepared_2cm", |bencher| {
        bencher
            .iter(|| match_prepared(black_box(&target), black_box(&source), &params, &()).unwrap());
    });
    group.finish();
}

criterion_group!(benches, grid_match);
criterion_main!(benches);
