//! Candidate poses: every translation at each of some rotations.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};
use ogm_core::{Cancelled, Progress, Se2, Steps, wrap_angle};

use crate::bounds::Bounds;
use crate::correlate::{Correlator, Surface};
use crate::correlation_planes::{CorrelationPlanes, FreeShare, Side, turned_box, turned_lattice};
use crate::lattice::floor_index;
use crate::parallel::each;
use crate::prepare::PreparedMap;
use crate::rotation;
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
        let first_free = FreeShare::of(first, cell);
        let first_planes = CorrelationPlanes::turned(first, &first_free, 0.0, Side::First);
        let second_free = FreeShare::of(second, cell);
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
        let correlator = Correlator::new(&self.first_planes, size, room, overlap);
        let allowed = rotations.iter().take_while(|_| work.spend_transform(correlator.cells()));
        let turns = rotation::by_half_turns(&rotations[..allowed.count()]);
        let done = Steps::new(progress, turns.len());
        let peaks = each(
            &turns,
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
