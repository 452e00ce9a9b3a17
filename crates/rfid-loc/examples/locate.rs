//! Drives past a tag in a straight line, then in a curve, and prints what is known each time.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use nalgebra::Point2;
use ogm_core::TagReading;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use rfid_loc::{FilterParams, localise};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let tag = Point2::new(1.2, 0.8);
    let noise = Normal::new(0.0, 0.05)?;
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let straight = |s: f64| Point2::new(s, 0.0);
    let curve = |s: f64| Point2::new(s.sin(), 1.0 - s.cos());
    for name in ["straight", "curve"] {
        let log: Vec<TagReading> = (0..100)
            .map(|step| {
                let s = 0.03 * f64::from(step);
                let robot_position = if name == "curve" { curve(s) } else { straight(s) };
                TagReading {
                    tag_id: 7.into(),
                    robot_position,
                    range: (tag - robot_position).norm() + noise.sample(&mut random),
                }
            })
            .collect();
        for estimate in localise(&log, &FilterParams::default(), &())? {
            println!(
                "{name}: tag {} at ({:.3}, {:.3}), {:.0} mm off, certainty {:.2}, second peak {:.2}",
                estimate.tag_id,
                estimate.position.x,
                estimate.position.y,
                1000.0 * (estimate.position - tag).norm(),
                estimate.certainty,
                estimate.second_peak_ratio,
            );
        }
    }
    Ok(())
}
