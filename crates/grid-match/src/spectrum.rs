//! Hough spectra: in which directions the walls of a map run, wherever they are.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::lattice::floor_index;
use crate::wall_points::WallPoint;

/// Angles of a spectrum over half a turn: a quarter of a degree.
pub(crate) const ANGLES: usize = 720;
/// Most wall points of a spectrum; more change nothing.
const MOST_POINTS: usize = 1000;
/// Where the points left of all walls would be further apart, metres, too few lie on any one wall.
const SPARSE_M: f64 = 2.0;
/// Then whole blocks of this side are taken, metres, so many that they hold about these points.
const BLOCK_M: f64 = 30.0;
const MOST_OF_BLOCKS: usize = 3000;
/// Angles of the window whose minimum counts as no direction at all.
const WINDOW: usize = 91;

/// Added to a number from 0 to this, it leaves the nearest whole number in the lowest bits; for many
/// numbers at once, where a conversion would look out for what fits no integer.
const WHOLE: f32 = 8_388_608.0;

/// Strength of every wall direction over half a turn, of mean 0 and norm 1, or all zero.
pub(crate) type Spectrum = Vec<f64>;

/// h(θ) = Σ_ρ HT(θ, ρ)², less its lower envelope, its root, then normalised (after Carpin, *Fast
/// and accurate map merging for multi-robot systems*, Autonomous Robots 25, 2008); of a large map
/// summed over blocks. A wall point stands for `spacing` metres.
pub(crate) fn hough_spectrum(walls: &[WallPoint], spacing: f64, bin: f64) -> Spectrum {
    let sampled = &walls[..walls.len().min(MOST_POINTS)];
    let power = if walls.len() as f64 * spacing <= SPARSE_M * sampled.len() as f64 {
        power(sampled, bin)
    } else {
        let of_blocks = blocks(walls).into_iter().map(|points| power(&points, bin));
        of_blocks.fold(vec![0.0; ANGLES], |sum, of_block| {
            sum.into_iter().zip(of_block).map(|(a, b)| a + b).collect()
        })
    };
    normalised(&above_envelope(&power))
}

/// Some blocks of a map, evenly spread.
fn blocks(walls: &[WallPoint]) -> Vec<Vec<WallPoint>> {
    let mut blocks: BTreeMap<[usize; 2], Vec<WallPoint>> = BTreeMap::new();
    for &wall in walls {
        let block = [wall.at.y, wall.at.x].map(|along| floor_index(along / BLOCK_M));
        blocks.entry(block).or_default().push(wall);
    }
    blocks.into_values().step_by(walls.len().div_ceil(MOST_OF_BLOCKS)).collect()
}

/// Σ_ρ HT(θ, ρ)² for every θ.
#[expect(clippy::cast_possible_truncation, reason = "places in bins, of single precision")]
fn power(points: &[WallPoint], bin: f64) -> Vec<f64> {
    if points.is_empty() {
        return vec![0.0; ANGLES];
    }
    let mean = points.iter().map(|wall| wall.at.coords).sum::<nalgebra::Vector2<f64>>()
        / points.len() as f64;
    let reach = points.iter().map(|wall| (wall.at.coords - mean).norm()).fold(0.0, f64::max);
    let middle = reach / bin + 1.0;
    let offsets: Vec<[f32; 2]> = points
        .iter()
        .map(|wall| (wall.at.coords - mean) / bin)
        .map(|offset| [offset.x as f32, offset.y as f32])
        .collect();
    let mut bins = vec![(0_u32, 0.0_f32); offsets.len()];
    // What falls to a bin and to the one above, side by side.
    let mut votes = vec![[0.0_f32; 2]; floor_index(2.0 * middle) + 2];
    let last = votes.len() - 1;
    (0..ANGLES)
        .map(|index| {
            let (sin, cos) = (index as f64 * PI / ANGLES as f64).sin_cos();
            let (sin, cos, middle) = (sin as f32, cos as f32, middle as f32);
            // Apart from the votes, for the places of several points are found at once.
            for (bin, [x, y]) in bins.iter_mut().zip(&offsets) {
                let rho = x * cos + y * sin + middle;
                let whole = rho - 0.5 + WHOLE;
                *bin = (whole.to_bits().wrapping_sub(WHOLE.to_bits()), rho - (whole - WHOLE));
            }
            votes.fill([0.0; 2]);
            for &(lower, upper) in &bins {
                let [low, high] = &mut votes[(lower as usize).min(last)];
                *low += 1.0 - upper;
                *high += upper;
            }
            let mut from_below = 0.0;
            let squares = votes.iter().map(|&[low, high]| {
                let vote = low + std::mem::replace(&mut from_below, high);
                f64::from(vote * vote)
            });
            squares.sum()
        })
        .collect()
}

/// The root of what stands above the smoothed running minimum.
fn above_envelope(power: &[f64]) -> Vec<f64> {
    let lowest: Vec<f64> = around(power)
        .windows(WINDOW)
        .map(|window| window.iter().copied().fold(f64::INFINITY, f64::min))
        .collect();
    let envelope = around(&lowest);
    let envelope = envelope.windows(WINDOW).map(|window| window.iter().sum::<f64>());
    let above = power.iter().zip(envelope).map(|(power, sum)| power - sum / WINDOW as f64);
    above.map(|above| above.max(0.0).sqrt()).collect()
}

/// Values of all angles, and so many more to both sides that each has a window around.
fn around(values: &[f64]) -> Vec<f64> {
    let turn = values.iter().copied().cycle();
    turn.skip(ANGLES - WINDOW / 2).take(ANGLES + WINDOW - 1).collect()
}

fn normalised(values: &[f64]) -> Spectrum {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let norm = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>().sqrt();
    let scale = if norm > 0.0 { 1.0 / norm } else { 0.0 };
    values.iter().map(|value| (value - mean) * scale).collect()
}

/// Correlation in [−1, 1] of `target` with `source` turned by each multiple of π/[`ANGLES`].
pub(crate) fn circular_correlation(target: &[f64], source: &[f64]) -> Vec<f64> {
    (0..ANGLES)
        .map(|shift| {
            let (head, tail) = target.split_at(shift);
            let turned = tail.iter().chain(head);
            turned.zip(source).map(|(a, b)| a * b).sum()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{ANGLES, circular_correlation, hough_spectrum};
    use crate::rotation::by_spectrum;
    use crate::wall_points::{WallPoint, scatter};
    use nalgebra::{Point2, Rotation2, Vector2};
    use ogm_core::wrap_angle;
    use proptest::prelude::{prop_assert, proptest};
    use std::f64::consts::{PI, TAU};

    /// Walls of lengths that no quarter turn exchanges.
    fn walls(turn: f64, shift: Vector2<f64>) -> Vec<WallPoint> {
        let line = |x: f64, y: f64, along: f64, length: f64| {
            let step = Vector2::new(along.cos(), along.sin()) * 0.1;
            let mut at = Point2::new(x, y);
            let mut points = Vec::new();
            for _ in 0..crate::lattice::floor_index(length / 0.1) {
                points.push(at);
                at += step;
            }
            points
        };
        let lines = [
            line(0.0, 0.0, 0.0, 12.0),
            line(0.0, 5.0, 0.0, 8.0),
            line(2.0, 0.0, PI / 2.0, 5.0),
            line(1.0, 1.0, 0.6, 5.0),
        ];
        let turn = Rotation2::new(turn);
        let facing = crate::sides::Facing::UNKNOWN;
        lines.concat().into_iter().map(|at| WallPoint { at: turn * at + shift, facing }).collect()
    }

    proptest! {
        #[test]
        fn the_rotation_between_two_sets_of_walls_is_the_best_peak(
            turn in -PI..PI, x in -50.0_f64..50.0, y in -50.0_f64..50.0,
        ) {
            let target = hough_spectrum(&walls(turn, Vector2::new(x, y)), 0.1, 0.1);
            let source = hough_spectrum(&walls(0.0, Vector2::zeros()), 0.1, 0.1);
            let best = by_spectrum(&target, &source, 4);
            let error = |found: f64| wrap_angle(found - turn).abs();
            prop_assert!(error(best[0]).min(error(best[1])) < 0.2_f64.to_radians(), "{best:?}");
        }
    }

    #[test]
    fn in_a_town_of_short_walls_their_directions_are_seen() {
        // Eight thousand walls of 8 m, strewn over a round town, in no order.
        let noise = |index: u64| (scatter(index) >> 11) as f64 / (1_u64 << 53) as f64;
        let town = |turn: f64, sample: u64| -> Vec<WallPoint> {
            let mut points: Vec<(u64, WallPoint)> = (0..8000 * 20)
                .map(|index| {
                    let (wall, along) = (index / 20, 0.4 * (index % 20) as f64);
                    let [x, y, side] = [0, 1, 2].map(|part| noise(3 * wall + part));
                    let way = if side < 0.7 { Vector2::x() } else { Vector2::y() };
                    let street = Rotation2::new(TAU * x) * Vector2::new(500.0 * y.sqrt(), 0.0);
                    let place = street + way * along;
                    let at = Rotation2::new(turn) * Point2::from(place) + Vector2::repeat(800.0);
                    (
                        scatter(index + sample),
                        WallPoint { at, facing: crate::sides::Facing::UNKNOWN },
                    )
                })
                .collect();
            points.sort_by_key(|(order, _)| *order);
            points.into_iter().map(|(_, point)| point).collect()
        };
        let [target, source] = [(0.4, 0), (0.0, 1_000_000)]
            .map(|(turn, sample)| hough_spectrum(&town(turn, sample), 0.4, 0.6));
        let best = by_spectrum(&target, &source, 4);
        let error = best.iter().map(|found| wrap_angle(found - 0.4).abs()).fold(PI, f64::min);
        assert!(error < 0.5_f64.to_radians(), "{best:?}");
    }

    #[test]
    fn a_spectrum_correlates_fully_with_itself_and_nothing_with_nothing() {
        let spectrum = hough_spectrum(&walls(0.3, Vector2::zeros()), 0.1, 0.1);
        assert!((circular_correlation(&spectrum, &spectrum)[0] - 1.0).abs() < 1e-9);
        let nothing = hough_spectrum(&[], 0.1, 0.1);
        assert_eq!(circular_correlation(&nothing, &spectrum), vec![0.0; ANGLES]);
        assert!(by_spectrum(&nothing, &spectrum, 4).is_empty());
    }
}
