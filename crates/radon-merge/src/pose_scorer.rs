//! How walls of two maps fall on each other under a pose.

use nalgebra::Point2;
use ogm_core::{CellIndex, ClassThresholds, Grid, OccupancyGrid, Se2};

use crate::verify::WallField;

/// By which walls a pose is scored.
pub(crate) struct Sampling {
    /// Walls that are this near to one of the other map meet it, cells.
    pub(crate) reach: f64,
    /// Most walls of a map.
    pub(crate) samples: usize,
}

/// Scores a pose by how sampled walls of each map fall on the other.
pub(crate) struct PoseScorer {
    target: Field,
    source: Field,
}

struct Field {
    grid_from_map: Se2,
    resolution: f64,
    /// 1 where a wall is near, −1 on free space away from walls, 0 where nothing is known.
    votes: Grid<i8>,
    /// Walls of the map.
    samples: Vec<Point2<f64>>,
}

impl PoseScorer {
    pub(crate) fn new(
        target: &WallField<'_>,
        source: &WallField<'_>,
        thresholds: &ClassThresholds,
        sampling: &Sampling,
    ) -> Self {
        let field = |walls: &WallField<'_>| Field::new(walls, thresholds, sampling);
        Self { target: field(target), source: field(source) }
    }

    /// See [`Hypothesis::score`].
    pub(crate) fn score(&self, target_from_source: &Se2) -> f64 {
        let votes = self.target.votes_on(&self.source.samples, target_from_source)
            + self.source.votes_on(&self.target.samples, &target_from_source.inverse());
        f64::from(votes) / (self.source.samples.len() + self.target.samples.len()).max(1) as f64
    }
}

impl Field {
    fn new(walls: &WallField<'_>, thresholds: &ClassThresholds, sampling: &Sampling) -> Self {
        let map: &OccupancyGrid = walls.map;
        let reach_sq = sampling.reach * sampling.reach;
        let mut votes = walls.distance_sq.map(|&d| i8::from(f64::from(d) <= reach_sq));
        for (vote, &cell) in votes.cells_mut().iter_mut().zip(map.cells().cells()) {
            if *vote == 0 && thresholds.is_free(cell) {
                *vote = -1;
            }
        }
        let every = walls.walls.len().div_ceil(sampling.samples).max(1);
        Self {
            grid_from_map: map.frame().map_from_grid().inverse(),
            resolution: map.frame().resolution(),
            votes,
            samples: walls.walls.iter().step_by(every).copied().collect(),
        }
    }

    fn votes_on(&self, samples: &[Point2<f64>], this_from_other: &Se2) -> i32 {
        let grid_from_other = self.grid_from_map * *this_from_other;
        let (sin, cos) = grid_from_other.theta().sin_cos();
        let scale = 1.0 / self.resolution;
        let votes = samples.iter().map(|point| {
            let x = (cos * point.x - sin * point.y + grid_from_other.x()) * scale;
            let y = (sin * point.x + cos * point.y + grid_from_other.y()) * scale;
            if !(x >= 0.0 && y >= 0.0) {
                return 0;
            }
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "not negative; what is too large lies outside"
            )]
            let cell = CellIndex { column: x as usize, row: y as usize };
            if cell.row >= self.votes.height() {
                return 0;
            }
            self.votes.get(cell).map_or(0, |&vote| i32::from(vote))
        });
        votes.sum()
    }
}
