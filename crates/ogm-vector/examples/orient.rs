//! The six walls of the paper's worked example: `cargo run --example orient`.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use nalgebra::Point2;
use ogm_core::Segment;
use ogm_vector::{Params, ogm_vector};

fn main() {
    let segments = [2.0, 90.0, -1.0, -89.0, 179.0, 79.0].map(|degrees: f64| {
        let direction = degrees.to_radians();
        Segment {
            start: Point2::origin(),
            end: Point2::new(direction.cos(), direction.sin()),
            direction,
            reliability: 0.9,
            support: 50,
        }
    });
    for (name, params) in [("four-fold", Params::default()), ("bisector", Params::paper())] {
        match ogm_vector(&segments, &params).into_result() {
            Ok(vector) => {
                let [direction, theta] =
                    [vector.direction, vector.theta_ogm()].map(f64::to_degrees);
                let strength = vector.strength;
                println!(
                    "{name}: walls at {direction:.3}°, vector {theta:.3}°, strength {strength:.3}"
                );
            }
            Err(refusal) => println!("{name}: {refusal}"),
        }
    }
}
