//! Merges two small maps, the second turned by a quarter, and shows map and conflicts.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::f64::consts::FRAC_PI_2;

use grid_merge::{FusionParams, PlacedMap, merge};
use ogm_core::{GridFrame, OccupancyGrid, Se2};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let frame = GridFrame::new(0.05, Se2::identity())?;
    let first = OccupancyGrid::from_ascii(
        frame,
        "########
         #......#
         #......?
         #....???",
    )?;
    let second = OccupancyGrid::from_ascii(
        frame,
        "#######
         #.....#
         #.....#
         #..#..#
         #.....?",
    )?;
    let placed = [
        PlacedMap::new(&first, Se2::identity()),
        PlacedMap::new(&second, Se2::new(0.40, -0.15, FRAC_PI_2)),
    ];
    let merged = merge(&placed, &FusionParams::default(), &())?;
    print!("{}", merged.map.to_ascii());
    println!(
        "{} of {} cells known to both are in conflict",
        merged.conflict_count, merged.compared
    );
    Ok(())
}
