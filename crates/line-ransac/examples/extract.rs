//! Draws a building of 700 × 600 cells and lists its walls: `cargo run --example extract`.
//!
//! With a number, extracts as often with as many seeds, to be timed from outside.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use line_ransac::{Params, extract_segments};
use ogm_core::{Grid, GridError, GridFrame, Occupancy, OccupancyGrid, Se2};

fn main() -> Result<(), GridError> {
    let cells = (0..700 * 600).map(|cell| match is_wall(cell % 700, cell / 700) {
        true => Occupancy::OCCUPIED,
        false => Occupancy::FREE,
    });
    let frame = GridFrame::new(0.02, Se2::identity())?;
    let map = OccupancyGrid::new(frame, Grid::new(700, 600, cells.collect())?);
    let mut params = Params::default();
    let repeats = std::env::args().nth(1).and_then(|text| text.parse().ok());
    for seed in 1..repeats.unwrap_or(1) {
        params.seed = seed;
        let _ = std::hint::black_box(extract_segments(&map, &params));
    }
    match extract_segments(&map, &params).into_result() {
        Ok(walls) => {
            for wall in &walls.segments {
                let (length, degrees) = (wall.length(), wall.direction.to_degrees());
                println!("{length:6.2} m at {degrees:7.3}°");
            }
            println!("{:?}", walls.statistics);
        }
        Err(refusal) => println!("{refusal}"),
    }
    Ok(())
}

/// Rooms on both sides of a corridor, 14 × 12 m: walls 6 cells thick, doors 45 cells wide.
fn is_wall(x: usize, y: usize) -> bool {
    let within = |value: usize, starts: &[usize], extent: usize| {
        let mut starts = starts.iter();
        starts.any(|&start| (start..start + extent).contains(&value))
    };
    let inside = (20..680).contains(&x) && (20..580).contains(&y);
    let outer = within(x, &[20, 674], 6) || within(y, &[20, 574], 6);
    let corridor = within(y, &[260, 340], 6) && !within(x, &[90, 300, 560], 45);
    let below = y < 260 && within(x, &[230, 460], 6);
    let above = y > 340 && within(x, &[200, 410, 550], 6);
    inside && (outer || corridor || below || above)
}
