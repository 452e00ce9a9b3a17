//! The grid Bayes filter of one tag (Eqs. 1, 2).

use nalgebra::{Point2, Vector2};
use ogm_core::{CellIndex, Grid, GridFrame, ParameterError, Se2, TagEstimate, require};

use crate::window::{Peak, most_probable};
use crate::{FilterParams, PositionRule, TagError};

/// Coordinates beyond this many metres are errors: an `f64` resolves less than a micrometre there.
pub(crate) const MAX_COORDINATE: f64 = 1e9;

/// Measured ranges may exceed the maximum range by this many sigma.
const RANGE_SLACK_SIGMA: f64 = 4.0;

/// Readings between two subtractions of the smallest cost; see [`TagFilter`] on precision.
const LEVEL_EVERY: usize = 32;

/// Weights below exp(−this) of the largest cannot change any sum of `f64`.
const NEGLIGIBLE_COST: f32 = 80.0;

/// Where one static tag may be, given the ranges read so far (Tsardoulias et al., Eq. 1 with the
/// measurement term that the print lacks).
///
/// The posterior is kept as −ln p up to a constant, so that thousands of readings do not underflow:
/// each adds (|x − robot| − range)² / 2σ² to every cell.
///
/// # Precision
/// The sum is `f32`. A cell matters only while its cost is within a few tens of the smallest. There
/// the distance to the robot is about the range, at most 64 σ, so its residual is known to 1e-5 σ;
/// and as the smallest cost is subtracted every 32 readings, sums stay below about 100, where an
/// addition rounds by less than 4e-6. Both errors average out over readings and leave about 1e-4 of
/// a cell's weight after 300 of them.
#[derive(Debug, Clone)]
pub struct TagFilter {
    params: FilterParams,
    frame: GridFrame,
    costs: Grid<f32>,
    /// Squared horizontal distances of one reading, in 2σ².
    columns_sq: Vec<f32>,
    readings: usize,
}

impl TagFilter {
    /// A filter over the square whose lower-left corner is `lower_left`, metres in the map frame.
    ///
    /// # Errors
    /// Parameters or a corner that cannot be meant, or more cells than a grid may have.
    pub fn new(lower_left: Point2<f64>, params: &FilterParams) -> Result<Self, TagError> {
        check_params(params)?;
        check_position(lower_left)?;
        let side = params.side_cells;
        Ok(Self {
            params: *params,
            frame: GridFrame::new(params.cell_size, Se2::new(lower_left.x, lower_left.y, 0.0))?,
            costs: Grid::filled(side, side, 0.0)?,
            columns_sq: vec![0.0; side],
            readings: 0,
        })
    }

    /// A filter around where the robot first read the tag: its cells are aligned to multiples of
    /// the cell size in the map frame, and the robot's is the middle one. With the default
    /// parameters every tag in range lies inside.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn around(
        first_robot_position: Point2<f64>,
        params: &FilterParams,
    ) -> Result<Self, TagError> {
        check_params(params)?;
        check_position(first_robot_position)?;
        let half = (params.side_cells / 2) as f64;
        let cell = (first_robot_position / params.cell_size).map(f64::floor);
        let lower_left = (cell - Vector2::new(half, half)) * params.cell_size;
        Self::new(lower_left, params)
    }

    /// Takes in one range, read at `robot_position`; both in metres, the position in the map frame.
    ///
    /// # Errors
    /// A position or range that is not finite, a negative range, or one longer than the maximum
    /// plus 4 sigma. The filter is unchanged then.
    pub fn update(&mut self, robot_position: Point2<f64>, range: f64) -> Result<(), TagError> {
        check_position(robot_position)?;
        let limit = self.params.max_range + RANGE_SLACK_SIGMA * self.params.range_sigma;
        if !(0.0..=limit).contains(&range) {
            return Err(TagError::Range { range, limit });
        }
        // In units of σ√2 a squared residual is a cost.
        let unit = self.params.range_sigma * std::f64::consts::SQRT_2;
        let robot = self.frame.cells_from_point(robot_position);
        let cell = self.params.cell_size / unit;
        for (column, sq) in self.columns_sq.iter_mut().enumerate() {
            *sq = squared_f32((column as f64 + 0.5 - robot.x) * cell);
        }
        let range = to_f32(range / unit);
        let side = self.params.side_cells;
        for (row, costs) in self.costs.cells_mut().chunks_exact_mut(side).enumerate() {
            let row_sq = squared_f32((row as f64 + 0.5 - robot.y) * cell);
            for (cost, column_sq) in costs.iter_mut().zip(&self.columns_sq) {
                let residual = (column_sq + row_sq).sqrt() - range;
                *cost += residual * residual;
            }
        }
        self.readings += 1;
        if self.readings.is_multiple_of(LEVEL_EVERY) {
            let least = self.least_cost();
            self.costs.cells_mut().iter_mut().for_each(|cost| *cost -= least);
        }
        Ok(())
    }

    /// Readings taken in.
    #[must_use]
    pub fn readings(&self) -> usize {
        self.readings
    }

    /// The lattice of [`posterior`](Self::posterior) in the map frame.
    #[must_use]
    pub fn frame(&self) -> GridFrame {
        self.frame
    }

    /// The probability of each cell; the sum is 1 (Eq. 2, over all cells).
    #[must_use]
    pub fn posterior(&self) -> Grid<f64> {
        let least = self.least_cost();
        let mut posterior = self.costs.map(|cost| {
            let excess = cost - least;
            if excess < NEGLIGIBLE_COST { f64::from(-excess).exp() } else { 0.0 }
        });
        let sum: f64 = posterior.cells().iter().sum();
        posterior.cells_mut().iter_mut().for_each(|cell| *cell /= sum);
        posterior
    }

    /// Where the tag is believed to be, or `None` before the first reading.
    #[must_use]
    pub fn estimate(&self, tag_id: u32) -> Option<TagEstimate> {
        if self.readings == 0 {
            return None;
        }
        let posterior = self.posterior();
        let mode = most_probable(&posterior);
        let peak = Peak::of(&posterior, self.params.sub_sampling, self.params.window);
        let mode_centre = self.frame.cell_centre(mode);
        Some(TagEstimate {
            tag_id,
            position: match self.params.position {
                PositionRule::WindowCentroid => self.frame.point_from_cells(peak.centroid),
                PositionRule::Mode => mode_centre,
            },
            mode: mode_centre,
            certainty: peak.mass.min(1.0),
            readings: self.readings,
            touches_border: self.is_near_border(mode) || self.is_near_border(peak.middle),
            second_peak_ratio: peak.second_ratio,
        })
    }

    fn least_cost(&self) -> f32 {
        self.costs.cells().iter().copied().fold(f32::INFINITY, f32::min)
    }

    fn is_near_border(&self, cell: CellIndex) -> bool {
        let side = self.params.side_cells;
        [cell.column, cell.row].iter().any(|&at| at < 2 || at + 2 >= side)
    }
}

pub(crate) fn check_position(position: Point2<f64>) -> Result<(), TagError> {
    let [x, y] = [position.x, position.y];
    if x.abs() <= MAX_COORDINATE && y.abs() <= MAX_COORDINATE {
        Ok(())
    } else {
        Err(TagError::Position { x, y })
    }
}

fn check_params(params: &FilterParams) -> Result<(), ParameterError> {
    let &FilterParams { cell_size, side_cells, range_sigma, max_range, sub_sampling, .. } = params;
    let size_fits = (1e-3..=MAX_COORDINATE).contains(&cell_size);
    require(size_fits, "cell_size", "0.001 to 1e9 m", cell_size)?;
    let sigma_fits = (0.01 * cell_size..=MAX_COORDINATE).contains(&range_sigma);
    require(sigma_fits, "range_sigma", "a hundredth of a cell to 1e9 m", range_sigma)?;
    let range_fits = max_range > 0.0 && max_range <= MAX_COORDINATE;
    require(range_fits, "max_range", "above 0 and at most 1e9 m", max_range)?;
    let window_fits = (1..=side_cells).contains(&sub_sampling);
    require(window_fits, "sub_sampling", "1 to side_cells", sub_sampling as f64)
}

fn squared_f32(distance: f64) -> f32 {
    to_f32(distance * distance)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "rounds; coordinates are bounded far below the limit of f32"
)]
fn to_f32(value: f64) -> f32 {
    value as f32
}
