//! Scans become an occupancy grid.

use nalgebra::{Point2, Vector2};
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};

use crate::{MappingParams, SimError};

/// Unknown cells left around a cropped map.
const MARGIN: i64 = 5;

/// A rectangle of lattice cells: columns and rows from `low` to `high`, both included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CellBox {
    pub(crate) low: [i64; 2],
    pub(crate) high: [i64; 2],
}

impl CellBox {
    /// The cells that contain `points`; `None` without any.
    pub(crate) fn around(
        frame: &GridFrame,
        points: impl IntoIterator<Item = Point2<f64>>,
    ) -> Option<Self> {
        let cells = points.into_iter().map(|point| frame.lattice_cell(point));
        cells.map(|cell| Self { low: cell, high: cell }).reduce(Self::union)
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    fn grown(self, cells: i64) -> Self {
        Self {
            low: self.low.map(|cell| cell.saturating_sub(cells)),
            high: self.high.map(|cell| cell.saturating_add(cells)),
        }
    }

    fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| {
            let cells = self.high[axis].saturating_sub(self.low[axis]).saturating_add(1);
            usize::try_from(cells).unwrap_or(0)
        })
    }
}

/// Log-odds under construction, in the lattice through the origin of the map frame.
pub(crate) struct Mapper {
    params: MappingParams,
    lattice: GridFrame,
    bounds: CellBox,
    width: usize,
    height: usize,
    log_odds: Vec<f32>,
    /// Last scan that updated the cell, from 1; 0 is never.
    stamps: Vec<u32>,
    scan: u32,
}

impl Mapper {
    /// A mapper for scans of at most `max_range` metres from anywhere in `positions`.
    ///
    /// `params` must be checked.
    pub(crate) fn new(
        params: &MappingParams,
        positions: &[Point2<f64>],
        max_range: f64,
    ) -> Result<Self, SimError> {
        let lattice = GridFrame::new(params.resolution, Se2::identity())?;
        let reach = Vector2::repeat(max_range + 2.0 * params.resolution);
        let corners = positions.iter().flat_map(|p| [p - reach, p + reach]);
        let nothing = CellBox { low: [0, 0], high: [0, 0] };
        let bounds = CellBox::around(&lattice, corners).unwrap_or(nothing);
        let [width, height] = bounds.size();
        // Refuses absurd sizes before they are allocated.
        let stamps = Grid::filled(width, height, ())?;
        let count = stamps.cells().len();
        Ok(Self {
            params: *params,
            lattice,
            bounds,
            width,
            height,
            log_odds: vec![0.0; count],
            stamps: vec![0; count],
            scan: 0,
        })
    }

    /// Integrates one scan: `ranges` along `beams` of the robot, infinite ones clear `max_range`.
    pub(crate) fn add_scan(
        &mut self,
        map_from_robot: Se2,
        beams: &[Vector2<f64>],
        ranges: &[f64],
        max_range: f64,
    ) {
        self.scan += 1;
        let cells = self.lattice.cells_from_point(map_from_robot.translation().into());
        let [column, row] = self.bounds.low;
        let start = cells - Vector2::new(column as f64, row as f64);
        let per_metre = 1.0 / self.params.resolution;
        for (&beam, &range) in beams.iter().zip(ranges) {
            if range.is_finite() {
                self.mark_hit(start + map_from_robot * beam * (range * per_metre));
            }
        }
        for (&beam, &range) in beams.iter().zip(ranges) {
            let length =
                if range.is_finite() { range * per_metre - 1.0 } else { max_range * per_metre };
            if length > 0.0 {
                self.clear(start, map_from_robot * beam, length);
            }
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "inside the grid as checked before; single precision is ample for log-odds"
    )]
    fn mark_hit(&mut self, at: Point2<f64>) {
        if at.x < 0.0 || at.y < 0.0 || at.x >= self.width as f64 || at.y >= self.height as f64 {
            return;
        }
        let position = at.y as usize * self.width + at.x as usize;
        if self.stamps[position] != self.scan {
            self.stamps[position] = self.scan;
            let cell = &mut self.log_odds[position];
            *cell = (*cell + self.params.occupied_update as f32).min(self.params.limit as f32);
        }
    }

    /// Frees the cells under a ray, one for each unit along its steeper axis; cells that this scan
    /// has already updated keep their value, so a hit wins.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a ray lies inside the grid, whose bounds reach as far as any beam; single precision is ample for log-odds"
    )]
    fn clear(&mut self, start: Point2<f64>, direction: Vector2<f64>, length: f64) {
        let fixed = |x: f64| (x * 4_294_967_296.0) as i64;
        let steeper = direction.amax();
        let step = direction / steeper;
        let (mut x, mut y) = (fixed(start.x), fixed(start.y));
        let (dx, dy) = (fixed(step.x), fixed(step.y));
        let free = self.params.free_update as f32;
        let lowest = -self.params.limit as f32;
        for _ in 0..=(length * steeper) as u64 {
            let position = (y >> 32) as usize * self.width + (x >> 32) as usize;
            if let Some(stamp) = self.stamps.get_mut(position)
                && *stamp != self.scan
            {
                *stamp = self.scan;
                if let Some(cell) = self.log_odds.get_mut(position) {
                    *cell = (*cell + free).max(lowest);
                }
            }
            x = x.wrapping_add(dx);
            y = y.wrapping_add(dy);
        }
    }

    /// The lattice through the origin of the map frame.
    pub(crate) fn lattice(&self) -> &GridFrame {
        &self.lattice
    }

    /// The map of what was observed with a narrow margin, and which cells were; at least the box
    /// `keep`, exactly that if nothing else was observed.
    pub(crate) fn finish(
        self,
        keep: Option<CellBox>,
    ) -> Result<(OccupancyGrid, Grid<bool>), SimError> {
        let seen = self.seen_box();
        let area = match (seen, keep) {
            (Some(seen), None) => seen.grown(MARGIN),
            (Some(seen), Some(keep)) => seen.union(keep),
            (None, keep) => keep.unwrap_or(self.bounds),
        };
        let [width, height] = area.size();
        let mut cells = Grid::filled(width, height, Occupancy::UNKNOWN)?;
        let mut coverage = Grid::filled(width, height, false)?;
        if let Some(seen) = seen {
            let offset = |axis: usize, from: CellBox| {
                usize::try_from(seen.low[axis] - from.low[axis]).unwrap_or(0)
            };
            let columns = seen.size()[0];
            for row in 0..seen.size()[1] {
                let from = (offset(1, self.bounds) + row) * self.width + offset(0, self.bounds);
                let to = (offset(1, area) + row) * width + offset(0, area);
                let observed = self.stamps[from..][..columns].iter().map(|&stamp| stamp > 0);
                let log_odds = &self.log_odds[from..][..columns];
                let output = cells.cells_mut()[to..][..columns].iter_mut();
                let covered = coverage.cells_mut()[to..][..columns].iter_mut();
                for (((cell, covered), seen), &l) in output.zip(covered).zip(observed).zip(log_odds)
                {
                    if seen {
                        *cell = Occupancy::from_log_odds(f64::from(l));
                        *covered = true;
                    }
                }
            }
        }
        let frame = self.lattice.shifted(area.low[0], area.low[1]);
        Ok((OccupancyGrid::new(frame, cells), coverage))
    }

    /// Bounding box of the observed cells.
    fn seen_box(&self) -> Option<CellBox> {
        let [left, low] = self.bounds.low;
        let rows = self.stamps.chunks_exact(self.width).zip(low..);
        rows.filter_map(|(stamps, row)| {
            let first = stamps.iter().position(|&stamp| stamp > 0)?;
            let last = stamps.iter().rposition(|&stamp| stamp > 0)?;
            Some(CellBox { low: [left + first as i64, row], high: [left + last as i64, row] })
        })
        .reduce(CellBox::union)
    }
}

#[cfg(test)]
mod tests {
    use super::{CellBox, Mapper};
    use crate::MappingParams;
    use nalgebra::{Point2, Vector2};
    use ogm_core::{Occupancy, Se2};

    const ALONG: [Vector2<f64>; 1] = [Vector2::new(1.0, 0.0)];

    fn mapper(resolution: f64) -> Mapper {
        let params = MappingParams { resolution, ..MappingParams::default() };
        Mapper::new(&params, &[Point2::new(0.5, 0.5)], 8.0).unwrap()
    }

    fn log_odds_along(mapper: Mapper) -> Vec<Option<f64>> {
        let (map, coverage) = mapper.finish(None).unwrap();
        let row = map.cell_at(Point2::new(0.5, 0.5)).unwrap().row;
        let cells = map.cells().row(row).iter().map(|cell| cell.log_odds());
        let known: Vec<_> = cells.collect();
        let covered = coverage.row(row).iter();
        assert!(known.iter().zip(covered).all(|(cell, &covered)| cell.is_some() == covered));
        known
    }

    /// Half a storage step in log-odds near the values below.
    const STORED: f64 = 0.02;

    fn assert_log_odds(found: &[Option<f64>], expected: &[f64]) {
        let known: Vec<f64> = found.iter().copied().flatten().collect();
        assert_eq!(known.len(), expected.len(), "{found:?}");
        for (found, expected) in known.iter().zip(expected) {
            assert!((found - expected).abs() < STORED, "{known:?}");
        }
    }

    #[test]
    fn a_ray_frees_up_to_one_cell_before_its_hit() {
        let mut mapper = mapper(1.0);
        mapper.add_scan(Se2::new(0.5, 0.5, 0.0), &ALONG, &[4.2], 8.0);
        assert_log_odds(&log_odds_along(mapper), &[-0.4, -0.4, -0.4, -0.4, 0.85]);
    }

    #[test]
    fn without_a_return_a_ray_frees_its_whole_reach() {
        let mut mapper = mapper(1.0);
        mapper.add_scan(Se2::new(0.5, 0.5, 0.0), &ALONG, &[f64::INFINITY], 8.0);
        assert_log_odds(&log_odds_along(mapper), &[-0.4; 9]);
    }

    #[test]
    fn a_scan_updates_a_cell_once_and_a_hit_wins() {
        let mut mapper = mapper(1.0);
        let beams = [ALONG[0]; 4];
        for _ in 0..2 {
            let ranges = [6.2, 2.2, 2.2, f64::INFINITY];
            mapper.add_scan(Se2::new(0.5, 0.5, 0.0), &beams, &ranges, 8.0);
        }
        let expected = [-0.8, -0.8, 1.7, -0.8, -0.8, -0.8, 1.7, -0.8, -0.8];
        assert_log_odds(&log_odds_along(mapper), &expected);
    }

    #[test]
    fn evidence_is_clamped_and_what_lies_behind_a_wall_stays_unknown() {
        let mut mapper = mapper(1.0);
        for _ in 0..40 {
            mapper.add_scan(Se2::new(0.5, 0.5, 0.0), &ALONG, &[3.0], 8.0);
        }
        let (map, _) = mapper.finish(None).unwrap();
        let wall = map.at(Point2::new(3.5, 0.5));
        assert_eq!(wall, Occupancy::from_log_odds(8.0));
        assert_eq!(map.at(Point2::new(4.5, 0.5)), Occupancy::UNKNOWN);
    }

    #[test]
    fn a_box_to_keep_is_kept_and_the_lattice_goes_through_the_origin() {
        let mut mapper = mapper(0.5);
        mapper.add_scan(Se2::new(0.5, 0.5, 0.3), &ALONG, &[2.0], 8.0);
        let keep = CellBox { low: [-3, -7], high: [11, 9] };
        let (map, _) = mapper.finish(Some(keep)).unwrap();
        assert_eq!((map.width(), map.height()), (15, 17));
        assert_eq!(map.frame().map_from_grid(), Se2::new(-1.5, -3.5, 0.0));
    }
}
