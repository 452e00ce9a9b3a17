//! Robots that mapped parts of random floors.

use grid_match::{MatchParams, match_maps};
use ogm_sim::{
    FloorKind, FloorPlan, LidarParams, MappingParams, PairParams, Relation, SimulatedPair,
    bent_pair, labelled_pair, simulate_pair,
};

use crate::world::found;

const CELL: f64 = 0.1;

fn explored(seed: u64) -> SimulatedPair {
    let world = PairParams {
        seed,
        step: 0.06,
        lidar: LidarParams { beams: 181, ..LidarParams::rf() },
        mapping: MappingParams { resolution: CELL, ..MappingParams::default() },
        ..PairParams::default()
    };
    simulate_pair(&FloorPlan::random(seed).unwrap(), &world).unwrap()
}

#[test]
fn robots_of_one_floor_meet_within_a_cell() {
    for seed in [40_001, 40_002] {
        let pair = explored(seed);
        let target_from_source = found(&pair.target.map, &pair.source.map);
        let error = pair.target_from_source.between(&target_from_source);
        assert!(error.translation().norm() < CELL, "{seed}: {error:?}");
        assert!(error.theta().abs() < 0.5_f64.to_radians(), "{seed}: {error:?}");
    }
}

#[test]
fn rooms_on_both_sides_of_their_common_walls_meet() {
    for (kind, seed) in [(FloorKind::Flat, 705), (FloorKind::Offices, 706)] {
        let pair = labelled_pair(kind, Relation::Overlapping, seed).unwrap();
        let truth = pair.truth.unwrap().target_from_source;
        let error = truth.between(&found(&pair.target, &pair.source));
        assert!(error.translation().norm() < 0.1, "{kind:?} {seed}: {error:?}");
    }
}

#[test]
fn a_hall_is_not_left_a_step_along_its_shelves() {
    for seed in [422, 446, 465] {
        let pair = bent_pair(FloorKind::Hall, [0.0, 0.0], seed).unwrap();
        let truth = pair.truth.unwrap();
        let target_from_source = found(&pair.target, &pair.source);
        let middle = truth.shared_centre;
        let off = target_from_source * middle - truth.target_from_source * middle;
        assert!(off.norm() < 0.05, "{seed}: {off:?}");
    }
}

#[test]
fn robots_of_different_floors_do_not_meet() {
    let [a, b] = [explored(40_003), explored(40_004)];
    for (target, source) in [(&a.target.map, &b.source.map), (&b.target.map, &a.source.map)] {
        let report = match_maps(target, source, &MatchParams::default(), &()).unwrap();
        assert!(report.outcome.refusal().is_some(), "{:?}", report.outcome);
    }
}
