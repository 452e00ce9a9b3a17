//! A method whose own evidence speaks against its answer says so instead of giving it.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use nalgebra::{Matrix2, Point2, Vector2};
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Outcome, Refusal, Se2, TagEstimate};
use ogm_merge::{
    AlignParams, Method, RfidParams, RobotMap, TagMethod, TagReport, Warning, align_by_tags,
    align_pair,
};

const RESOLUTION: f64 = 0.05;

const METHODS: [TagMethod; 6] = [
    TagMethod::Rfid1,
    TagMethod::Rfid1b,
    TagMethod::Rfid2,
    TagMethod::Rfid3,
    TagMethod::TwoTags,
    TagMethod::TagsIcp,
];

/// What a robot whose frame is `world_from_map` would draw of a building: occupied, free or
/// neither, by the place in the world, within 9 m of the world's origin.
fn drawn(world_from_map: Se2, of: impl Fn(Point2<f64>) -> Occupancy) -> OccupancyGrid {
    let middle = world_from_map.inverse() * Point2::origin();
    let side = 360;
    let corner = middle - Vector2::repeat(0.5 * f64::from(side) * RESOLUTION);
    let frame = GridFrame::new(RESOLUTION, Se2::new(corner.x, corner.y, 0.0)).unwrap();
    let centre = |at: f64| (at + 0.5) * RESOLUTION;
    let mut cells = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let offset = Vector2::new(centre(column.into()), centre(row.into()));
            cells.push(of(world_from_map * (corner + offset)));
        }
    }
    OccupancyGrid::new(frame, Grid::new(360, 360, cells).unwrap())
}

/// A round hall of 6 m radius.
fn round_hall(place: Point2<f64>) -> Occupancy {
    match place.coords.norm() {
        radius if radius < 6.0 => Occupancy::FREE,
        radius if radius < 6.1 => Occupancy::OCCUPIED,
        _ => Occupancy::UNKNOWN,
    }
}

/// Rooms whose walls lie `step` metres apart along x, in a building of 14 × 10 m.
fn rooms(place: Point2<f64>, step: f64) -> Occupancy {
    let (x, y) = (place.x + 7.0, place.y + 5.0);
    let inside = |margin: f64| {
        (-margin..14.0 + margin).contains(&x) && (-margin..10.0 + margin).contains(&y)
    };
    let is_wall = (x % step < 0.1 && !(4.0..5.5).contains(&y)) || (y % 5.7 < 0.1 && x > 0.9);
    match (inside(0.0), inside(0.15)) {
        (true, _) if !is_wall => Occupancy::FREE,
        (true, _) | (false, true) => Occupancy::OCCUPIED,
        _ => Occupancy::UNKNOWN,
    }
}

/// Certain tags at `places` of the world.
fn tags(world_from_map: Se2, places: &[[f64; 2]]) -> Vec<TagEstimate> {
    let map_from_world = world_from_map.inverse();
    let at = (0..).zip(places).map(|(tag_id, &[x, y])| {
        let position = map_from_world * Point2::new(x, y);
        TagEstimate {
            tag_id: tag_id.into(),
            position,
            mode: position,
            covariance: Matrix2::from_diagonal_element(1e-4),
            certainty: 0.99 - 0.001 * f64::from(tag_id),
            misfit: 1.0,
            readings: 200,
            dropped: 0,
            touches_border: false,
            second_peak_ratio: 0.0,
        }
    });
    at.collect()
}

const PLACES: [[f64; 2]; 5] = [[5.9, 0.4], [-3.0, 4.9], [-1.5, -4.9], [3.0, -4.9], [2.0, 4.9]];

fn poses() -> [Se2; 2] {
    [Se2::new(0.3, -0.4, 0.2), Se2::new(-1.0, 0.7, 1.9)]
}

fn align(method: TagMethod, maps: &[OccupancyGrid; 2], tags: &[Vec<TagEstimate>; 2]) -> TagReport {
    let [target, source] = [0, 1].map(|robot| RobotMap { map: &maps[robot], tags: &tags[robot] });
    align_by_tags(method, &target, &source, &RfidParams::default(), &()).unwrap()
}

/// Furthest that a place of the building comes to lie from where it belongs, metres.
fn error(found_target_from_source: Se2) -> f64 {
    let [world_from_target, world_from_source] = poses();
    let apart = PLACES.map(|[x, y]| {
        let in_source = world_from_source.inverse() * Point2::new(x, y);
        let there = world_from_target * (found_target_from_source * in_source);
        (there - Point2::new(x, y)).norm()
    });
    apart.into_iter().fold(0.0, f64::max)
}

#[test]
fn in_a_round_hall_with_exact_tags_no_method_is_more_than_five_centimetres_off() {
    let maps = poses().map(|world_from_map| drawn(world_from_map, round_hall));
    let on_wall = [10.0_f64, 75.0, 160.0, 215.0, 290.0].map(|bearing| {
        let (sin, cos) = bearing.to_radians().sin_cos();
        [6.0 * cos, 6.0 * sin]
    });
    let tags = poses().map(|world_from_map| tags(world_from_map, &on_wall));
    let mut found = 0;
    for method in METHODS {
        match align(method, &maps, &tags).outcome {
            Outcome::Found(target_from_source) => {
                found += 1;
                let error = error(target_from_source);
                assert!(error < 0.05, "{method:?}: {error} m");
            }
            Outcome::Refused(refusal) => {
                assert!(method == TagMethod::Rfid2, "{method:?} refused: {refusal}");
            }
        }
    }
    assert!(found >= 5, "only walls that are said to be straight may fail here");
}

#[test]
fn a_moved_tag_refuses_every_method_and_the_reason_has_the_distance() {
    let maps = poses().map(|world_from_map| drawn(world_from_map, |place| rooms(place, 3.3)));
    let mut tags = poses().map(|world_from_map| tags(world_from_map, &PLACES));
    for method in METHODS {
        let target_from_source = align(method, &maps, &tags).outcome.found().unwrap();
        assert!(error(target_from_source) < 0.05, "{method:?}");
    }
    tags[1][2].position += Vector2::new(2.5, 0.0);
    for method in METHODS {
        let report = align(method, &maps, &tags);
        let Some(&Refusal::TagsDisagree { residual_m, limit_m }) = report.outcome.refusal() else {
            panic!("{method:?}: {:?}", report.outcome);
        };
        assert!(residual_m > limit_m && (1.0..2.5).contains(&residual_m), "{residual_m}");
        assert_eq!(report.evidence.tag_fit_residual, Some(residual_m));
    }
}

#[test]
fn tags_that_were_moved_together_are_contradicted_by_the_walls() {
    let maps = poses().map(|world_from_map| drawn(world_from_map, |place| rooms(place, 3.3)));
    let moved = Se2::about(Point2::new(1.0, 1.0), 0.6, Vector2::new(1.5, -2.0));
    let elsewhere = PLACES.map(|[x, y]| {
        let place = moved * Point2::new(x, y);
        [place.x, place.y]
    });
    let [world_from_target, world_from_source] = poses();
    let tags = [tags(world_from_target, &PLACES), tags(world_from_source, &elsewhere)];
    for method in METHODS {
        let report = align(method, &maps, &tags);
        assert!(report.outcome.refusal().is_some(), "{method:?}: {:?}", report.outcome);
    }
}

#[test]
fn different_buildings_with_equal_tag_ids_are_refused_by_every_method() {
    let [world_from_target, world_from_source] = poses();
    let maps = [
        drawn(world_from_target, |place| rooms(place, 3.3)),
        drawn(world_from_source, |place| rooms(Point2::new(place.y, -place.x), 4.6)),
    ];
    let other = [[-4.0, 2.0], [5.0, 4.9], [0.5, 0.5], [-6.0, -4.0], [4.0, -2.0]];
    let tags = [tags(world_from_target, &PLACES), tags(world_from_source, &other)];
    for method in METHODS {
        let report = align(method, &maps, &tags);
        assert!(report.outcome.refusal().is_some(), "{method:?}: {:?}", report.outcome);
    }
}

#[test]
fn two_tags_suffice_for_the_method_of_two() {
    let maps = poses().map(|world_from_map| drawn(world_from_map, |place| rooms(place, 3.3)));
    let tags = poses().map(|world_from_map| tags(world_from_map, &PLACES[..2]));
    for method in METHODS {
        let outcome = align(method, &maps, &tags).outcome;
        if method == TagMethod::TwoTags {
            let error = error(outcome.found().unwrap());
            assert!(error < 0.2 * RESOLUTION, "{error} m");
        } else {
            assert_eq!(outcome.refusal(), Some(&Refusal::TooFewTags { have: 2, need: 3 }));
        }
    }
}

#[test]
fn that_the_walls_were_of_no_use_is_a_warning_of_the_report() {
    let maps = poses().map(|world_from_map| drawn(world_from_map, round_hall));
    let tags = poses().map(|world_from_map| tags(world_from_map, &PLACES));
    let [target, source] = [0, 1].map(|robot| RobotMap { map: &maps[robot], tags: &tags[robot] });
    let method = Method::Tags(TagMethod::Rfid3);
    let report = align_pair(method, &target, &source, &AlignParams::default(), &()).unwrap();
    assert!(report.warnings.contains(&Warning::StartedFromTags), "{:?}", report.warnings);
}
