//! What it takes to match several maps laid together: a prepared map as a grid, and what to believe
//! of poses by their scores.

use nalgebra::Point2;
use ogm_core::{Grid, GridError, GridFrame, Occupancy, OccupancyGrid, Se2};

use crate::MatchError;
use crate::confidence::{Beliefs, probabilities};
use crate::prepare::PreparedMap;
use crate::refine::{Points, Sides, polish, refine};
use crate::state::State;
use crate::weights::WEIGHTS;

impl PreparedMap {
    /// The map as the search sees it: the faces of walls, free space, and nothing behind walls, at
    /// [`resolution`](Self::resolution), in the frame of the map.
    ///
    /// # Errors
    /// None for a map that was prepared.
    pub fn seen(&self) -> Result<OccupancyGrid, GridError> {
        let cells = self.cells.iter().map(|cell| match cell.state {
            State::Unknown => Occupancy::UNKNOWN,
            State::Free => Occupancy::FREE,
            State::Wall => Occupancy::OCCUPIED,
        });
        let cells = Grid::new(self.lattice.width, self.lattice.height, cells.collect())?;
        let frame = GridFrame::new(self.lattice.resolution, self.map_from_local)?;
        Ok(OccupancyGrid::new(frame, cells))
    }

    /// The middle of what the map knows, in its frame.
    #[must_use]
    pub fn centre(&self) -> Point2<f64> {
        self.map_from_local * self.centre
    }
}

/// Scales of a refinement, metres, none below a cell.
const SCALES: [f64; 6] = [0.3, 0.25, 0.2, 0.15, 0.1, 0.1];
/// Wall points of each map in it.
const POINTS: usize = 3000;

/// Lets a pose that is good to a few decimetres follow the walls of both maps, as a search does.
///
/// # Errors
/// A pose that is not finite.
pub fn refine_pose(
    target: &PreparedMap,
    source: &PreparedMap,
    target_from_source: &Se2,
) -> Result<Se2, MatchError> {
    target_from_source.check_finite()?;
    let start = target.map_from_local.inverse() * *target_from_source * source.map_from_local;
    let coarsest = target.resolution().max(source.resolution());
    let scales = SCALES.map(|scale| scale.max(coarsest));
    let points = Points { most: POINTS, sides: Sides::NotOpposite };
    let refined = refine(target, source, start, &scales, points);
    let polished = polish(target, source, refined);
    Ok(target.map_from_local * polished * source.map_from_local.inverse())
}

/// Probability of each of several distinct poses, best first, that it is right, by the
/// [scores](crate::Evidence::score) of all that were tried: what a report would say of them.
/// `repeats` is [`MatchParams::repeats`](crate::MatchParams::repeats).
#[must_use]
pub fn pose_probabilities(scores: &[f64], repeats: bool) -> Vec<f64> {
    probabilities(scores, Beliefs { prior: 0.0, repeats }, &WEIGHTS)
}
