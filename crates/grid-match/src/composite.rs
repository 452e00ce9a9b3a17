//! What it takes to match several maps laid together: a prepared map as a grid, and what to believe
//! of poses by their scores.

use nalgebra::Point2;
use ogm_core::{Grid, GridError, GridFrame, Occupancy, OccupancyGrid};

use crate::confidence::{Beliefs, probabilities};
use crate::prepare::PreparedMap;
use crate::state::State;
use crate::weights::WEIGHTS;

impl PreparedMap {
    /// The map as the search sees it: the faces of walls, free space, and nothing behind walls, at
    /// [`resolution`](Self::resolution), in the frame of the map.
    ///
    /// # Errors
    /// None for a map that was prepared.
    pub fn seen(&self) -> Result<OccupancyGrid, GridError> {
        let cells = self.state.iter().map(|state| match state {
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

/// Probability of each of several distinct poses, best first, that it is right, by the
/// [scores](crate::Evidence::score) of all that were tried: what a report would say of them.
/// `repeats` is [`MatchParams::repeats`](crate::MatchParams::repeats).
#[must_use]
pub fn pose_probabilities(scores: &[f64], repeats: bool) -> Vec<f64> {
    probabilities(scores, Beliefs { prior: 0.0, repeats }, &WEIGHTS)
}
