//! What the robots of a simulated team publish second by second, as files: a folder a robot with a
//! `nav_msgs/msg/OccupancyGrid` in CDR a second, `truth.json` with the pose of each map frame in the
//! plan, and `shared.json` with the metres of wall that each pair of maps has in common, second by
//! second. `team FOLDER ROBOTS SECONDS SEED METRES-A-CELL`
#![expect(clippy::disallowed_methods, reason = "files are what this is for")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use ogm_core::{ClassThresholds, NearestWall, OccupancyGrid, RobotId, Se2};
use ogm_io::ros::{Header, OccupancyGridMessage, to_cdr};
use ogm_sim::{
    FloorPlan, LidarParams, MappingParams, PairParams, TeamMember, map_along_path, simulate_team,
};

/// Share of the time that the drive takes; then the robots stand.
const DRIVEN: f64 = 0.8;
/// Walls of two maps no farther apart are one, and lengths are counted in squares of `SQUARE_M`,
/// whatever the thickness of a wall.
const SAME_WALL_M: f64 = 0.1;
const SQUARE_M: f64 = 0.25;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, robots, seconds, seed, resolution] = &arguments[..] else {
        return Err("write FOLDER ROBOTS SECONDS SEED METRES-A-CELL".into());
    };
    let (folder, robots) = (PathBuf::from(folder), robots.parse::<usize>()?);
    let (seconds, seed) = (seconds.parse::<usize>()?, seed.parse::<u64>()?);
    let plan = FloorPlan::random(seed)?;
    let lidar = LidarParams { beams: 361, ..LidarParams::rf() };
    let mapping = MappingParams { resolution: resolution.parse()?, ..MappingParams::default() };
    let params = PairParams { seed, lidar, mapping, step: 0.1, ..PairParams::default() };
    let team = simulate_team(&plan, &vec![TeamMember::default(); robots], &params)?;
    let mut truth = BTreeMap::new();
    let mut maps: Vec<Vec<OccupancyGrid>> = vec![Vec::new(); seconds];
    for (index, run) in team.robots.iter().enumerate() {
        let name = format!("robot{}", index + 1);
        fs::create_dir_all(folder.join(&name))?;
        let world_from_map = run.world_from_map;
        let path: Vec<_> = run.path.iter().map(|point| world_from_map * *point).collect();
        let robot = RobotId(u32::try_from(index)?);
        for (second, maps) in maps.iter_mut().enumerate() {
            let share = (second as f64 / (DRIVEN * seconds as f64)).min(1.0);
            let driven = path.len().min(1 + share_of(path.len(), share));
            let run = map_along_path(&plan, &path[..driven], &[], world_from_map, robot, &params)?;
            let header = Header { frame_id: "map".to_owned(), ..Header::default() };
            let message = to_cdr(&OccupancyGridMessage::from_map(header, &run.map)?)?;
            fs::write(folder.join(&name).join(format!("{second:04}.cdr")), message)?;
            maps.push(run.map);
        }
        truth.insert(name, [world_from_map.x(), world_from_map.y(), world_from_map.theta()]);
    }
    fs::write(folder.join("truth.json"), serde_json::to_vec_pretty(&truth)?)?;
    let world_from_map: Vec<Se2> = team.robots.iter().map(|run| run.world_from_map).collect();
    let mut shared: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for maps in &maps {
        for source in 0..robots {
            for target in 0..source {
                let target_from_source = world_from_map[target].between(&world_from_map[source]);
                let length = shared_wall_m(&maps[target], &maps[source], &target_from_source);
                let pair = format!("robot{} robot{}", target + 1, source + 1);
                shared.entry(pair).or_default().push(length);
            }
        }
    }
    fs::write(folder.join("shared.json"), serde_json::to_vec(&shared)?)?;
    Ok(())
}

/// Wall of the source that lies on wall of the target, metres.
fn shared_wall_m(target: &OccupancyGrid, source: &OccupancyGrid, target_from_source: &Se2) -> f64 {
    let thresholds = ClassThresholds::default();
    let Some(walls) = NearestWall::new(target, &thresholds) else { return 0.0 };
    let there = source.occupied_points(&thresholds).into_iter().map(|it| *target_from_source * it);
    #[expect(clippy::cast_possible_truncation, reason = "squares of a map")]
    let squares: BTreeSet<[i64; 2]> = there
        .filter(|point| (walls.nearest_to(*point) - *point).norm() <= SAME_WALL_M)
        .map(|point| [point.x, point.y].map(|metres| (metres / SQUARE_M).floor() as i64))
        .collect();
    SQUARE_M * squares.len() as f64
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a count")]
fn share_of(count: usize, share: f64) -> usize {
    (count as f64 * share) as usize
}
