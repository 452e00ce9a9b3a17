//! The rule that loses no wall: near another it is the same wall, else it stays.

use nalgebra::Point2;
use ogm_core::{Cancelled, CellIndex, GridFrame, Occupancy, Progress};

use crate::placed::{PlacedMap, surest_first};
use crate::rows::{Reach, Said};
use crate::verdict::{SAID_FREE, SAID_OCCUPIED, Tables};
use crate::walls::Walls;

/// Standard deviations of a pose within which a wall may lie elsewhere than the pose puts it: 99 %
/// of a place's distribution in the plane.
const SIGMAS: f64 = 3.0;

/// Beyond this many metres a wall is another wall, however unsure the pose is: less than a door.
const FARTHEST_M: f64 = 0.6;

/// Cells of the coarser of two maps by which a wall in both may differ under an exact pose: the
/// rounding of either, and that of the output.
const ROUNDING_CELLS: f64 = 1.5;

/// Maps on one output, and which of them is believed where two put a wall.
pub(crate) struct KeepWalls<'a> {
    maps: &'a [PlacedMap<'a>],
    frame: GridFrame,
    /// Places in `maps`, surest first.
    order: Vec<usize>,
    /// Of each map, in which cells around one of its walls a surer map's wall is the same wall.
    same_wall: Vec<Vec<[isize; 2]>>,
    /// Cells by distance, as far as any two maps may differ.
    by_distance: Vec<([isize; 2], f64)>,
    /// Rows beyond those that are asked for that decide about them.
    pub(crate) halo: usize,
    tables: Tables,
}

impl<'a> KeepWalls<'a> {
    /// For `maps` on the output whose cell (0, 0) is that of `frame`.
    pub(crate) fn new(maps: &'a [PlacedMap<'a>], frame: GridFrame, tables: Tables) -> Self {
        let resolution = frame.resolution();
        let coarser = |placed: &PlacedMap<'_>| placed.map.frame().resolution().max(resolution);
        let same_wall: Vec<_> = maps
            .iter()
            .map(|placed| {
                let radius = 1.0 + 0.5 * coarser(placed) / resolution;
                disc(radius).into_iter().map(|(offset, _)| offset).collect::<Vec<_>>()
            })
            .collect();
        let sigma = maps.iter().map(PlacedMap::largest_sigma).fold(0.0, f64::max);
        let bend = maps.iter().map(|placed| placed.bend_m).fold(0.0, f64::max);
        let coarsest = maps.iter().map(coarser).fold(resolution, f64::max);
        let farthest =
            FARTHEST_M.min(SIGMAS * 2.0_f64.sqrt() * sigma.hypot(bend)) + ROUNDING_CELLS * coarsest;
        let by_distance = disc(farthest / resolution);
        let chain: usize = same_wall.iter().map(|offsets| 2 * reach_of(offsets) + 2).sum();
        let search = by_distance.iter().map(|(at, _)| at[1].unsigned_abs()).max().unwrap_or(0);
        Self {
            maps,
            frame,
            order: surest_first(maps),
            same_wall,
            by_distance,
            halo: search.max(chain),
            tables,
        }
    }

    /// Decides which walls of `said`, what each map says in the rows of the blank `walls`, are walls
    /// of the output: all of the surest map, and of every other one those that are not near such a
    /// wall, with what joins them to it, so that a wall that goes on where a surer map ends has no
    /// gap. Of a map whose cells are many of the output's it looks far around each wall, which takes
    /// long and can be ended.
    pub(crate) fn place(
        &self,
        reaches: &[Reach<'_>],
        said: &mut [Said],
        walls: &mut Walls,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let mut left_out = Vec::new();
        for (by, &map) in (1..).zip(&self.order) {
            let said = &mut said[map];
            left_out.clear();
            for row in said.rows.clone() {
                if progress.is_cancelled() {
                    return Err(Cancelled);
                }
                for (column, &cell) in said.columns.clone().zip(said.row(row)) {
                    if self.tables.class(cell) != SAID_OCCUPIED {
                        continue;
                    }
                    match walls.surer_wall_among(&self.same_wall[map], row, column, by) {
                        None => walls.put(row, column, by),
                        Some(true) => left_out.push((row, column)),
                        Some(false) => {}
                    }
                }
            }
            for _ in 0..reach_of(&self.same_wall[map]) {
                let joining: Vec<_> = left_out
                    .extract_if(.., |&mut (row, column)| walls.is_beside(row, column, by))
                    .collect();
                for (row, column) in joining {
                    walls.put(row, column, by);
                }
            }
            if let Some(reach) = reaches[map].warped() {
                for (row, column, cell) in walls.missing(&reach) {
                    if self.tables.class(said.at(row, column)) != SAID_OCCUPIED {
                        said.set(row, column, cell);
                    }
                    walls.put(row, column, by);
                }
            }
        }
        Ok(())
    }

    /// Fuses a row; `contradicted` hears of every conflict: its column, the maps that say occupied
    /// and those that say free.
    pub(crate) fn fuse_row(
        &self,
        said: &[Said],
        walls: &Walls,
        row: usize,
        output: &mut [Occupancy],
        mut contradicted: impl FnMut(usize, &[usize], &[usize]),
    ) -> usize {
        let mut compared = 0;
        let rows: Vec<_> = said.iter().map(|said| (said.row(row), said.columns.start)).collect();
        let (mut occupied, mut free) = (Vec::new(), Vec::new());
        for (column, (output, &put_by)) in output.iter_mut().zip(walls.row(row)).enumerate() {
            let (mut wall, mut rest) = (0.0, 0.0);
            let (mut known, mut rest_known, mut seen) = (0, false, 0);
            for &(cells, start) in &rows {
                let Some(&cell) = column.checked_sub(start).and_then(|at| cells.get(at)) else {
                    continue;
                };
                if !cell.is_known() {
                    continue;
                }
                known += 1;
                let class = self.tables.class(cell);
                seen |= class;
                if class == SAID_OCCUPIED {
                    wall += self.tables.log_odds.of(cell);
                } else {
                    rest += self.tables.log_odds.of(cell);
                    rest_known = true;
                }
            }
            compared += usize::from(known > 1);
            if put_by == 0 {
                *output =
                    if rest_known { self.tables.rounding.round(rest) } else { Occupancy::UNKNOWN };
                continue;
            }
            *output = self.tables.rounding.round(wall);
            if seen & SAID_FREE == 0 {
                continue;
            }
            occupied.clear();
            free.clear();
            for (map, &(cells, start)) in rows.iter().enumerate() {
                let cell = column.checked_sub(start).and_then(|at| cells.get(at));
                match cell.map(|&cell| self.tables.class(cell)) {
                    Some(SAID_OCCUPIED) => occupied.push(map),
                    Some(SAID_FREE) => free.push(map),
                    _ => {}
                }
            }
            let from = self.order[usize::from(put_by) - 1];
            free.retain(|&map| !self.has_the_wall(&said[map], map, from, row, column));
            if !free.is_empty() {
                contradicted(column, &occupied, &free);
            }
        }
        compared
    }

    /// Whether `map`, which says free, has the wall that `from` has in a cell, as near as the
    /// uncertainty of both allows.
    fn has_the_wall(
        &self,
        said: &Said,
        map: usize,
        from: usize,
        row: usize,
        column: usize,
    ) -> bool {
        let place = self.frame.cell_centre(CellIndex { column, row });
        let limit = self.tolerance(map, from, place) / self.frame.resolution();
        let (row, column) = (row.cast_signed(), column.cast_signed());
        self.by_distance.iter().take_while(|(_, distance)| *distance <= limit).any(
            |&([right, up], _)| {
                let at = usize::try_from(row + up).ok().zip(usize::try_from(column + right).ok());
                at.is_some_and(|(row, column)| {
                    self.tables.class(said.at(row, column)) == SAID_OCCUPIED
                })
            },
        )
    }

    /// How far apart two maps may see one wall at `place`, metres.
    fn tolerance(&self, a: usize, b: usize, place: Point2<f64>) -> f64 {
        let [a, b] = [a, b].map(|map| &self.maps[map]);
        let pose = a.sigma_at(place).hypot(b.sigma_at(place));
        let bend = a.bend_m.hypot(b.bend_m);
        let coarser = a.map.frame().resolution().max(b.map.frame().resolution());
        let cell = coarser.max(self.frame.resolution());
        FARTHEST_M.min(SIGMAS * pose.hypot(bend)) + ROUNDING_CELLS * cell
    }
}

/// Rows that `offsets` reach up and down.
fn reach_of(offsets: &[[isize; 2]]) -> usize {
    offsets.iter().map(|at| at[1].unsigned_abs()).max().unwrap_or(0)
}

/// Columns and rows to the cells within `radius` cells, and how far they are; nearest first.
fn disc(radius: f64) -> Vec<([isize; 2], f64)> {
    #[expect(clippy::cast_possible_truncation, reason = "a few hundred cells")]
    let reach = radius.floor() as isize;
    let span = || -reach..=reach;
    let mut cells: Vec<_> = span()
        .flat_map(|up| span().map(move |right| [right, up]))
        .map(|offset| (offset, (offset[0] as f64).hypot(offset[1] as f64)))
        .filter(|&(_, distance)| distance <= radius)
        .collect();
    cells.sort_by(|a, b| a.1.total_cmp(&b.1));
    cells
}
