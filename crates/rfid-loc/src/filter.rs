//! The grid Bayes filter of one tag (Eqs. 1, 2).

use nalgebra::{Matrix2, Point2, Vector2};
use ogm_core::{CellIndex, Grid, GridFrame, ParameterError, Se2, TagEstimate, TagId, require};

use crate::fit::{Bias, Fit, OUTLIER_SIGMA};
use crate::params::RANGE_SLACK_SIGMA;
use crate::window::{Peak, most_probable};
use crate::{FilterParams, Likelihood, PositionRule, TagError};

/// Coordinates beyond this many metres are errors: an `f64` resolves less than a micrometre there.
pub(crate) const MAX_COORDINATE: f64 = 1e9;

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
    /// Robot positions and ranges, for the fit.
    readings: Vec<(Point2<f64>, f64)>,
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
            readings: Vec::new(),
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
        check_reading(robot_position, range, &self.params)?;
        self.readings.push((robot_position, range));
        // In units of σ√2 a squared residual is a cost.
        let unit = self.params.range_sigma * std::f64::consts::SQRT_2;
        let robot = self.frame.cells_from_point(robot_position);
        let cell = self.params.cell_size / unit;
        for (column, sq) in self.columns_sq.iter_mut().enumerate() {
            *sq = squared_f32((column as f64 + 0.5 - robot.x) * cell);
        }
        let range = to_f32(range / unit);
        let most = match self.params.likelihood {
            Likelihood::Gaussian => f32::INFINITY,
            Likelihood::Truncated => to_f32(OUTLIER_SIGMA * OUTLIER_SIGMA / 2.0),
        };
        let side = self.params.side_cells;
        for (row, costs) in self.costs.cells_mut().chunks_exact_mut(side).enumerate() {
            let row_sq = squared_f32((row as f64 + 0.5 - robot.y) * cell);
            for (cost, column_sq) in costs.iter_mut().zip(&self.columns_sq) {
                let residual = (column_sq + row_sq).sqrt() - range;
                *cost += (residual * residual).min(most);
            }
        }
        if self.readings.len().is_multiple_of(LEVEL_EVERY) {
            let least = self.least_cost();
            self.costs.cells_mut().iter_mut().for_each(|cost| *cost -= least);
        }
        Ok(())
    }

    /// Readings taken in.
    #[must_use]
    pub fn readings(&self) -> usize {
        self.readings.len()
    }

    /// The lattice of [`posterior`](Self::posterior) in the map frame.
    #[must_use]
    pub fn frame(&self) -> GridFrame {
        self.frame
    }

    /// The probability of each cell; the sum is 1 (Eq. 2, over all cells).
    #[must_use]
    pub fn posterior(&self) -> Grid<f64> {
        self.posterior_widened_by(1.0)
    }

    /// The posterior of a sensor whose variance is `scale_sq` times that of the parameters.
    fn posterior_widened_by(&self, scale_sq: f32) -> Grid<f64> {
        let least = self.least_cost();
        let mut posterior = self.costs.map(|cost| {
            let excess = (cost - least) / scale_sq;
            if excess < NEGLIGIBLE_COST { f64::from(-excess).exp() } else { 0.0 }
        });
        let sum: f64 = posterior.cells().iter().sum();
        posterior.cells_mut().iter_mut().for_each(|cell| *cell /= sum);
        posterior
    }

    /// Where the tag is believed to be, or `None` before the first reading.
    ///
    /// Where [`FilterParams::check_fit`] asks for it, the certainty and the covariance are those
    /// that the readings deserve: of a sensor as noisy as their residuals say, and times the
    /// probability that its ranges have no bias.
    #[must_use]
    pub fn estimate(&self, tag_id: TagId) -> Option<TagEstimate> {
        let (estimate, bias) = self.fitted(tag_id)?;
        Some(match bias {
            Some(bias) => {
                TagEstimate { certainty: estimate.certainty * bias.unbiased(), ..estimate }
            }
            None => estimate,
        })
    }

    /// The estimate before a bias is thought of, and what is to be thought where the fit is checked.
    pub(crate) fn fitted(&self, tag_id: TagId) -> Option<(TagEstimate, Option<Bias>)> {
        if self.readings.is_empty() {
            return None;
        }
        let mut posterior = self.posterior();
        let mode = most_probable(&posterior);
        let mut peak = self.peak(&posterior);
        let position = match self.params.position {
            PositionRule::WindowCentroid => self.frame.point_from_cells(peak.centroid),
            PositionRule::Mode => self.frame.cell_centre(mode),
        };
        let fit = Fit::of(&self.readings, position, &self.params);
        if self.params.check_fit && fit.scale_sq > 1.0 {
            posterior = self.posterior_widened_by(to_f32(fit.scale_sq));
            peak = self.peak(&posterior);
        }
        let estimate = TagEstimate {
            tag_id,
            position,
            mode: self.frame.cell_centre(mode),
            covariance: self.covariance(&posterior, position),
            certainty: peak.mass.min(1.0),
            misfit: fit.misfit,
            readings: self.readings.len(),
            dropped: 0,
            touches_border: self.is_near_border(mode) || self.is_near_border(peak.middle),
            second_peak_ratio: peak.second_ratio,
        };
        Some((estimate, self.params.check_fit.then_some(fit.bias)))
    }

    fn peak(&self, posterior: &Grid<f64>) -> Peak {
        Peak::of(posterior, self.params.sub_sampling, self.params.window)
    }

    /// Second moments about `position`, m²; a cell is as wide as it is.
    fn covariance(&self, posterior: &Grid<f64>, position: Point2<f64>) -> Matrix2<f64> {
        let cell = self.params.cell_size;
        let middle = self.frame.cells_from_point(position);
        let mut moments = Matrix2::from_diagonal_element(1.0 / 12.0);
        for (row, cells) in posterior.rows().enumerate() {
            let y = row as f64 + 0.5 - middle.y;
            for (column, &mass) in cells.iter().enumerate() {
                let x = column as f64 + 0.5 - middle.x;
                moments += mass * Matrix2::new(x * x, x * y, x * y, y * y);
            }
        }
        cell * cell * moments
    }

    fn least_cost(&self) -> f32 {
        self.costs.cells().iter().copied().fold(f32::INFINITY, f32::min)
    }

    fn is_near_border(&self, cell: CellIndex) -> bool {
        let side = self.params.side_cells;
        [cell.column, cell.row].iter().any(|&at| at < 2 || at + 2 >= side)
    }
}

/// Whether a reader of these parameters can give this.
pub(crate) fn check_reading(
    robot_position: Point2<f64>,
    range: f64,
    params: &FilterParams,
) -> Result<(), TagError> {
    check_position(robot_position)?;
    let limit = params.max_range + RANGE_SLACK_SIGMA * params.range_sigma;
    if (0.0..=limit).contains(&range) { Ok(()) } else { Err(TagError::Range { range, limit }) }
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
