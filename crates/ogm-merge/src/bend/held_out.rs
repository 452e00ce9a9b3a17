//! Whether walls that took no part in a fit lie better by it.

use std::collections::BTreeMap;

use map_warp::Warp;
use nalgebra::Point2;
use ogm_core::Se2;

use super::walls::{Wall, Walls, square};

/// Side of the squares that are held out together, and whose errors count as one, metres: walls
/// nearer to each other were seen by the same scans.
const SQUARE_M: f64 = 1.0;
/// Walls beyond this are not the same, metres.
const REACH_M: f64 = 0.5;
/// Cells at which a distance counts half.
const HALF_CELLS: f64 = 2.0;
const FEWEST_SQUARES: usize = 6;

/// Which half of the walls a wall belongs to: squares of a chessboard.
pub(super) fn half(at: Point2<f64>) -> usize {
    let [column, row] = square(at.coords, SQUARE_M);
    usize::from((column + row).rem_euclid(2) == 1)
}

/// What walls say of a fit in which they had no part.
#[derive(Debug, Clone, Default)]
pub(super) struct Held {
    /// By square: loss before, loss after.
    squares: BTreeMap<[i64; 2], [f64; 2]>,
}

impl Held {
    /// Adds the `points` of one half, before and after being bent by `warp`.
    pub(super) fn add<'a>(
        &mut self,
        target: &Walls,
        points: impl Iterator<Item = &'a Wall>,
        warp: &Warp,
        scale: f64,
    ) {
        for wall in points.filter(|wall| wall.normal.is_some()) {
            let losses = [None, Some(warp)].map(|warp| loss(target, wall, warp, scale));
            if losses.iter().all(|loss| *loss == 1.0) {
                continue;
            }
            let sums = self.squares.entry(square(wall.at.coords, SQUARE_M)).or_default();
            for (sum, loss) in sums.iter_mut().zip(losses) {
                *sum += loss;
            }
        }
    }

    /// How many standard scores the walls lie better, squares taken as independent: the sum of the
    /// gains over the root of the sum of their squares.
    pub(super) fn score(&self) -> f64 {
        let gains = self.squares.values().map(|[before, after]| before - after);
        let squares: f64 = gains.clone().map(|gain| gain * gain).sum();
        if self.squares.len() < FEWEST_SQUARES || squares <= 0.0 {
            return 0.0;
        }
        gains.sum::<f64>() / squares.sqrt()
    }

    /// The losses in all, after over before; 1 where there are none.
    pub(super) fn left(&self) -> f64 {
        let sum = |which: usize| self.squares.values().map(|losses| losses[which]).sum::<f64>();
        if sum(0) > 0.0 { sum(1) / sum(0) } else { 1.0 }
    }

    pub(super) fn squares(&self) -> usize {
        self.squares.len()
    }
}

pub(super) fn scale(target: &Walls, source: &Walls) -> f64 {
    HALF_CELLS * target.resolution.max(source.resolution)
}

/// How badly a wall lies, after Geman and McClure: 0 on a wall, 1 far from any.
fn loss(target: &Walls, wall: &Wall, warp: Option<&Warp>, scale: f64) -> f64 {
    let (place, turn) = match warp {
        Some(warp) => {
            let jacobian = warp.jacobian(wall.at);
            let turn = (jacobian[(1, 0)] - jacobian[(0, 1)]).atan2(jacobian.trace());
            (warp.apply(wall.at), turn)
        }
        None => (wall.at, 0.0),
    };
    let turned_from_map = Se2::new(0.0, 0.0, turn);
    let nearest = target.nearest(place, wall, &turned_from_map, REACH_M);
    nearest.map_or(1.0, |nearest| {
        let squared = nearest.off(place).norm_squared();
        squared / (squared + scale * scale)
    })
}
