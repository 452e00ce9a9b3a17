//! Refinement of a pose on the distance fields of both maps.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_core::Se2;

use crate::lattice::{Slope, floor_index};
use crate::parallel::both;
use crate::patches::centroid;
use crate::prepare::PreparedMap;
use crate::sides::Facing;
use crate::state::State;
use crate::wall_points::WallPoint;

/// Beyond so many scales a wall weighs less than a thousandth.
const FAR_SCALES: f64 = 6.0;
/// Where the scale of a polish starts, metres.
const POLISH_SCALE_M: f64 = 0.15;
/// Most steps of a polish.
const POLISH_STEPS: usize = 12;
/// A polish ends with a step of its centre below this, cells.
const CONVERGED_CELLS: f64 = 1e-3;
/// And a turn below this, radians.
const CONVERGED_RAD: f64 = 1e-6;
/// Wall points of each map in a polish.
pub(crate) const POLISH_POINTS: usize = 20_000;

/// Normal equations of the symmetric problem, about a centre.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Normal {
    /// Σ w J Jᵀ over (x, y, θ), turned about [`centre`](Self::centre).
    pub(crate) information: Matrix3<f64>,
    /// Σ w r J.
    pub(crate) gradient: Vector3<f64>,
    /// Σ w r², square metres.
    pub(crate) residual: f64,
    /// Σ w.
    pub(crate) weight: f64,
    /// In the frame of the first map.
    pub(crate) centre: Point2<f64>,
}

/// Which wall points a refinement uses.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Points {
    /// At most so many of each map.
    pub(crate) most: usize,
    /// By the sides from which both maps saw the wall.
    pub(crate) sides: Sides,
}

/// The two faces of one wall are not one place, so walls seen from opposite sides should not
/// attract. Wall in the free space of the other map counts always, for there it cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sides {
    /// All walls, for a pose too rough to compare sides.
    Any,
    /// Not walls seen from opposite sides.
    NotOpposite,
    /// Walls that face the same way within 60°, and only across: where a wall ends is where a
    /// robot stopped looking. Walls that both maps saw from both sides count too.
    Facing,
}

impl Sides {
    fn least_cosine(self) -> f64 {
        if self == Self::Facing { 0.5 } else { 0.0 }
    }

    /// How far wall of another map, at `at` and `facing`, is from the walls of `map`, unless
    /// that is too far to matter at `scale`.
    #[inline]
    fn pull(
        self,
        map: &PreparedMap,
        at: Point2<f64>,
        facing: impl FnOnce() -> Facing,
        scale: f64,
    ) -> Option<Slope> {
        let (slope, there) = map.surroundings(at)?;
        if slope.value > FAR_SCALES * scale {
            return None;
        }
        if self == Self::Any {
            return Some(slope);
        }
        let (facing, other) = (facing(), there.side.facing());
        let is_known = |facing: Facing| facing.normal != Vector2::zeros();
        let is_free = there.state == State::Free;
        let is_unknown = !(is_known(facing) || is_known(other));
        let counts = is_free || is_unknown || facing.agreement(other) >= self.least_cosine();
        let across = if self == Self::Facing && is_known(facing) {
            facing.normal * facing.normal.dot(&slope.gradient)
        } else {
            slope.gradient
        };
        counts.then_some(Slope { gradient: across, ..slope })
    }
}

/// Follows the walls of both maps from `first_from_second`, one Gauss–Newton step for each of
/// `scales` (metres at which a distance has lost three quarters of its weight), on `points`.
pub(crate) fn refine(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: Se2,
    scales: &[f64],
    points: Points,
) -> Se2 {
    let mut first_from_second = first_from_second;
    for &scale in scales {
        let normal = normal_equations(first, second, &first_from_second, scale, points);
        let Some(moved_from_first) = normal.motion(scale) else { break };
        first_from_second = moved_from_first * first_from_second;
    }
    first_from_second
}

/// Lets `walls` of one map follow the walls of `on` alone.
pub(crate) fn follow(
    on: &PreparedMap,
    walls: &[WallPoint],
    start_on_from_map: Se2,
    scales: &[f64],
) -> Se2 {
    let mean = centroid(walls);
    let mut on_from_map = start_on_from_map;
    for &scale in scales {
        let centre = on_from_map * mean;
        let mut sums = Sums { scale_sq: scale * scale, ..Sums::default() };
        for &WallPoint { at, facing } in walls {
            let place = on_from_map * at;
            let facing = || facing.turned(|normal| on_from_map * normal);
            if let Some(slope) = Sides::NotOpposite.pull(on, place, facing, scale) {
                sums.add(slope.value, slope.gradient, place - centre);
            }
        }
        let Some(moved_from_on) = sums.into_normal(centre).motion(scale) else { break };
        on_from_map = moved_from_on * on_from_map;
    }
    on_from_map
}

/// [`refine`] at scales that follow the residuals, so that what fits well is held to it: walls
/// beyond twice the typical residual lose their say.
pub(crate) fn polish(
    first: &PreparedMap,
    second: &PreparedMap,
    start_first_from_second: Se2,
) -> Se2 {
    let resolution = first.resolution().max(second.resolution());
    let points = Points { most: POLISH_POINTS, sides: Sides::Facing };
    let mut first_from_second = start_first_from_second;
    let mut scale = POLISH_SCALE_M.max(resolution);
    for _ in 0..POLISH_STEPS {
        let normal = normal_equations(first, second, &first_from_second, scale, points);
        let Some(moved_from_first) = normal.motion(scale) else { break };
        first_from_second = moved_from_first * first_from_second;
        let typical = (normal.residual / normal.weight.max(1e-9)).sqrt();
        let next = scale.min((2.0 * typical).max(0.4 * resolution));
        let step = (moved_from_first * normal.centre - normal.centre).norm();
        let has_converged = step < CONVERGED_CELLS * resolution
            && moved_from_first.theta().abs() < CONVERGED_RAD
            && next > 0.99 * scale;
        if has_converged {
            break;
        }
        scale = next;
    }
    first_from_second
}

/// Residuals are the distances of the walls of each map in the field of the other, weighted after
/// Geman and McClure: w = (σ²/(σ² + d²))².
fn normal_equations(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    scale: f64,
    points: Points,
) -> Normal {
    let centre = *first_from_second * second.centre;
    let none = || Sums { scale_sq: scale * scale, ..Sums::default() };
    let add = |mut sums: Sums, (place, slope): (Point2<f64>, Slope)| {
        sums.add(slope.value, slope.gradient, place - centre);
        sums
    };
    let (of_second, of_first) = both(
        || pulls_on_second(first, second, first_from_second, scale, points).fold(none(), add),
        || pulls_on_first(first, second, first_from_second, scale, points).fold(none(), add),
    );
    of_second.plus(&of_first).into_normal(centre)
}

/// The normal equations of each square of `side` metres in the frame of the first map, all about
/// one centre; errors of walls in one square are one error, from drift or from how cells were cut.
pub(crate) fn clustered_equations(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    scale: f64,
    points: Points,
    side: f64,
) -> Vec<Normal> {
    let centre = *first_from_second * second.centre;
    let mut clusters: BTreeMap<[usize; 2], Sums> = BTreeMap::new();
    let of_second = pulls_on_second(first, second, first_from_second, scale, points);
    let of_first = pulls_on_first(first, second, first_from_second, scale, points);
    for (place, slope) in of_second.chain(of_first) {
        let square = [place.x, place.y].map(|along| floor_index((along / side).max(0.0)));
        let sums = clusters
            .entry(square)
            .or_insert_with(|| Sums { scale_sq: scale * scale, ..Sums::default() });
        sums.add(slope.value, slope.gradient, place - centre);
    }
    clusters.into_values().map(|sums| sums.into_normal(centre)).collect()
}

/// Every wall point of the second map that counts: its place in the frame of the first, and how its
/// distance changes with a motion of the second.
fn pulls_on_second(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    scale: f64,
    points: Points,
) -> impl Iterator<Item = (Point2<f64>, Slope)> {
    pulls(first, second, *first_from_second, scale, points)
        .map(|(_, in_first, slope)| (in_first, slope))
}

/// [`pulls_on_second`] for the wall points of the first map in the field of the second.
fn pulls_on_first(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    scale: f64,
    points: Points,
) -> impl Iterator<Item = (Point2<f64>, Slope)> {
    let first_from_second = *first_from_second;
    pulls(second, first, first_from_second.inverse(), scale, points).map(move |(at, _, slope)| {
        (at, Slope { gradient: -(first_from_second * slope.gradient), ..slope })
    })
}

/// Every wall point of `map` that counts in the field of `on`, in both frames.
fn pulls(
    on: &PreparedMap,
    map: &PreparedMap,
    on_from_map: Se2,
    scale: f64,
    points: Points,
) -> impl Iterator<Item = (Point2<f64>, Point2<f64>, Slope)> {
    map.walls.iter().take(points.most).filter_map(move |&WallPoint { at, facing }| {
        let place = on_from_map * at;
        let facing = || facing.turned(|normal| on_from_map * normal);
        let slope = points.sides.pull(on, place, facing, scale)?;
        Some((at, place, slope))
    })
}

impl Normal {
    /// The step as a motion of the first frame, no longer than twice `scale`.
    fn motion(&self, scale: f64) -> Option<Se2> {
        let step = self.step()?;
        let limit = (2.0 * scale / step.xy().norm()).min(0.1 / step.z.abs()).min(1.0);
        let step = step * limit;
        Some(Se2::about(self.centre, step.z, step.xy()))
    }

    /// Lightly damped, so that a direction without information stays where it is.
    fn step(&self) -> Option<Vector3<f64>> {
        let mut damped = self.information;
        let translation = damped[(0, 0)].max(damped[(1, 1)]);
        for index in 0..2 {
            damped[(index, index)] += 1e-3 * translation + 1e-9;
        }
        damped[(2, 2)] += 1e-3 * damped[(2, 2)] + 1e-9;
        let step = damped.cholesky()?.solve(&-self.gradient);
        step.iter().all(|part| part.is_finite()).then_some(step)
    }
}

#[derive(Default)]
struct Sums {
    scale_sq: f64,
    /// Upper triangle: xx, xy, yy, xt, yt, tt.
    products: [f64; 6],
    gradient: [f64; 3],
    residual: f64,
    weight: f64,
}

impl Sums {
    #[inline]
    fn add(&mut self, distance: f64, slope: Vector2<f64>, arm: Vector2<f64>) {
        let root = self.scale_sq / (self.scale_sq + distance * distance);
        let weight = root * root;
        let turn = slope.y * arm.x - slope.x * arm.y;
        let (x, y) = (weight * slope.x, weight * slope.y);
        let products =
            [x * slope.x, x * slope.y, y * slope.y, x * turn, y * turn, weight * turn * turn];
        for (sum, product) in self.products.iter_mut().zip(products) {
            *sum += product;
        }
        let pull = weight * distance;
        self.gradient[0] += pull * slope.x;
        self.gradient[1] += pull * slope.y;
        self.gradient[2] += pull * turn;
        self.residual += pull * distance;
        self.weight += weight;
    }

    fn plus(mut self, other: &Self) -> Self {
        self.residual += other.residual;
        self.weight += other.weight;
        self.products.iter_mut().zip(other.products).for_each(|(sum, other)| *sum += other);
        self.gradient.iter_mut().zip(other.gradient).for_each(|(sum, other)| *sum += other);
        self
    }

    fn into_normal(self, centre: Point2<f64>) -> Normal {
        let [xx, xy, yy, xt, yt, tt] = self.products;
        Normal {
            information: Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt),
            gradient: Vector3::from(self.gradient),
            residual: self.residual,
            weight: self.weight,
            centre,
        }
    }
}
