//! What one look at a transform costs, beside the distance transform of its canvas.

use std::hint::black_box;

use carpin_walk::{DistanceParams, MapDistance, Objective};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use ogm_core::{ClassThresholds, Grid, OccupancyGrid, Se2, l1_distance};
use ogm_sim::{FloorPlan, PairParams, survey};

/// Plan A, 14 m wide, on so many columns.
fn floor(seed: u64, columns: f64) -> OccupancyGrid {
    let mut robots = PairParams { seed, ..PairParams::cb() };
    robots.mapping.resolution = 14.0 / columns;
    survey(&FloorPlan::plan_a(), 0.0, &robots).expect("plan A can be surveyed").map
}

/// The obstacles of a map in the middle of a canvas twice as wide and high.
fn canvas(map: &OccupancyGrid) -> Grid<bool> {
    let (width, height) = (2 * map.width(), 2 * map.height());
    let mask = map.occupied_mask(&ClassThresholds::default());
    let mut cells = Grid::filled(width, height, false).expect("a small grid");
    for (index, &set) in mask.indexed() {
        let (column, row) = (index.column + map.width() / 2, index.row + map.height() / 2);
        cells.cells_mut()[row * width + column] = set;
    }
    cells
}

fn psi(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("psi");
    group.sample_size(20).measurement_time(std::time::Duration::from_secs(1));
    group.warm_up_time(std::time::Duration::from_millis(300));
    for columns in [50.0, 100.0, 200.0, 400.0] {
        let (target, source) = (floor(1, columns), floor(2, columns));
        let label = format!("{} x {}", target.width(), target.height());
        let cells = target.cells().cells().len() as u64;
        group.throughput(Throughput::Elements(cells));
        let target_from_source = Se2::new(0.7, -0.4, 0.4);
        let overlap = Objective::Overlap { min_share: 0.25 };
        for (name, objective) in [("picture", Objective::Picture), ("overlap", overlap)] {
            let params = DistanceParams { objective, ..DistanceParams::default() };
            let mut distance =
                MapDistance::new(&target, &source, &params).expect("maps of one resolution");
            group.bench_function(BenchmarkId::new(name, &label), |bencher| {
                bencher.iter(|| distance.psi(black_box(&target_from_source)));
            });
        }
        let canvas = canvas(&source);
        group.bench_function(BenchmarkId::new("l1 transform of the canvas", &label), |bencher| {
            bencher.iter(|| l1_distance(black_box(&canvas)));
        });
    }
    group.finish();
}

criterion_group!(benches, psi);
criterion_main!(benches);
