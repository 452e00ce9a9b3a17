//! Says what a map file holds and what is wrong with it: `inspect MAP.yaml`.
//!
//! Without an argument it looks at a map with the defects of an older saver.

#![expect(clippy::print_stdout, reason = "an example shows its result")]
#![expect(clippy::disallowed_methods, reason = "it writes the map that it reads")]

use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let yaml = match std::env::args_os().nth(1) {
        Some(path) => PathBuf::from(path),
        None => {
            let yaml = folder.path().join("lab.yaml");
            std::fs::write(
                &yaml,
                "image: lab.pgm\nresolution: 0.05\norigin: [-1.23e+03, 4.5, -nan]\n\
                 negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n",
            )?;
            std::fs::write(
                folder.path().join("lab.pgm"),
                "P2\n# CREATOR: map_saver\n4 3\n255\n0 0 0 0\n0 254 254 205\n0 0 205 205\n",
            )?;
            yaml
        }
    };
    let loaded = ogm_io::read_map(&yaml)?;
    let (map, frame) = (&loaded.map, loaded.map.frame());
    println!(
        "{} × {} cells of {} m, origin {:?}, {:?}",
        map.width(),
        map.height(),
        frame.resolution(),
        frame.map_from_grid(),
        loaded.header.mode,
    );
    for warning in &loaded.warnings {
        println!("warning: {warning}");
    }
    if map.width() <= 100 {
        print!("{}", map.to_ascii());
    }
    Ok(())
}
