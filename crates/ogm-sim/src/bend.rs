//! What remains of drift after a loop is closed: a map that is bent, but in one piece.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{PI, TAU};

/// Waves that add up to a bend.
const WAVES: usize = 3;
/// Shortest and longest wave, metres: a loop of a corridor, a building.
const WAVELENGTH: [f64; 2] = [15.0, 60.0];

/// A smooth displacement of the poses that a robot believes in; its scans are displaced with them,
/// each in one piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bend {
    waves: [Wave; WAVES],
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Wave {
    amplitude: Vector2<f64>,
    /// Radians a metre.
    number: Vector2<f64>,
    phase: f64,
}

impl Bend {
    /// A bend of `sigma` metres standard deviation an axis, averaged over places.
    pub(crate) fn draw(sigma: f64, rng: &mut ChaCha8Rng) -> Self {
        let amplitude = 2.0 * sigma / (WAVES as f64).sqrt();
        let waves = std::array::from_fn(|_| {
            let length = rng.random_range(WAVELENGTH[0]..WAVELENGTH[1]);
            let (sin, cos) = rng.random_range(-PI..PI).sin_cos();
            let turn: f64 = rng.random_range(-PI..PI);
            Wave {
                amplitude: Vector2::new(turn.cos(), turn.sin()) * amplitude,
                number: Vector2::new(cos, sin) * (TAU / length),
                phase: rng.random_range(-PI..PI),
            }
        });
        Self { waves }
    }

    /// How far a place is displaced, along the axes of the plan, metres.
    pub(crate) fn shift(&self, at: Point2<f64>) -> Vector2<f64> {
        let waves = self.waves.iter();
        waves.map(|wave| wave.amplitude * (wave.number.dot(&at.coords) + wave.phase).sin()).sum()
    }

    /// How far the surroundings of a place are turned, radians: half the curl.
    pub(crate) fn turn(&self, at: Point2<f64>) -> f64 {
        let waves = self.waves.iter();
        waves
            .map(|wave| {
                let slope = (wave.number.dot(&at.coords) + wave.phase).cos();
                0.5 * wave.number.perp(&wave.amplitude) * slope
            })
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::Bend;
    use crate::draw::{Stream, generator};
    use nalgebra::{Point2, Vector2};

    #[test]
    fn bends_are_as_large_as_asked_for() {
        let mut squares = 0.0;
        let mut count = 0.0;
        for seed in 0..200 {
            let bend = Bend::draw(0.2, &mut generator(seed, Stream::Bend, 0));
            for step in 0..40 {
                let at = Point2::new(f64::from(step) * 7.0, f64::from(step % 7) * 11.0);
                squares += bend.shift(at).norm_squared() / 2.0;
                count += 1.0;
            }
        }
        let sigma = f64::sqrt(squares / count);
        assert!((sigma - 0.2).abs() < 0.01, "{sigma}");
    }

    #[test]
    fn a_turn_is_that_of_two_places_side_by_side() {
        let bend = Bend::draw(0.3, &mut generator(4, Stream::Bend, 1));
        let (at, step) = (Point2::new(3.0, -8.0), 1e-4);
        let slope = |along: Vector2<f64>| {
            (bend.shift(at + along * step) - bend.shift(at - along * step)) / (2.0 * step)
        };
        let curl = slope(Vector2::x()).y - slope(Vector2::y()).x;
        assert!((bend.turn(at) - curl / 2.0).abs() < 1e-7, "{} {curl}", bend.turn(at));
    }
}
