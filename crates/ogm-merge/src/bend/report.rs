//! How far a map was bent, where, and what walls say of it.

use map_warp::{Warp, warp_grid};
use nalgebra::{Point2, Vector2};
use ogm_core::{CellIndex, ClassThresholds, OccupancyGrid, Progress};

use super::held_out::Held;
use super::params::BendParams;
use crate::MergeError;
use crate::merge::Component;
use crate::parallel::map_in_order;

/// Losses of held-out walls that are left at most, of those before: less is not worth a bend.
const WORTH: f64 = 0.8;
/// How far a wall must lie at least from where a rigid motion puts it, cells of the coarser map: the
/// fusion takes walls that are nearer to each other for one.
const LEAST_CELLS: f64 = 1.5;

/// How a map is bent against another, and whether that is believed.
#[derive(Debug, Clone)]
pub struct BendReport {
    /// From the map as it is to where its walls belong, in the frame of the map.
    pub warp: Warp,
    /// Whether walls that were held out of the fit lie significantly better by it.
    pub is_borne_out: bool,
    /// By how many standard scores they do.
    pub score: f64,
    /// How badly they lie after it, of how badly they did before: 0.3 is a good bend.
    pub loss_left: f64,
    /// Squares of a metre with held-out wall that is near wall of the other map.
    pub squares: usize,
    /// How far the walls of the map move, root mean square, metres.
    pub rms_m: f64,
    /// And at most.
    pub max_m: f64,
    /// The wall that moves most, in the map as it is, metres.
    pub at: Point2<f64>,
    /// Median standard deviation of where a wall lies after it, metres.
    pub sigma_m: f64,
    /// Patches that followed the other map.
    pub patches: usize,
    /// Those of them that the others contradict, which were left out.
    pub contradicted: usize,
    thresholds: ClassThresholds,
}

impl BendReport {
    pub(super) fn new(
        warp: Warp,
        patches: usize,
        held: &Held,
        (walls, cell): (&[Point2<f64>], f64),
        params: &BendParams,
    ) -> Self {
        let bends = map_in_order(walls, |place| warp.displacement(*place));
        let rigid = warp.straight_from_map();
        let moved =
            |(place, bend): (&Point2<f64>, &Vector2<f64>)| (rigid * (place + bend) - place).norm();
        let moves: Vec<f64> = walls.iter().zip(&bends).map(moved).collect();
        let squares: f64 = moves.iter().map(|moved| moved * moved).sum();
        let farthest = walls.iter().zip(&moves).max_by(|a, b| a.1.total_cmp(b.1));
        // A hundred say what is typical.
        let stride = (walls.len() / 100).max(1);
        let typical: Vec<Point2<f64>> = walls.iter().step_by(stride).copied().collect();
        let mut sigmas = map_in_order(&typical, |place| warp.sigma(*place));
        sigmas.sort_by(f64::total_cmp);
        let contradicted = warp.believed().iter().filter(|believed| !**believed).count();
        let (score, loss_left) = (held.score(), held.left());
        let most = bends.iter().map(Vector2::norm).fold(0.0, f64::max);
        let is_worth_it = loss_left <= WORTH && most >= LEAST_CELLS * cell;
        Self {
            is_borne_out: score >= params.significance && is_worth_it,
            score,
            loss_left,
            squares: held.squares(),
            rms_m: (squares / walls.len().max(1) as f64).sqrt(),
            max_m: farthest.map_or(0.0, |(_, moved)| *moved),
            at: farthest.map_or_else(Point2::origin, |(place, _)| *place),
            sigma_m: sigmas.get(sigmas.len() / 2).copied().unwrap_or(0.0),
            patches,
            contradicted,
            thresholds: params.thresholds,
            warp,
        }
    }

    /// How far a place of the map moves, along the axes of the map, metres.
    #[must_use]
    pub fn motion(&self, place: Point2<f64>) -> Vector2<f64> {
        self.warp.apply(place) - place
    }

    /// Known places of the map, one in each square of `every_m` metres, and how far each moves.
    #[must_use]
    pub fn motions(&self, map: &OccupancyGrid, every_m: f64) -> Vec<(Point2<f64>, Vector2<f64>)> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let step = ((every_m / map.frame().resolution()) as usize).max(1);
        let is_on = |at: &CellIndex| at.column % step == step / 2 && at.row % step == step / 2;
        let known = map.cells().indexed().filter(|(at, cell)| cell.is_known() && is_on(at));
        let places = known.map(|(at, _)| map.frame().cell_centre(at));
        places.map(|place| (place, self.motion(place))).collect()
    }

    /// The map made straight, in its own frame: the pose that it lies at stays what it is.
    ///
    /// # Errors
    /// A map that would be too large, or a call that was cancelled.
    pub fn straightened(
        &self,
        map: &OccupancyGrid,
        progress: &dyn Progress,
    ) -> Result<OccupancyGrid, MergeError> {
        Ok(warp_grid(map, &self.warp, &self.thresholds, progress)?)
    }
}

/// A component whose maps were made straight.
#[derive(Debug, Clone)]
pub struct BentComponent {
    /// The component, at the same poses; of a map that was made straight, `bend_m` is what is left.
    pub component: Component,
    /// Its members but the first, in their order.
    pub maps: Vec<BentMap>,
}

/// A map of a component, and how it is bent.
#[derive(Debug, Clone)]
pub struct BentMap {
    /// Which map, from 0.
    pub map: usize,
    /// How it is bent against those before it.
    pub report: BendReport,
    /// The map made straight, where that is borne out.
    pub straight: Option<OccupancyGrid>,
}

impl BentComponent {
    /// `maps` with those that were made straight in the place of what they were.
    #[must_use]
    pub fn straight<'a>(&'a self, maps: &[&'a OccupancyGrid]) -> Vec<&'a OccupancyGrid> {
        let mut straight = maps.to_vec();
        for bent in &self.maps {
            if let Some((place, map)) = straight.get_mut(bent.map).zip(bent.straight.as_ref()) {
                *place = map;
            }
        }
        straight
    }
}
