//! Maps without tags.

use ogm_core::{OccupancyGrid, Outcome, Refusal};
use ogm_merge::merge_by_radon;
use ogm_sim::{FloorPlan, LidarParams, PairParams, simulate_pair};
use radon_merge::RadonParams;

#[test]
fn what_can_be_aligned_is_fused_and_the_rest_stays_out() {
    let lidar = LidarParams { beams: 257, scan_every: 0.48, ..LidarParams::sa() };
    let world = PairParams { seed: 5, lidar, ..PairParams::sa() };
    let pair = simulate_pair(&FloorPlan::random(5).unwrap(), &world).unwrap();
    let (first, second) = (&pair.target.map, &pair.source.map);
    let blank = OccupancyGrid::from_ascii(*first.frame(), "???").unwrap();

    let mut params = RadonParams::default();
    params.segments.max_segments = 200;
    params.hypotheses.max_candidates = 3;
    let team = merge_by_radon(first, &[second, &blank], &params, &Default::default(), &()).unwrap();
    let Outcome::Found(target_from_source) = team.matches[0].outcome else {
        panic!("{:?}", team.matches[0].outcome)
    };
    let error = pair.target_from_source.between(&target_from_source);
    assert!(error.translation().norm() < 0.2 && error.theta().abs() < 0.02, "{error:?}");
    let stays_out = &team.matches[1].outcome;
    assert!(matches!(stays_out, Outcome::Refused(Refusal::TooLittleStructure { .. })));

    let known = |map: &OccupancyGrid| map.cells().cells().iter().filter(|c| c.is_known()).count();
    assert!(known(&team.merged.map) > known(first).max(known(second)));
    assert!(team.merged.conflict_count * 50 < team.merged.compared);
}
