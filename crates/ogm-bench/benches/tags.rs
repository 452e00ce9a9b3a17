//! What a reading of a tag costs, and what it costs to ask where the tag is.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::Point2;
use ogm_bench::settings;
use rfid_loc::{FilterParams, TagFilter};

/// Exact ranges to a tag from a circle that passes it at half a metre.
fn readings() -> Vec<(Point2<f64>, f64)> {
    let tag = Point2::new(1.5, 0.4);
    let turn = (0..60).map(|step| f64::from(step) / 60.0 * TAU);
    turn.map(|angle| Point2::new(angle.cos(), angle.sin()))
        .map(|robot| (robot, (tag - robot).norm()))
        .collect()
}

fn tags(criterion: &mut Criterion) {
    let readings = readings();
    let mut filter = TagFilter::around(readings[0].0, &FilterParams::default())
        .expect("the default parameters describe a filter");
    let mut update = |&(robot, range): &(Point2<f64>, f64)| {
        filter.update(black_box(robot), black_box(range)).expect("the tag is in range");
    };
    readings.iter().for_each(&mut update);

    let mut next = readings.iter().cycle();
    criterion.bench_function("tags/update", |bencher| {
        bencher.iter(|| next.next().map(&mut update));
    });

    let mut filter = TagFilter::around(readings[0].0, &FilterParams::default())
        .expect("the default parameters describe a filter");
    for &(robot, range) in &readings {
        filter.update(robot, range).expect("the tag is in range");
    }
    criterion.bench_function("tags/estimate", |bencher| {
        bencher.iter(|| black_box(&filter).estimate(7.into()));
    });
}

criterion_group! { name = benches; config = settings(); targets = tags }
criterion_main!(benches);
