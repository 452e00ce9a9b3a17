//! How a patch of a map must move to lie on the walls of another.

use map_warp::{Motion, Warp};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_core::Se2;

use super::walls::{Wall, Walls};

/// Steps of Gauss-Newton; each looks up the nearest walls anew.
const STEPS: usize = 6;
/// A turn of a patch that is as large as a shift by the reach: on a patch of some metres, radians.
const TURN_REACH: f64 = 0.08;
/// Points in a row whose errors are one error: of some two metres of wall, which the same scans saw
/// and which were cut into cells at one angle.
const ALIKE: f64 = 20.0;

/// How far a patch may have to move where its walls say nothing, as along a corridor, metres and
/// radians: that it did not move there is no evidence.
const OPEN: (f64, f64) = (5.0, 0.5);
/// How far walls are cut wrongly together, by who made the map, in cells; and the square of how far
/// they lie from the middle of a patch, for what that does to its turn.
const CUT_CELLS: f64 = 0.5;
const SPREAD_M_SQ: f64 = 1.5 * 1.5;

/// A patch follows the walls of `target` within `reach` metres from where `warp` puts it: `walls`
/// with these places.
pub(super) fn motion(
    target: &Walls,
    warp: &Warp,
    walls: Vec<(Wall, Point2<f64>)>,
    reach: f64,
) -> Option<Motion> {
    let sum: Vector2<f64> = walls.iter().map(|(wall, _)| wall.at.coords).sum();
    let at = Point2::from(sum / walls.len() as f64);
    let jacobian = warp.jacobian(at);
    let turn = (jacobian[(1, 0)] - jacobian[(0, 1)]).atan2(jacobian.trace());
    let centre = warp.apply(at);
    let placed = Placed { walls, turn, centre };
    let mut moved_from_placed = Se2::identity();
    let mut last = Normal::default();
    for step in 0..STEPS {
        // Far walls first, then near ones only.
        let scale = reach * 0.8_f64.powi(i32::try_from(step).unwrap_or(0));
        last = Normal::new(target, &placed, &moved_from_placed, reach, scale);
        let motion = last.information(reach, scale).cholesky()?.solve(&-last.slope);
        let limit = (reach / motion.xy().norm()).min(TURN_REACH / motion.z.abs()).min(1.0);
        let motion = motion * limit;
        let here = moved_from_placed * centre;
        moved_from_placed = Se2::about(here, motion.z, motion.xy()) * moved_from_placed;
    }
    let has_line = placed.walls.iter().any(|(wall, _)| wall.normal.is_some());
    if !has_line || last.weight <= 0.0 {
        return None;
    }
    let moved = moved_from_placed * centre;
    let is_near = (moved - centre).norm() <= 1.5 * reach
        && moved_from_placed.theta().abs() <= 1.5 * TURN_REACH;
    is_near.then_some(())?;
    let variance = (last.squares / last.weight).max((0.3 * target.resolution).powi(2));
    let sigma = (ALIKE * variance).sqrt();
    let open = Vector3::new(OPEN.0, OPEN.0, OPEN.1).map(|most| (sigma / most).powi(2));
    let known = last.products + Matrix3::from_diagonal(&open);
    let cut = (CUT_CELLS * target.resolution).powi(2);
    let cut = Matrix3::from_diagonal(&Vector3::new(cut, cut, cut / SPREAD_M_SQ));
    let covariance = known.try_inverse()? * sigma.powi(2) + cut;
    let covariance = 0.5 * (covariance + covariance.transpose());
    Some(Motion { at, shift: moved - at, turn: turn + moved_from_placed.theta(), covariance })
}

/// The walls of a patch where a deformation puts them.
struct Placed {
    walls: Vec<(Wall, Point2<f64>)>,
    turn: f64,
    /// The middle of the patch.
    centre: Point2<f64>,
}

/// The sums of the residuals of a patch: shifts along the axes and a turn about its centre.
#[derive(Default)]
struct Normal {
    products: Matrix3<f64>,
    slope: Vector3<f64>,
    squares: f64,
    weight: f64,
}

impl Normal {
    /// Residuals are distances to the nearest walls, weighted after Geman and McClure.
    fn new(
        target: &Walls,
        placed: &Placed,
        moved_from_placed: &Se2,
        reach: f64,
        scale: f64,
    ) -> Self {
        let mut sums = Self::default();
        let turned_from_map = Se2::new(0.0, 0.0, placed.turn + moved_from_placed.theta());
        let centre = *moved_from_placed * placed.centre;
        for (wall, place) in &placed.walls {
            let place = *moved_from_placed * *place;
            let Some(nearest) = target.nearest(place, wall, &turned_from_map, reach) else {
                continue;
            };
            let off = nearest.off(place);
            let root = scale * scale / (scale * scale + off.norm_squared());
            let weight = root * root;
            let arm = place - centre;
            let mut add = |direction: Vector2<f64>| {
                let row = Vector3::new(direction.x, direction.y, arm.perp(&direction));
                let residual = direction.dot(&off);
                sums.products += weight * row * row.transpose();
                sums.slope += weight * residual * row;
            };
            match nearest.normal {
                Some(normal) => add(normal),
                // Ends and corners hold a wall along itself.
                None => [Vector2::x(), Vector2::y()].into_iter().for_each(&mut add),
            }
            sums.squares += weight * off.norm_squared();
            sums.weight += weight;
        }
        sums
    }

    /// With what is known before: a patch moves by about its reach at most. `sigma` is that of a
    /// residual, metres.
    fn information(&self, reach: f64, sigma: f64) -> Matrix3<f64> {
        let before = Vector3::new(reach, reach, TURN_REACH).map(|most| (sigma / most).powi(2));
        self.products + Matrix3::from_diagonal(&before)
    }
}
