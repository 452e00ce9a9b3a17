//! Candidate poses: every translation at each of some rotations.

use nalgebra::{Point2, Vector2};
use ogm_core::{Cancelled, Progress, Se2, Steps, wrap_angle};

use crate::bounds::Bounds;
use crate::correlate::{Correlator, Surface};
use crate::correlation_planes::{CorrelationPlanes, FreeShare, Side, turned_box, turned_lattice};
use crate::lattice::floor_index;
use crate::parallel::each;
use crate::prepare::PreparedMap;
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
        let rotations = &rotations[..allowed.count()];
        let done = Steps::new(progress, rotations.len());
        let peaks = each(
            rotations,
            || correlator.workspace(),
            |space, &theta| {
                let (map, free) = (self.second, &self.second_free);
                let turned = CorrelationPlanes::turned(map, free, theta, Side::Second);
                let surface = correlator.correlate(&turned, space);
                let peaks = self.peaks(&surface, &turned, theta, bounds);
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
        turned: &CorrelationPlanes,
        theta: f64,
        bounds: Option<&Bounds>,
    ) -> Vec<Candidate> {
        let shift = |index: usize, first: usize, length: usize| {
            if index < first { index as f64 } else { index as f64 - length as f64 }
        };
        let mut peaks: Vec<Candidate> = surface
            .maxima(0.0)
            .into_iter()
            .map(|(column, row, score)| {
                let cells = Vector2::new(
                    shift(column, self.first_planes.width, surface.columns),
                    shift(row, self.first_planes.height, surface.rows),
                );
                let translation = cells * self.cell + self.first_planes.origin - turned.origin;
                let first_from_second = Se2::new(translation.x, translation.y, theta);
                Candidate { first_from_second, score: f64::from(score) }
            })
            .filter(|peak| {
                bounds.is_none_or(|bounds| bounds.near(&peak.first_from_second, self.cell))
            })
            .collect();
        peaks.sort_by(|a, b| b.score.total_cmp(&a.score));
        peaks.truncate(PEAKS);
        peaks
    }

    /// Radius of the second map about its centre, metres.
    pub(crate) fn radius(&self) -> f64 {
        let centre = self.second.centre;
        self.second
            .samples
            .iter()
            .map(|sample| (sample.at - centre).norm())
            .fold(self.cell, f64::max)
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
