//! Candidate poses: every translation at each of some rotations.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};
use ogm_core::{Cancelled, Progress, Se2, Steps, wrap_angle};

use crate::bounds::Bounds;
use crate::correlate::Correlator;
use crate::correlation_planes::{CorrelationPlanes, FreeShare, Side, turned_box, turned_lattice};
use crate::lattice::floor_index;
use crate::parallel::{both, each_with};
use crate::prepare::PreparedMap;
use crate::rotation;
use crate::surface::Surface;
use crate::work::Work;

/// Peaks kept at one rotation.
const PEAKS: usize = 20;
/// Metres by which maps must overlap along each axis of the first.
const LEAST_OVERLAP_M: f64 = 1.0;
/// Rotations closer than this are neighbours of one peak, radians: 2.9°.
const APART_RAD: f64 = 0.05;

/// A pose and how well coarse cells agree under it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Candidate {
    pub(crate) first_from_second: Se2,
    pub(crate) score: f64,
}

/// Two maps on one coarse lattice.
pub(crate) struct CoarsePair<'a> {
    second: &'a PreparedMap,
    /// Metres a coarse cell.
    pub(crate) cell: f64,
    first_planes: CorrelationPlanes,
    second_free: FreeShare,
}

/// The second map turned, on the lattice of a correlation.
struct Placed {
    theta: f64,
    /// Where the corner of its cell (0, 0) lies, turned.
    origin: Vector2<f64>,
    /// Shifts of fewer columns and rows are to the right and up, others to the left and down.
    above: [usize; 2],
}

impl<'a> CoarsePair<'a> {
    pub(crate) fn new(first: &PreparedMap, second: &'a PreparedMap) -> Self {
        let cell = coarse_cell(first, second);
        let first_planes =
            || CorrelationPlanes::turned(first, &FreeShare::of(first, cell), 0.0, Side::First);
        let (first_planes, second_free) = both(first_planes, || FreeShare::of(second, cell));
        Self { second, cell, first_planes, second_free }
    }

    /// The best `most` poses over `rotations`, best first, no two within a cell and a half and
    /// 2.9° of each other. Rotations that the budget does not cover are not tried.
    pub(crate) fn candidates(
        &self,
        rotations: &[f64],
        most: usize,
        bounds: Option<&Bounds>,
        work: &mut Work,
        progress: &dyn Progress,
    ) -> Result<Vec<Candidate>, Cancelled> {
        let (mut size, mut room) = ([0; 2], [0; 2]);
        for &theta in rotations {
            let [low, high] = turned_box(self.second, theta);
            let extent = (high - low) / self.cell;
            size = [size[0].max(floor_index(extent.x) + 5), size[1].max(floor_index(extent.y) + 5)];
            // By rounding a turned map may have one cell more than that.
            let (_, [columns, rows]) = turned_lattice(self.second, theta, self.cell);
            room = [room[0].max(columns), room[1].max(rows)];
        }
        let overlap = floor_index(LEAST_OVERLAP_M / self.cell);
        let (correlator, space) = Correlator::new(&self.first_planes, size, room, overlap);
        let turns = rotation::by_half_turns(rotations);
        let allowed = turns.iter().take_while(|_| work.spend_transform(correlator.cells()));
        let turns = &turns[..allowed.count()];
        let done = Steps::new(progress, turns.len());
        let peaks = each_with(
            turns,
            vec![space],
            || correlator.workspace(),
            |space, turn| {
                let (map, free) = (self.second, &self.second_free);
                let turned = CorrelationPlanes::turned(map, free, turn.theta, Side::Second);
                let [plain, half] = correlator.correlate(&turned, space);
                let mut peaks = Vec::new();
                if turn.wanted[0] {
                    let first = [self.first_planes.width, self.first_planes.height];
                    let placed = Placed { theta: turn.theta, origin: turned.origin, above: first };
                    peaks = self.peaks(&plain, &placed, bounds);
                }
                if turn.wanted[1] {
                    let origin = -turned.origin - Vector2::repeat(self.cell);
                    let theta = wrap_angle(turn.theta + PI);
                    let placed = Placed { theta, origin, above: [half.columns, half.rows] };
                    peaks.extend(self.peaks(&half, &placed, bounds));
                }
                done.step().map(|()| peaks)
            },
        )?;
        let mut found = peaks.concat();
        found.sort_by(|a, b| b.score.total_cmp(&a.score));
        Ok(distinct(found, self.second.centre, 1.5 * self.cell, APART_RAD, most))
    }

    fn peaks(
        &self,
        surface: &Surface<'_>,
        placed: &Placed,
        bounds: Option<&Bounds>,
    ) -> Vec<Candidate> {
        let shift = |index: usize, above: usize, length: usize| {
            if index < above { index as f64 } else { index as f64 - length as f64 }
        };
        let first_from_second = |column: usize, row: usize| {
            let cells = Vector2::new(
                shift(column, placed.above[0], surface.columns),
                shift(row, placed.above[1], surface.rows),
            );
            let translation = cells * self.cell + self.first_planes.origin - placed.origin;
            Se2::new(translation.x, translation.y, placed.theta)
        };
        let is_allowed = |column: usize, row: usize| {
            bounds.is_none_or(|bounds| bounds.near(&first_from_second(column, row), self.cell))
        };
        let peaks = surface.maxima(PEAKS, is_allowed).into_iter();
        peaks
            .map(|(column, row, score)| Candidate {
                first_from_second: first_from_second(column, row),
                score: f64::from(score),
            })
            .collect()
    }
}

/// The first `most` of `found` that are apart from all before.
pub(crate) fn distinct(
    found: Vec<Candidate>,
    centre: Point2<f64>,
    apart_m: f64,
    apart_rad: f64,
    most: usize,
) -> Vec<Candidate> {
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in found {
        if kept.len() == most {
            break;
        }
        let pose = &candidate.first_from_second;
        if kept
            .iter()
            .all(|other| !same_place(&other.first_from_second, pose, centre, apart_m, apart_rad))
        {
            kept.push(candidate);
        }
    }
    kept
}

/// Whether two poses put `centre` within `apart_m` and turn alike within `apart_rad`.
pub(crate) fn same_place(
    a_from_second: &Se2,
    b_from_second: &Se2,
    centre: Point2<f64>,
    apart_m: f64,
    apart_rad: f64,
) -> bool {
    let turn = wrap_angle(a_from_second.theta() - b_from_second.theta()).abs();
    turn <= apart_rad && (*a_from_second * centre - *b_from_second * centre).norm() <= apart_m
}

/// Coarse enough that the transform stays small, fine enough that rooms stay apart.
fn coarse_cell(first: &PreparedMap, second: &PreparedMap) -> f64 {
    let extents = [first, second].map(|map| {
        let [low, high] = turned_box(map, 0.0);
        high - low
    });
    let smallest = extents.iter().map(|extent| extent.min()).fold(f64::INFINITY, f64::min);
    let largest = extents.iter().map(|extent| extent.max()).fold(0.0, f64::max);
    let resolution = first.resolution().max(second.resolution());
    (smallest / 60.0).clamp(0.06, 0.2).max(1.5 * resolution).max(largest / 450.0)
}

#[cfg(test)]
mod tests {
    use super::CoarsePair;
    use crate::prepare::PreparedMap;
    use crate::work::Work;
    use nalgebra::Vector2;
    use ogm_core::{ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
    use std::f64::consts::PI;

    /// A part of a flat of 9 × 7 m, in a frame of which it does not matter where it begins.
    fn part([left, bottom]: [usize; 2], [width, height]: [usize; 2]) -> PreparedMap {
        let is_wall = |column: usize, row: usize| {
            let is_outer = matches!(column, 0 | 89) || matches!(row, 0 | 69);
            let is_inner = column == 35 && row < 50 || row == 30 && column > 50;
            is_outer || is_inner || column == 62 && row > 52 || row == 50 && column < 20
        };
        let cells = (0..width * height).map(|at| {
            let wall = is_wall(left + at % width, bottom + at / width);
            if wall { Occupancy::OCCUPIED } else { Occupancy::FREE }
        });
        let cells = Grid::new(width, height, cells.collect()).unwrap();
        let corner = Se2::new(0.1 * left as f64, 0.1 * bottom as f64, 0.0);
        let map = OccupancyGrid::new(GridFrame::new(0.1, corner).unwrap(), cells);
        PreparedMap::new(&map, &ClassThresholds::default(), &()).unwrap()
    }

    #[test]
    fn a_rotation_finds_the_same_place_alone_and_with_its_half_turn() {
        let first = part([0, 0], [90, 70]);
        // One answer is as good as the coarse cells, their mean is better.
        let off = |rotations: &[f64]| {
            let off = (0..10).map(|step| {
                let second = part([8 + step, 5 + step], [70, 50]);
                let pair = CoarsePair::new(&first, &second);
                let mut work = Work::new(None);
                let found = pair.candidates(rotations, 1, None, &mut work, &()).unwrap();
                let found = found[0].first_from_second;
                let truth = first.map_from_local.inverse() * second.map_from_local;
                assert!(found.theta().abs() < 1e-9);
                (found * second.centre - truth * second.centre) / pair.cell
            });
            off.sum::<Vector2<f64>>() / 10.0
        };
        let alone = off(&[0.0]);
        assert!(alone.amax() < 0.7, "{alone}");
        for rotations in [[-PI, 0.0], [PI, 0.0]] {
            let with_half = off(&rotations);
            assert!((with_half - alone).amax() < 0.4, "{alone} {with_half}");
        }
    }
}
