//! The line of a consensus, fitted to the wall that it is about.

use nalgebra::{Matrix2, Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::line::Line;
use crate::params::DirectionRule;
use crate::strip::Cell;

/// Pairs of cells that are tried.
const PAIRS: usize = 60;
/// Cells of a wall lie within so many distances of votes from a piece that cuts it: both faces, seen
/// from one that runs from the one to the other.
const BESIDE: f64 = 4.0;
/// Cells of one face lie within this share of the distance of votes from its axis: the other face of
/// a wall of a coarse map must not.
const NEAR: f64 = 0.6;
/// Fits at most; they settle in two or three.
const FITS: usize = 5;

/// A line with a unit normal, cells.
#[derive(Debug, Clone, Copy)]
struct Fitted {
    through: Point2<f64>,
    normal: Vector2<f64>,
}

impl Fitted {
    fn between(a: Cell, b: Cell) -> Option<Self> {
        let along = (point(b) - point(a)).try_normalize(0.0)?;
        Some(Self { through: point(a), normal: Vector2::new(-along.y, along.x) })
    }

    /// By total least squares.
    fn of(cells: impl Iterator<Item = Cell> + Clone) -> Option<Self> {
        let count = cells.clone().count();
        let sum: Vector2<f64> = cells.clone().map(|cell| point(cell).coords).sum();
        let through = Point2::from(sum / count as f64);
        let spread: Matrix2<f64> =
            cells.map(|cell| point(cell) - through).map(|offset| offset * offset.transpose()).sum();
        let turn = 0.5 * (2.0 * spread.m12).atan2(spread.m11 - spread.m22);
        let is_line = count >= 2 && spread.trace() > 0.0;
        is_line.then(|| Self { through, normal: Vector2::new(-turn.sin(), turn.cos()) })
    }

    fn distance(&self, cell: Cell) -> f64 {
        self.normal.dot(&(point(cell) - self.through)).abs()
    }

    /// How well and how many: 1 for a cell on the line, 0 from `reach` on (MSAC; Torr, Zisserman
    /// 2000).
    fn score(&self, cells: &[Cell], reach: f64) -> f64 {
        let of_cell = |&cell: &Cell| (1.0 - (self.distance(cell) / reach).powi(2)).max(0.0);
        cells.iter().map(of_cell).sum()
    }
}

fn point([x, y]: Cell) -> Point2<f64> {
    Point2::new(f64::from(x), f64::from(y))
}

/// `piece` as the wall that it is about: the line that the cells beside it are best fitted with
/// (LO-RANSAC; Chum, Matas, Kittler 2003), with those of its cells that lie along the piece.
///
/// A strip that runs from one face of a wall to the other, or on through the next walls, has as
/// many votes as one along a face; its cells lie further from its axis, though. `None` where no
/// line has cells.
pub(crate) fn settle(
    piece: &Line,
    cells: &[Cell],
    reach: f64,
    rng: &mut ChaCha8Rng,
) -> Option<Line> {
    let ends = piece.ends(DirectionRule::TotalLeastSquares);
    let along = (ends[1] - ends[0]).try_normalize(0.0)?;
    let length = (ends[1] - ends[0]).norm();
    let is_beside = |&cell: &Cell| {
        let offset = point(cell) - ends[0];
        let at = offset.dot(&along);
        along.perp(&offset).abs() < BESIDE * reach && (-reach..=length + reach).contains(&at)
    };
    let around: Vec<Cell> = cells.iter().copied().filter(is_beside).collect();
    let mut best = Fitted::of(piece.cells.iter().copied())?;
    let mut best_score = best.score(&around, NEAR * reach);
    for _ in 0..PAIRS {
        // Of the piece, so that it does not leave its wall for one with more cells.
        let [first, second] = [0; 2].map(|_| piece.cells[rng.random_range(0..piece.cells.len())]);
        let between = Fitted::between(first, second);
        let Some(mut fitted) = between else { continue };
        let mut score = fitted.score(&around, NEAR * reach);
        if score <= best_score {
            continue;
        }
        for _ in 0..FITS {
            let near = around.iter().copied().filter(|&cell| fitted.distance(cell) < NEAR * reach);
            let Some(next) = Fitted::of(near) else { break };
            let next_score = next.score(&around, NEAR * reach);
            if next_score <= score {
                break;
            }
            (fitted, score) = (next, next_score);
        }
        (best, best_score) = (fitted, score);
    }
    let near = around.into_iter().filter(|&cell| best.distance(cell) < reach);
    Line::new(near.collect(), DirectionRule::TotalLeastSquares)
}
