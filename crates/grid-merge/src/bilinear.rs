//! A map seen through a transform, log-odds interpolated between cell centres.

use nalgebra::Point2;
use ogm_core::{Grid, GridFrame, NearestWarp, Occupancy, Progress, Se2, Steps};

use crate::FusionError;
use crate::evidence::{ByteOfLogOdds, LogOddsOfByte};
use crate::mapping::CellMap;

/// `source` on a target lattice: log-odds between the four nearest cell centres where all are
/// known, else the cell that contains the point. Known exactly where the nearest cell is.
pub(crate) fn warp_bilinear(
    source: &Grid<Occupancy>,
    source_frame: &GridFrame,
    target_frame: &GridFrame,
    target_size: (usize, usize),
    target_from_source: &Se2,
    progress: &dyn Progress,
) -> Result<Grid<Occupancy>, FusionError> {
    let nearest = NearestWarp::new(source_frame, target_frame, target_from_source)?;
    let (width, height) = target_size;
    let mut target = Grid::filled(width, height, Occupancy::UNKNOWN)?;
    let done = Steps::new(progress, height);
    let source_cells = CellMap::new(target_frame, source_frame, &target_from_source.inverse());
    let blend = Blend { source, log_odds: LogOddsOfByte::new(), rounding: ByteOfLogOdds::new() };
    for (row, cells) in target.cells_mut().chunks_exact_mut(width).enumerate() {
        nearest.fill_row(source, row, cells);
        let start = source_cells.at(0.5, row as f64 + 0.5);
        for (column, cell) in cells.iter_mut().enumerate() {
            if cell.is_known() {
                let at = start + source_cells.column_step * column as f64;
                *cell = blend.at(at).unwrap_or(*cell);
            }
        }
        done.step()?;
    }
    Ok(target)
}

struct Blend<'a> {
    source: &'a Grid<Occupancy>,
    log_odds: LogOddsOfByte,
    rounding: ByteOfLogOdds,
}

impl Blend<'_> {
    /// The value at continuous cell coordinates, if the four centres around are known cells.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be a cell of the source before the cast"
    )]
    fn at(&self, cells: Point2<f64>) -> Option<Occupancy> {
        let (x, y) = (cells.x - 0.5, cells.y - 0.5);
        let (width, height) = (self.source.width(), self.source.height());
        let (last_column, last_row) = ((width - 1) as f64, (height - 1) as f64);
        if !(x >= 0.0 && x < last_column && y >= 0.0 && y < last_row) {
            return None;
        }
        let (column, row) = (x as usize, y as usize);
        let (right, up) = (x - column as f64, y - row as f64);
        let lower = &self.source.row(row)[column..column + 2];
        let upper = &self.source.row(row + 1)[column..column + 2];
        if !lower.iter().chain(upper).all(|cell| cell.is_known()) {
            return None;
        }
        let mix = |pair: &[Occupancy]| {
            (1.0 - right) * self.log_odds.of(pair[0]) + right * self.log_odds.of(pair[1])
        };
        Some(self.rounding.round((1.0 - up) * mix(lower) + up * mix(upper)))
    }
}

#[cfg(test)]
mod tests {
    use super::warp_bilinear;
    use ogm_core::{CellIndex, Grid, GridFrame, Occupancy, Se2};

    fn unit_frame() -> GridFrame {
        GridFrame::new(1.0, Se2::identity()).unwrap()
    }

    fn row(probabilities: &[f64]) -> Grid<Occupancy> {
        let row: Vec<_> = probabilities.iter().map(|&p| Occupancy::from_probability(p)).collect();
        Grid::new(row.len(), 3, row.repeat(3)).unwrap()
    }

    fn middle(grid: &Grid<Occupancy>, column: usize) -> Occupancy {
        *grid.get(CellIndex { column, row: 1 }).unwrap()
    }

    #[test]
    fn halfway_between_opposite_cells_is_one_half() {
        let source = row(&[0.9, 0.1, 0.1]);
        let target_from_source = Se2::new(-0.5, 0.0, 0.0);
        let warped =
            warp_bilinear(&source, &unit_frame(), &unit_frame(), (3, 3), &target_from_source, &());
        let warped = warped.unwrap();
        assert_eq!(middle(&warped, 0), Occupancy::from_probability(0.5));
        assert_eq!(middle(&warped, 1), Occupancy::FREE);
    }

    #[test]
    fn beside_unknown_the_nearest_cell_speaks_alone() {
        let source = row(&[0.9, 0.1, f64::NAN]);
        let target_from_source = Se2::new(-0.4, 0.0, 0.0);
        let warped =
            warp_bilinear(&source, &unit_frame(), &unit_frame(), (3, 3), &target_from_source, &());
        let warped = warped.unwrap();
        assert_eq!(middle(&warped, 1), Occupancy::FREE);
        assert_eq!(middle(&warped, 2), Occupancy::UNKNOWN);
    }
}
