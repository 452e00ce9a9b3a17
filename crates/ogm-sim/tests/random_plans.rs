//! Random plans are buildings that robots can explore and that look like nothing but themselves.

use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, SOURCE, TARGET, simulate_pair};

const SEEDS: std::ops::Range<u64> = 0..8;

#[test]
fn random_plans_are_of_the_size_asked_for_and_can_be_explored() {
    for seed in SEEDS {
        let plan = FloorPlan::random(seed).unwrap();
        let size = plan.size();
        let (short, long) = (size.x.min(size.y), size.x.max(size.y));
        assert!((10.0..14.0).contains(&short) && (12.0..17.0).contains(&long), "{size}");
        for robot in [TARGET, SOURCE] {
            let path = plan.path(robot, 0.03).unwrap();
            let length = 0.03 * path.len() as f64;
            assert!((15.0..110.0).contains(&length), "plan {seed}: {length} m");
            for point in path.iter().step_by(7) {
                assert!(plan.distance_to_face(*point) > 0.199 && !plan.is_solid(*point));
            }
        }
    }
}

#[test]
fn a_seed_is_a_plan() {
    assert_eq!(FloorPlan::random(5), FloorPlan::random(5));
    for seed in SEEDS {
        assert_ne!(FloorPlan::random(seed), FloorPlan::random(seed + 1));
    }
}

#[test]
fn pairs_in_random_plans_overlap_by_about_three_fifths() {
    let params = PairParams {
        lidar: LidarParams { beams: 541, scan_every: 0.96, ..LidarParams::rf() },
        mapping: MappingParams { resolution: 0.08, ..MappingParams::default() },
        ..PairParams::default()
    };
    let overlaps: Vec<f64> = SEEDS
        .map(|seed| {
            let plan = FloorPlan::random(seed).unwrap();
            simulate_pair(&plan, &params).unwrap().overlap().unwrap()
        })
        .collect();
    let mean = overlaps.iter().sum::<f64>() / overlaps.len() as f64;
    assert!((0.5..0.7).contains(&mean), "mean {mean} of {overlaps:?}");
    assert!(overlaps.iter().all(|overlap| (0.3..0.95).contains(overlap)), "{overlaps:?}");
}
