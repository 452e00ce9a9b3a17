//! Whether walls that took no part in a fit lie better by it.

use std::collections::BTreeMap;

use map_warp::Warp;
use nalgebra::Point2;
use ogm_core::Se2;

use crate::parallel::map_in_order;

use super::walls::{Wall, Walls, square};

/// Side of the squares that are held out together, and whose errors count as one, metres: walls
/// nearer to each other were seen by the same scans.
const SQUARE_M: f64 = 1.0;
/// Walls beyond this are not the same, metres.
const REACH_M: f64 = 0.5;
/// Distance at which a wall counts half: cells of the coarser map, and metres at least, for the
/// noise of ranges does not shrink with the cells.
const HALF_CELLS: f64 = 2.0;
const HALF_M: f64 = 0.1;
/// Share of that distance that is the rounding of walls to cells, and counts nothing: a quarter is
/// half a cell. Without it a shift of a third of a cell is significant in a large map.
const ROUNDING: f64 = 0.25;
const FEWEST_SQUARES: usize = 6;

/// Parts of the walls that are held out in turn: two, for what a part says is judged by a fit that
/// had none of it, and the fits have nothing in common.
pub(super) const PARTS: i64 = 2;

/// Which part of the walls a wall belongs to: squares of a chessboard.
pub(super) fn part(at: Point2<f64>) -> i64 {
    let [column, row] = square(at.coords, SQUARE_M);
    (column + row).rem_euclid(PARTS)
}

/// How badly the walls of a square lie: as they are, under the rigid part of a fit, under the fit.
#[derive(Debug, Clone, Copy, Default)]
struct Losses {
    still: f64,
    rigid: f64,
    bent: f64,
}

/// What walls say of a fit in which they had no part.
#[derive(Debug, Clone, Default)]
pub(super) struct Held {
    squares: BTreeMap<[i64; 2], Losses>,
}

impl Held {
    /// Adds the `walls` of one part, as they are and moved by the `warp` that the others gave.
    pub(super) fn add<'a>(
        &mut self,
        target: &Walls,
        walls: impl Iterator<Item = &'a Wall>,
        warp: &Warp,
        half_m: f64,
    ) {
        let rigid = warp.straight_from_map();
        let losses = |wall: &&Wall| {
            let jacobian = warp.jacobian(wall.at);
            let turn = (jacobian[(1, 0)] - jacobian[(0, 1)]).atan2(jacobian.trace());
            let loss = |place, turn| loss(target, wall, place, turn, half_m);
            Losses {
                still: loss(wall.at, 0.0),
                rigid: loss(rigid * wall.at, rigid.theta()),
                bent: loss(warp.apply(wall.at), turn),
            }
        };
        let walls: Vec<&Wall> = walls.filter(|wall| wall.normal.is_some()).collect();
        for (wall, losses) in walls.iter().zip(map_in_order(&walls, losses)) {
            if losses.still == 1.0 && losses.bent == 1.0 {
                continue;
            }
            let sums = self.squares.entry(square(wall.at.coords, SQUARE_M)).or_default();
            sums.still += losses.still;
            sums.rigid += losses.rigid;
            sums.bent += losses.bent;
        }
    }

    /// Where the walls lie without a bend: a better pose of the whole map is none.
    fn unbent(&self) -> impl Fn(&Losses) -> f64 {
        let sum = |loss: fn(&Losses) -> f64| self.squares.values().map(loss).sum::<f64>();
        let is_moved = sum(|losses| losses.rigid) < sum(|losses| losses.still);
        move |losses| if is_moved { losses.rigid } else { losses.still }
    }

    /// How many standard scores the walls lie better, squares taken as independent: the sum of the
    /// gains over the root of the sum of their squares.
    pub(super) fn score(&self) -> f64 {
        let unbent = self.unbent();
        let gains = self.squares.values().map(|losses| unbent(losses) - losses.bent);
        let squares: f64 = gains.clone().map(|gain| gain * gain).sum();
        if self.squares.len() < FEWEST_SQUARES || squares <= 0.0 {
            return 0.0;
        }
        gains.sum::<f64>() / squares.sqrt()
    }

    /// The losses in all, bent over unbent; 1 where there are none.
    pub(super) fn left(&self) -> f64 {
        let unbent: f64 = self.squares.values().map(self.unbent()).sum();
        let bent: f64 = self.squares.values().map(|losses| losses.bent).sum();
        if unbent > 0.0 { bent / unbent } else { 1.0 }
    }

    pub(super) fn squares(&self) -> usize {
        self.squares.len()
    }
}

/// The distance at which a wall counts half, metres.
pub(super) fn half_m(target: &Walls, source: &Walls) -> f64 {
    (HALF_CELLS * target.resolution.max(source.resolution)).max(HALF_M)
}

/// How badly a wall lies, after Geman and McClure: 0 on a wall, 1 far from any.
fn loss(target: &Walls, wall: &Wall, place: Point2<f64>, turn: f64, half_m: f64) -> f64 {
    let turned_from_map = Se2::new(0.0, 0.0, turn);
    let nearest = target.nearest(place, wall, &turned_from_map, REACH_M);
    nearest.map_or(1.0, |nearest| {
        let off = (nearest.off(place).norm() - ROUNDING * half_m).max(0.0);
        off * off / (off * off + half_m * half_m)
    })
}
