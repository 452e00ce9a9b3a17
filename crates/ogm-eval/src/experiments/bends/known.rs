//! What the deformation could do if it were known where every wall belongs.

use std::collections::BTreeMap;

use map_warp::{Motion, Warp, WarpParams};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_merge::BendParams;

/// Side of the squares whose walls move as one, metres: with 1 the residuals are a twentieth less.
const SIDE_M: f64 = 2.0;
/// How surely their motions are known, metres and radians.
const SIGMA: (f64, f64) = (0.02, 0.03);

/// A wall of the source and the place where it would lie as the target shows it, both in the frame of
/// the source.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    pub(super) wall: Point2<f64>,
    pub(super) belongs: Point2<f64>,
}

/// How far walls lie from where they belong when `moved`, root mean square, metres.
pub(super) fn residual(shown: &[Shown], moved: impl Fn(Point2<f64>) -> Point2<f64>) -> f64 {
    let squares = shown.iter().map(|one| (moved(one.wall) - one.belongs).norm_squared());
    f64::sqrt(squares.sum::<f64>() / shown.len() as f64)
}

#[expect(clippy::cast_possible_truncation, reason = "saturates far from any map")]
fn square(place: Point2<f64>) -> [i64; 2] {
    [place.x, place.y].map(|along| (along / SIDE_M).floor() as i64)
}

/// The deformation fitted to where walls belong.
pub(super) fn warp(shown: &[Shown]) -> anyhow::Result<Warp> {
    let mut squares: BTreeMap<[i64; 2], Vec<Shown>> = BTreeMap::new();
    for &one in shown {
        squares.entry(square(one.wall)).or_default().push(one);
    }
    let motions: Vec<Motion> = squares.into_values().map(|walls| motion(&walls)).collect();
    // None of these motions lies.
    let params = WarpParams { outlier_sigmas: 1e3, ..BendParams::default().warp };
    Ok(Warp::fit(&motions, &params)?)
}

/// The motion of least squares of walls that move as one.
fn motion(walls: &[Shown]) -> Motion {
    let count = walls.len() as f64;
    let at = walls.iter().map(|one| one.wall.coords).sum::<Vector2<f64>>() / count;
    let to = walls.iter().map(|one| one.belongs.coords).sum::<Vector2<f64>>() / count;
    let arms = walls.iter().map(|one| (one.wall.coords - at, one.belongs.coords - to));
    let (cross, dot) = arms.fold((0.0, 0.0), |(cross, dot), (wall, belongs)| {
        (cross + wall.perp(&belongs), dot + wall.dot(&belongs))
    });
    let (shift, turn) = SIGMA;
    let sigmas = Vector3::new(shift, shift, turn);
    Motion {
        at: at.into(),
        shift: to - at,
        turn: f64::atan2(cross, dot),
        covariance: Matrix3::from_diagonal(&sigmas.component_mul(&sigmas)),
    }
}
