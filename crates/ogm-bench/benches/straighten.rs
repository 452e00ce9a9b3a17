//! What it costs to make a large map straight, beside matching and fusing it.
#![expect(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use ogm_bench::{settings, tiled};
use ogm_core::{OccupancyGrid, Se2};
use ogm_merge::{
    AlignParams, BendParams, FusionParams, Method, RobotMap, align_pair, fuse, known_poses, unbend,
};
use ogm_sim::{FloorPlan, MappingParams, PairParams, survey};

/// 100 m a side at 0.05 m.
fn map(seed: u64) -> OccupancyGrid {
    let mapping = MappingParams { resolution: 0.05, ..MappingParams::default() };
    let robots = PairParams { seed, mapping, ..PairParams::default() };
    tiled(&survey(&FloorPlan::random(1).unwrap(), 0.0, &robots).unwrap().map, 2000)
}

fn straighten(criterion: &mut Criterion) {
    let (target, source) = (map(1), map(2));
    let pose = Se2::identity();
    let maps = [&target, &source];
    let robots = maps.map(RobotMap::from);
    let align = AlignParams::default();
    let component = known_poses(&robots, &[pose, pose], &align, &()).unwrap().component;
    let mut group = criterion.benchmark_group("straighten_2000x2000");
    group.sample_size(10);
    group.bench_function("match_and_fuse", |bencher| {
        bencher.iter(|| {
            let [target, source] = black_box(maps).map(RobotMap::from);
            align_pair(Method::Match, &target, &source, &align, &()).unwrap();
            fuse(&maps, &component, &FusionParams::default(), &()).unwrap()
        });
    });
    group.bench_function("unbend", |bencher| {
        let params = BendParams::default();
        bencher.iter(|| unbend(black_box(&target), &source, &pose, &params, &()).unwrap());
    });
    group.finish();
}

criterion_group!(name = benches; config = settings(); targets = straighten);
criterion_main!(benches);
