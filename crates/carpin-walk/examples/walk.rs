//! Merges two maps of one floor from a rough start and shows how the picture distance fell.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use carpin_walk::{Params, RandomWalk, align};
use ogm_core::{GridFrame, OccupancyGrid, Outcome, Se2};

const FLOOR: &str = "
    ##################
    #....#...#.......#
    #....#...........#
    #........#...#...#
    #....#...#...#...#
    ####..###..#######";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let target = OccupancyGrid::from_ascii(GridFrame::new(0.1, Se2::identity())?, FLOOR)?;
    // The second robot wrote the same floor down in a frame of its own.
    let source_from_target = Se2::new(4.0, 1.0, 1.2);
    let source = OccupancyGrid::from_ascii(GridFrame::new(0.1, source_from_target)?, FLOOR)?;

    let start = Se2::new(0.2, -0.15, 0.1) * source_from_target.inverse();
    let params = Params { walks: 4, ..Params::default() };
    match align(&target, &source, start, &RandomWalk::default(), &params, &())? {
        Outcome::Found(found) => {
            for (number, sample) in (1..).zip(&found.trace).step_by(20) {
                println!(
                    "sample {number:3}: at {:.2}, best {:.2}",
                    sample.current_psi, sample.best_psi
                );
            }
            let error = found.target_from_source * source_from_target;
            println!("ψ {:.2} to {:.2} cells", found.start_psi, found.psi);
            println!("off by {:.3} m, {:.3} rad", error.translation().norm(), error.theta());
        }
        Outcome::Refused(refusal) => println!("refused: {refusal}"),
    }
    Ok(())
}
