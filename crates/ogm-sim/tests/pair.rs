//! What a simulated pair promises: exact truth, repeatability, and the building it is named after.

use nalgebra::Point2;
use ogm_core::{ClassThresholds, OccupancyGrid, Se2};
use ogm_sim::{
    DriftParams, FloorPlan, LidarParams, MappingParams, PairParams, RobotRun, SOURCE, SimError,
    SimulatedPair, TARGET, map_along_path, simulate_pair, survey,
};

/// Fewer beams and coarser cells than the default, for debug builds.
fn quick(seed: u64) -> PairParams {
    PairParams {
        seed,
        lidar: LidarParams { beams: 361, scan_every: 0.48, ..LidarParams::rf() },
        mapping: MappingParams { resolution: 0.04, ..MappingParams::default() },
        ..PairParams::default()
    }
}

fn quick_pair(seed: u64) -> SimulatedPair {
    simulate_pair(&FloorPlan::plan_a(), &quick(seed)).expect("plan A can be explored")
}

fn walls(map: &OccupancyGrid) -> Vec<Point2<f64>> {
    map.occupied_points(&ClassThresholds::default())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Median distance of occupied cells to the faces of the plan they are a map of, metres.
fn median_off_the_walls(plan: &FloorPlan, map: &OccupancyGrid, world_from_map: Se2) -> f64 {
    let distances = walls(map).into_iter().map(|p| plan.distance_to_face(world_from_map * p));
    median(distances.collect())
}

#[test]
fn walls_of_the_source_lie_on_walls_of_the_plan_under_the_truth() {
    let plan = FloorPlan::plan_a();
    let pair = quick_pair(1);
    let world_from_source = pair.target.world_from_map * pair.target_from_source;
    let truth = median_off_the_walls(&plan, &pair.source.map, world_from_source);
    assert!(truth < 0.5 * 0.04, "{truth} m");

    let turned = world_from_source * Se2::new(0.0, 0.0, 0.05);
    let wrong = median_off_the_walls(&plan, &pair.source.map, turned);
    assert!(wrong > 3.0 * truth, "{wrong} m when turned by 0.05 rad");
}

#[test]
fn common_walls_of_both_maps_coincide_under_the_truth() {
    let pair = quick_pair(2);
    let target = walls(&pair.target.map);
    let seen = |p: &Point2<f64>| {
        let cell = pair.target.map.cell_at(*p);
        cell.is_some_and(|cell| pair.target.coverage.get(cell) == Some(&true))
    };
    let distances: Vec<f64> = walls(&pair.source.map)
        .into_iter()
        .step_by(5)
        .map(|p| pair.target_from_source * p)
        .filter(seen)
        .map(|p| target.iter().map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min))
        .collect();
    assert!(distances.len() > 100, "{} common cells", distances.len());
    let median = median(distances);
    assert!(median < 0.04, "{median} m");
}

#[test]
fn tags_are_where_the_readings_of_both_robots_say() {
    let pair = quick_pair(3);
    for run in [&pair.target, &pair.source] {
        assert!(run.readings.len() > 500, "{} readings", run.readings.len());
        for reading in &run.readings {
            let mut tags = pair.tags.iter();
            let tag = tags.find(|tag| reading.tag_id == tag.0.into()).expect("a tag placed").1;
            let robot = run.world_from_map * reading.robot_position;
            let error = reading.range - (tag - robot).norm();
            assert!(error.abs() <= 4.0 * 0.05 + 1e-9, "{error} m");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_seed_others() {
    let pair = quick_pair(7);
    assert_eq!(pair, quick_pair(7));
    let other = quick_pair(8);
    assert_ne!(pair.target_from_source, other.target_from_source);
    assert_ne!(pair.target.map, other.target.map);
    assert_ne!(pair.target.readings, other.target.readings);
    assert_ne!(pair.tags, other.tags);
}

#[test]
fn the_noise_of_the_map_does_not_depend_on_the_tags() {
    let mut params = quick(7);
    params.tags.count = 3;
    let few = simulate_pair(&FloorPlan::plan_a(), &params).unwrap();
    assert_eq!(few.source.map, quick_pair(7).source.map);
}

#[test]
fn two_robots_share_about_three_fifths_of_what_they_see() {
    for (plan, name) in [(FloorPlan::plan_a(), "a"), (FloorPlan::plan_b(), "b")] {
        let overlap = simulate_pair(&plan, &quick(1)).unwrap().overlap().unwrap();
        assert!((0.55..0.70).contains(&overlap), "plan {name}: {overlap}");
    }
    let pair = quick_pair(1);
    let twins =
        SimulatedPair { source: pair.target.clone(), target_from_source: Se2::identity(), ..pair };
    assert_eq!(twins.overlap(), Ok(1.0));
}

#[test]
fn robots_keep_clear_of_everything_in_the_plan() {
    for plan in [FloorPlan::plan_a(), FloorPlan::plan_b()] {
        for robot in [TARGET, SOURCE] {
            let path = plan.path(robot, 0.03).unwrap();
            assert!(path.len() > 1000);
            for point in path {
                let distance = plan.distance_to_face(point);
                assert!(distance >= 0.199 && !plan.is_solid(point), "{distance} m at {point}");
            }
        }
    }
}

/// Tsardoulias et al. give a frame of 700 × 600 cells of 0.02 m for a building of these
/// proportions.
#[test]
fn plan_a_surveyed_has_the_size_and_cells_of_the_reference_building() {
    let run = survey(&FloorPlan::plan_a(), 0.0, &PairParams::default()).unwrap();
    assert_eq!((run.map.width(), run.map.height()), (700, 600));
    assert_eq!(run.map.frame().map_from_grid(), Se2::identity());

    let thresholds = ClassThresholds::default();
    let cells = run.map.cells().cells().iter();
    let occupied = cells.clone().filter(|&&cell| thresholds.is_occupied(cell)).count();
    let free = cells.filter(|&&cell| thresholds.is_free(cell)).count();
    assert!(occupied.abs_diff(16_000) < 2_400, "{occupied} occupied cells");
    assert!(free.abs_diff(329_000) < 49_350, "{free} free cells");

    let known = run.map.cells().indexed().filter(|(_, cell)| cell.is_known());
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for (cell, _) in known {
        for (axis, at) in [cell.column, cell.row].into_iter().enumerate() {
            low[axis] = low[axis].min(at);
            high[axis] = high[axis].max(at);
        }
    }
    for (axis, expected) in [664_usize, 564].into_iter().enumerate() {
        let extent = high[axis] - low[axis] + 1;
        assert!(extent.abs_diff(expected) <= 4, "{extent} cells along axis {axis}");
    }
}

#[test]
fn a_turned_survey_shows_the_same_building() {
    let plan = FloorPlan::plan_a();
    let straight = survey(&plan, 0.0, &quick(4)).unwrap();
    let turned = survey(&plan, -0.7, &quick(4)).unwrap();
    let off = median_off_the_walls(&plan, &turned.map, turned.world_from_map);
    assert!(off < 0.5 * 0.04, "{off} m");
    let count = |run: &RobotRun| run.coverage.cells().iter().filter(|&&seen| seen).count();
    let (a, b) = (count(&straight), count(&turned));
    assert!(a.abs_diff(b) * 50 < a, "{a} and {b} cells");
    for corner in [[0.1, 0.1], [13.9, 0.1], [0.1, 11.9], [13.9, 11.9]] {
        let point = turned.world_from_map.inverse() * Point2::from(corner);
        assert!(turned.map.cell_at(point).is_some(), "{corner:?} is cut off");
    }
}

#[test]
fn coverage_is_what_the_map_knows_and_the_robot_was_there() {
    let run = quick_pair(5).source;
    let cells = run.map.cells().cells().iter().zip(run.coverage.cells());
    assert!(cells.into_iter().all(|(cell, &covered)| cell.is_known() == covered));
    let thresholds = ClassThresholds::default();
    assert!(run.path.iter().all(|&p| thresholds.is_free(run.map.at(p))));
    assert_eq!(run.path[0], Point2::origin(), "a map frame lies at the start");
}

#[test]
fn drift_moves_the_map_off_the_truth_and_its_absence_does_not() {
    let plan = FloorPlan::plan_a();
    let path = plan.path(SOURCE, 0.03).unwrap();
    let frame = Se2::new(1.0, 2.0, 0.4);
    let run = |drift| {
        let params = PairParams { drift, ..quick(6) };
        map_along_path(&plan, &path, &[], frame, SOURCE, &params).unwrap()
    };
    let end = |run: &RobotRun| {
        let (believed, truth) = (run.path.last().unwrap(), path.last().unwrap());
        (run.world_from_map * *believed - *truth).norm()
    };
    let exact = run(DriftParams::default());
    assert!(end(&exact) < 1e-9);
    let odometry_share = 0.02;
    let drifting =
        run(DriftParams { odometry_share, compass_sigma: 0.03, ..DriftParams::default() });
    // 0.02 m a metre and axis over 47 m: 0.14 m an axis.
    assert!((0.01..0.6).contains(&end(&drifting)), "{} m", end(&drifting));
    let off = |run: &RobotRun| median_off_the_walls(&plan, &run.map, run.world_from_map);
    assert!(off(&drifting) > 1.5 * off(&exact), "{} and {}", off(&drifting), off(&exact));
}

#[test]
fn presets_of_the_other_papers_map_the_plan_too() {
    for (params, resolution) in [(PairParams::sa(), 0.05), (PairParams::cb(), 0.14)] {
        let plan = FloorPlan::plan_b();
        let pair = simulate_pair(&plan, &params).unwrap();
        let off = median_off_the_walls(&plan, &pair.target.map, pair.target.world_from_map);
        assert!(off < resolution, "{off} m at {resolution} m a cell");
    }
}

#[test]
fn parameters_that_cannot_be_meant_are_errors() {
    let with = |change: fn(&mut PairParams)| {
        let mut params = quick(0);
        change(&mut params);
        simulate_pair(&FloorPlan::plan_a(), &params)
    };
    for (name, result) in [
        ("step", with(|p| p.step = 0.0)),
        ("beams", with(|p| p.lidar.beams = 1)),
        ("field_of_view", with(|p| p.lidar.field_of_view = 7.0)),
        ("max_range", with(|p| p.lidar.max_range = f64::INFINITY)),
        ("spurious_share", with(|p| p.lidar.spurious_share = 1.5)),
        ("resolution", with(|p| p.mapping.resolution = f64::NAN)),
        ("-free_update", with(|p| p.mapping.free_update = 0.4)),
        ("tags.range_sigma", with(|p| p.tags.range_sigma = -0.1)),
        ("compass_sigma", with(|p| p.drift.compass_sigma = -0.1)),
    ] {
        match result {
            Err(SimError::Parameter(error)) => assert_eq!(error.name, name),
            other => panic!("{name}: {:?}", other.err()),
        }
    }
    let huge = with(|p| p.mapping.resolution = 1e-6);
    assert!(matches!(huge, Err(SimError::Grid(_))));
}
