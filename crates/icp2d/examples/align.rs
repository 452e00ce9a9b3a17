//! Aligns two maps of one floor, each of which shows another part of it.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use icp2d::{IcpParams, WallPoints, align};
use ogm_core::{ClassThresholds, GridFrame, OccupancyGrid, Outcome, Se2};

const LEFT: &str = "
    ##############????
    #....#...#....????
    #....#........????
    #........#....????
    #....#...#....????
    ####..###..###????";
const RIGHT: &str = "
    ????##############
    ????.#...#.......#
    ????.#...........#
    ????.....#...#...#
    ????.#...#...#...#
    ??????###..#######";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let walls = |pose, picture| -> Result<WallPoints, Box<dyn std::error::Error>> {
        let map = OccupancyGrid::from_ascii(GridFrame::new(0.1, pose)?, picture)?;
        Ok(WallPoints::from_grid(&map, &ClassThresholds::default())?)
    };
    // The second robot wrote its map down in a frame of its own.
    let source_from_target = Se2::new(4.0, 1.0, 1.2);
    let target = walls(Se2::identity(), LEFT)?;
    let source = walls(source_from_target, RIGHT)?;

    let start = Se2::new(0.03, -0.02, 0.02) * source_from_target.inverse();
    match align(&target, &source, start, &IcpParams::default())? {
        Outcome::Found(found) => {
            let error = found.target_from_source * source_from_target;
            println!("{:?}, {} pairs", found.termination, found.correspondences);
            println!("off by {:.4} m, {:.4} rad", error.translation().norm(), error.theta());
        }
        Outcome::Refused(refusal) => println!("refused: {refusal}"),
    }
    Ok(())
}
