//! Lays two maps on each other and prints the picture, a letter a pixel.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use ogm_core::{GridFrame, OccupancyGrid, Se2};
use ogm_view::{BLANK, COMMON_WALL, FREE, SOURCE_WALL, TARGET_WALL, overlay};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let frame = GridFrame::new(0.05, Se2::identity())?;
    let target = OccupancyGrid::from_ascii(frame, "######\n#.....\n#.....\n######")?;
    let source = OccupancyGrid::from_ascii(frame, "######\n.....#\n.....#\n######")?;
    let picture = overlay(&target, &source, Se2::new(0.15, 0.0, 0.0))?;
    for row in picture.rows() {
        let letters = row.map(|&pixel| match pixel {
            TARGET_WALL => 't',
            SOURCE_WALL => 's',
            COMMON_WALL => '#',
            FREE => '.',
            BLANK => ' ',
            _ => '?',
        });
        println!("{}", letters.collect::<String>().trim_end());
    }
    Ok(())
}
