//! What is computed of one map alone, whatever it is matched with.

use std::cmp::Ordering;

use nalgebra::{Point2, Vector2};
use ogm_core::{Cancelled, ClassThresholds, OccupancyGrid, Progress, Se2};

use crate::crop::Crop;
use crate::lattice::{Lattice, Slope};
use crate::parallel::both;
use crate::patches::{Patch, patches};
use crate::sides::sides;
use crate::spectrum::{Spectrum, hough_spectrum};
use crate::state::State;
use crate::surroundings::{Surroundings, surroundings};
use crate::wall_distance::wall_distance;
use crate::wall_points::{WallPoint, Walls};

/// Least metres of wall that a point stands for.
const SPACING_M: f64 = 0.1;
/// Most sampled cells that stand for the known area.
const MOST_SAMPLES: usize = 6000;

/// What a matcher needs of one map: where its walls are, how far every place is from them, from
/// which side they were seen. Make it once for a map that is matched several times.
#[derive(Debug, Clone)]
pub struct PreparedMap {
    /// Metres, x and y from the corner of the padded crop along the axes of the grid.
    pub(crate) map_from_local: Se2,
    pub(crate) lattice: Lattice,
    pub(crate) cells: Vec<Surroundings>,
    /// In the order of [`LEVELS`](crate::wall_points::LEVELS).
    pub(crate) walls: Vec<WallPoint>,
    /// The same walls by the square that they stand in.
    pub(crate) patches: Vec<Patch>,
    /// Metres of wall that a point stands for.
    pub(crate) spacing: f64,
    pub(crate) samples: Vec<AreaSample>,
    /// Square metres that a sample stands for.
    pub(crate) sample_area: f64,
    /// Centroid of the known cells, local.
    pub(crate) centre: Point2<f64>,
    pub(crate) occupied_cells: usize,
    pub(crate) spectrum: Spectrum,
}

/// The centre of a known cell, local frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AreaSample {
    pub(crate) at: Point2<f64>,
    pub(crate) free: bool,
}

impl PreparedMap {
    /// Prepares `map`. Maps of more than 2²⁴ known cells are searched on larger cells; where in each
    /// its wall lies is kept.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        map: &OccupancyGrid,
        thresholds: &ClassThresholds,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        progress.go_on(0.0)?;
        let crop = Crop::of(map, thresholds);
        progress.go_on(0.25)?;
        let Crop { state, lattice, map_from_local, offsets } = crop;
        let occupied_cells = count(&state, State::Wall);
        let (distance, sides) =
            both(|| wall_distance(&state, &lattice), || sides(&state, &lattice));
        progress.go_on(0.85)?;
        let spacing = SPACING_M.max(1.01 * lattice.resolution);
        let walls = Walls { state: &state, sides: &sides, lattice: &lattice, offsets: &offsets };
        let walls = walls.points(spacing);
        let (samples, sample_area) = area_samples(&state, &lattice);
        let centre = centroid(&samples);
        let cells = distance
            .into_iter()
            .zip(sides)
            .zip(state)
            .map(|((distance, side), state)| Surroundings { distance, side, state })
            .collect();
        let bin = SPACING_M.max(1.5 * lattice.resolution);
        let spectrum = hough_spectrum(&walls, spacing, bin);
        progress.report(1.0);
        Ok(Self {
            map_from_local,
            lattice,
            cells,
            patches: patches(&walls),
            walls,
            spacing,
            samples,
            sample_area,
            centre,
            occupied_cells,
            spectrum,
        })
    }

    /// Metres a cell that the search works on.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        self.lattice.resolution
    }

    /// How far the nearest wall is from `at`, local, and what else is said there.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as that which it calls")]
    pub(crate) fn surroundings(&self, at: Point2<f64>) -> Option<(Slope, Surroundings)> {
        surroundings(&self.cells, &self.lattice, at)
    }

    /// Metres of wall in the map.
    #[must_use]
    pub fn wall_length(&self) -> f64 {
        self.walls.len() as f64 * self.spacing
    }

    /// Square metres that the map knows.
    #[must_use]
    pub fn known_area(&self) -> f64 {
        self.samples.len() as f64 * self.sample_area
    }

    /// An order of maps by what they hold, equal only where all cells are: for whoever must take
    /// several one after the other and get the same answer however they came.
    ///
    /// It rests on what does not depend on origin, orientation or resolution, so that it rarely
    /// changes with these.
    #[must_use]
    pub fn order(&self, other: &Self) -> Ordering {
        let shape = |map: &Self| (map.lattice.width, map.lattice.height);
        let [states, others] = [self, other].map(|map| map.cells.iter().map(|cell| cell.state));
        self.known_area()
            .total_cmp(&other.known_area())
            .then(self.wall_length().total_cmp(&other.wall_length()))
            .then(shape(self).cmp(&shape(other)))
            .then_with(|| states.cmp(others))
    }
}

fn count(state: &[State], wanted: State) -> usize {
    state.iter().filter(|&&cell| cell == wanted).count()
}

/// Known cells on a square lattice, and the area that each stands for.
fn area_samples(state: &[State], lattice: &Lattice) -> (Vec<AreaSample>, f64) {
    let known = state.len() - count(state, State::Unknown);
    let mut stride = 1;
    while known / (stride * stride) > MOST_SAMPLES {
        stride += 1;
    }
    let mut samples = Vec::new();
    for row in (stride / 2..lattice.height).step_by(stride) {
        for column in (stride / 2..lattice.width).step_by(stride) {
            let at = row * lattice.width + column;
            if state[at] != State::Unknown {
                samples.push(AreaSample { at: lattice.centre(at), free: state[at] == State::Free });
            }
        }
    }
    (samples, (stride as f64 * lattice.resolution).powi(2))
}

fn centroid(samples: &[AreaSample]) -> Point2<f64> {
    let sum: Vector2<f64> = samples.iter().map(|sample| sample.at.coords).sum();
    Point2::from(sum / samples.len().max(1) as f64)
}
