//! The recipes against the exact truth of a simulated building, under changes of frame, and on
//! input that holds too little.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use ogm_core::{
    GridFrame, Occupancy, OccupancyGrid, Outcome, Refusal, Se2, TagEstimate, wrap_angle,
};
use ogm_merge::{
    AlignParams, FusionParams, Method, RfidParams, RobotMap, TagMethod, align_by_tags, align_pair,
    fuse,
};
use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, SimulatedPair, simulate_pair};
use rfid_loc::{FilterParams, localise};

/// Metres a cell: coarse, so that the maps are made quickly.
const RESOLUTION: f64 = 0.05;

struct World {
    pair: SimulatedPair,
    target_tags: Vec<TagEstimate>,
    source_tags: Vec<TagEstimate>,
}

impl World {
    fn new() -> Self {
        let params = PairParams {
            seed: 1,
            lidar: LidarParams { beams: 361, ..LidarParams::rf() },
            mapping: MappingParams { resolution: RESOLUTION, ..MappingParams::default() },
            ..PairParams::default()
        };
        let pair = simulate_pair(&FloorPlan::plan_a(), &params).unwrap();
        let filter = FilterParams::default();
        let target_tags = localise(&pair.target.readings, &filter, &()).unwrap();
        let source_tags = localise(&pair.source.readings, &filter, &()).unwrap();
        Self { pair, target_tags, source_tags }
    }

    fn target(&self) -> RobotMap<'_> {
        RobotMap { map: &self.pair.target.map, tags: &self.target_tags }
    }

    fn source(&self) -> RobotMap<'_> {
        RobotMap { map: &self.pair.source.map, tags: &self.source_tags }
    }
}

fn found(method: TagMethod, target: &RobotMap<'_>, source: &RobotMap<'_>) -> Se2 {
    let report = align_by_tags(method, target, source, &RfidParams::default(), &()).unwrap();
    match report.outcome {
        Outcome::Found(target_from_source) => target_from_source,
        Outcome::Refused(refusal) => panic!("{method:?} refused: {refusal}"),
    }
}

/// Metres at ten metres from the origin, and radians.
fn difference(a_target_from_source: Se2, b_target_from_source: Se2) -> (f64, f64) {
    let probe = nalgebra::Point2::new(6.0, 8.0);
    let metres = (a_target_from_source * probe - b_target_from_source * probe).norm();
    (metres, wrap_angle(a_target_from_source.theta() - b_target_from_source.theta()).abs())
}

/// The map and its tags as they would be in a map frame that `new_from_old` maps into.
fn reframed(
    map: &OccupancyGrid,
    tags: &[TagEstimate],
    new_from_old: Se2,
) -> (OccupancyGrid, Vec<TagEstimate>) {
    let frame = map.frame();
    let frame = GridFrame::new(frame.resolution(), new_from_old * frame.map_from_grid()).unwrap();
    let moved = tags.iter().map(|tag| TagEstimate {
        position: new_from_old * tag.position,
        mode: new_from_old * tag.mode,
        ..*tag
    });
    (OccupancyGrid::new(frame, map.cells().clone()), moved.collect())
}

#[test]
fn every_method_finds_the_truth_to_what_it_promises() {
    let world = World::new();
    for (method, metres) in [
        (TagMethod::Rfid1, 0.2),
        (TagMethod::Rfid1b, 0.1),
        (TagMethod::Rfid2, 0.1),
        (TagMethod::Rfid3, 0.2 * RESOLUTION),
    ] {
        let target_from_source = found(method, &world.target(), &world.source());
        let (error, _) = difference(target_from_source, world.pair.target_from_source);
        assert!(error < metres, "{method:?}: {error} m");
    }
}

#[test]
fn swapping_the_maps_gives_the_inverse() {
    let world = World::new();
    let target_from_source = found(TagMethod::Rfid3, &world.target(), &world.source());
    let source_from_target = found(TagMethod::Rfid3, &world.source(), &world.target());
    let (metres, radians) = difference(source_from_target.inverse(), target_from_source);
    assert!(metres < 0.2 * RESOLUTION && radians < 1e-3, "{metres} m, {radians}");
}

#[test]
fn another_map_frame_changes_the_answer_by_just_that() {
    let world = World::new();
    let target_from_source = found(TagMethod::Rfid3, &world.target(), &world.source());
    for quarter in 0..4 {
        let theta = 0.3 + f64::from(quarter) * std::f64::consts::FRAC_PI_2;
        let new_from_old = Se2::new(7.0, -3.0, theta);
        let (map, tags) = reframed(&world.pair.source.map, &world.source_tags, new_from_old);
        let moved_target_from_source =
            found(TagMethod::Rfid3, &world.target(), &RobotMap { map: &map, tags: &tags });
        let (metres, _) = difference(moved_target_from_source * new_from_old, target_from_source);
        assert!(metres < 0.2 * RESOLUTION, "{metres} m with the frame turned by {theta}");
    }
}

#[test]
fn maps_of_two_resolutions_align_at_the_coarser_one() {
    let world = World::new();
    let thresholds = ogm_core::ClassThresholds::default();
    let coarse = grid_merge::coarsen(&world.pair.source.map, 0.08, &thresholds).unwrap();
    let source = RobotMap { map: &coarse, tags: &world.source_tags };
    let report =
        align_by_tags(TagMethod::Rfid3, &world.target(), &source, &RfidParams::default(), &())
            .unwrap();
    assert_eq!(report.resolution, 0.08);
    let target_from_source = report.outcome.found().unwrap();
    let (metres, _) = difference(target_from_source, world.pair.target_from_source);
    assert!(metres < 0.5 * 0.08, "{metres} m");
}

#[test]
fn the_merged_map_agrees_with_both_where_they_were_known() {
    let world = World::new();
    let (target, source) = (world.target(), world.source());
    let method = Method::Tags(TagMethod::Rfid3);
    let report = align_pair(method, &target, &source, &AlignParams::default(), &()).unwrap();
    assert!(report.stages.tags.as_ref().unwrap().refinement.unwrap().termination.is_converged());
    let [component] = &report.components()[..] else { panic!("{report:?}") };
    let maps = [target.map, source.map];
    let merged = fuse(&maps, component, &FusionParams::default(), &()).unwrap();
    let share = merged.conflict_count as f64 / merged.compared as f64;
    assert!(share < 0.02, "{share} of the common cells in conflict");
    let known =
        |map: &OccupancyGrid| map.cells().cells().iter().filter(|cell| cell.is_known()).count();
    let union = known(&world.pair.target.map) + known(&world.pair.source.map) - merged.compared;
    let lost = 1.0 - known(&merged.map) as f64 / union as f64;
    assert!(lost.abs() < 0.01, "{lost} of the known cells lost");
}

#[test]
fn valid_input_with_too_little_in_it_is_refused_with_its_reason() {
    let world = World::new();
    let refusal = |method, target: &RobotMap<'_>, source: &RobotMap<'_>| {
        let report = align_by_tags(method, target, source, &RfidParams::default(), &()).unwrap();
        report.outcome.refusal().cloned()
    };
    let untagged = RobotMap { tags: &[], ..world.source() };
    for method in [TagMethod::Rfid1, TagMethod::Rfid1b, TagMethod::Rfid2, TagMethod::Rfid3] {
        let expected = Some(Refusal::TooFewTags { have: 0, need: 3 });
        assert_eq!(refusal(method, &world.target(), &untagged), expected, "{method:?}");
    }

    let frame = GridFrame::new(RESOLUTION, Se2::identity()).unwrap();
    for (cell, side) in [(Occupancy::UNKNOWN, 40), (Occupancy::FREE, 40), (Occupancy::OCCUPIED, 1)]
    {
        let cells = ogm_core::Grid::filled(side, side, cell).unwrap();
        let map = OccupancyGrid::new(frame, cells);
        let empty = RobotMap { map: &map, tags: &world.source_tags };
        let reason = refusal(TagMethod::Rfid3, &world.target(), &empty);
        assert!(
            matches!(reason, Some(Refusal::TooLittleStructure { .. } | Refusal::NoLines { .. })),
            "{side} cells of {cell:?}: {reason:?}"
        );
    }

    let mut together = world.source_tags.clone();
    for tag in &mut together {
        tag.position = world.source_tags[0].position;
    }
    let together = RobotMap { tags: &together, ..world.source() };
    let reason = refusal(TagMethod::Rfid2, &world.target(), &together);
    assert!(matches!(reason, Some(Refusal::TagsCoincide { .. })), "{reason:?}");
}

#[test]
fn a_tag_that_is_nowhere_is_an_error() {
    let world = World::new();
    let mut tags = world.source_tags.clone();
    tags[0].position.x = f64::NAN;
    let source = RobotMap { tags: &tags, ..world.source() };
    assert!(
        align_by_tags(TagMethod::Rfid3, &world.target(), &source, &RfidParams::default(), &())
            .is_err()
    );
}
