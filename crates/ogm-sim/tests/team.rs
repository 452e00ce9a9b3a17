//! More robots than two.

use ogm_core::{ClassThresholds, RobotId, Se2};
use ogm_sim::{
    FloorPlan, LidarParams, MappingParams, PairParams, SOURCE, SimError, TARGET, TeamMember,
    simulate_pair, simulate_team,
};

fn params(seed: u64) -> PairParams {
    PairParams {
        seed,
        lidar: LidarParams { beams: 91, ..LidarParams::rf() },
        mapping: MappingParams { resolution: 0.1, ..MappingParams::default() },
        ..PairParams::default()
    }
}

fn team(count: usize) -> Vec<TeamMember> {
    vec![TeamMember::default(); count]
}

#[test]
fn a_pair_is_the_beginning_of_every_team() {
    let plan = FloorPlan::plan_a();
    let pair = simulate_pair(&plan, &params(3)).unwrap();
    let four = simulate_team(&plan, &team(4), &params(3)).unwrap();
    assert_eq!(four.robots[..2], [pair.target, pair.source]);
    assert_eq!(four.tags, pair.tags);
    assert_eq!(four.target_from_source(TARGET, SOURCE), Some(pair.target_from_source));
    assert_eq!(four.robots.len(), 4);
    assert_eq!(four.target_from_source(TARGET, RobotId(4)), None);
}

#[test]
fn robots_without_a_route_explore_parts_of_their_own_and_see_walls_where_they_are() {
    let plan = FloorPlan::plan_a();
    let team = simulate_team(&plan, &team(5), &params(1)).unwrap();
    for (index, run) in team.robots.iter().enumerate().skip(2) {
        let walls = run.map.occupied_points(&ClassThresholds::default());
        assert!(walls.len() > 100, "robot {index} found {} wall cells", walls.len());
        for wall in walls {
            assert!(plan.distance_to_face(run.world_from_map * wall) < 0.2, "robot {index}");
        }
        for other in &team.robots[..index] {
            assert_ne!(run.path, other.path);
        }
    }
}

#[test]
fn a_path_and_a_frame_that_are_given_are_kept() {
    let plan = FloorPlan::plan_a();
    let path: Vec<_> = plan.path(TARGET, 0.03).unwrap().into_iter().rev().collect();
    let world_from_map = Se2::new(7.0, 6.0, 0.5);
    let third = TeamMember { path: Some(path.clone()), world_from_map: Some(world_from_map) };
    let members = [team(2), vec![third]].concat();
    let run = &simulate_team(&plan, &members, &params(1)).unwrap().robots[2];
    assert_eq!(run.world_from_map, world_from_map);
    for (believed, point) in run.path.iter().zip(path) {
        assert!((world_from_map * *believed - point).norm() < 1e-9);
    }
}

#[test]
fn the_plan_has_no_route_for_a_third_robot() {
    let plan = FloorPlan::plan_a();
    assert_eq!(plan.path(RobotId(2), 0.03), Err(SimError::NoRoute { robot: RobotId(2) }));
    assert_eq!(plan.route(RobotId(2)), None);
}
