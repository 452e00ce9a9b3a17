//! What a map looks like from inside, to find among many maps those that are worth a match.

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use crate::lattice::floor_index;
use crate::prepare::PreparedMap;
use crate::state::State;
use crate::surroundings::Distance;

/// Places are looked for this far apart, metres.
const GRID_M: f64 = 0.25;
/// A place is the one farthest from walls within this, metres.
const APART_M: f64 = 1.0;
/// Nearer to a wall there is nothing to see, metres.
const LEAST_CLEARANCE_M: f64 = 0.4;
/// Most places of a map.
const MOST_PLACES: usize = 128;
/// Beams of a view, and how far each looks, metres.
const BEAMS: usize = 48;
const REACH_M: f64 = 8.0;
/// Harmonics of a view that are kept.
const HARMONICS: usize = 14;
/// How many maps a place speaks for.
const VOTES: usize = 12;

/// How far one sees from a place over the direction, as the amplitudes of its harmonics.
pub type View = [f32; HARMONICS];

/// Views from the middles of the rooms of a map, whatever its heading: the spectrum of how far one
/// sees over the direction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MapSignature {
    views: Vec<View>,
}

impl PreparedMap {
    /// What the map looks like from inside.
    #[must_use]
    pub fn signature(&self) -> MapSignature {
        MapSignature { views: self.places().into_iter().map(|at| self.view(at)).collect() }
    }

    /// The middles of rooms: free places that are farther from walls than those around them.
    fn places(&self) -> Vec<Point2<f64>> {
        let step = floor_index((GRID_M / self.lattice.resolution).round()).max(1);
        let (columns, rows) = (self.lattice.width / step, self.lattice.height / step);
        let clearance = |column: usize, row: usize| {
            let cell = self.cells[row * step * self.lattice.width + column * step];
            if cell.state == State::Free { cell.distance } else { Distance::ZERO }
        };
        let reach = floor_index((APART_M / (step as f64 * self.lattice.resolution)).round()).max(1);
        let mut places: Vec<(Distance, Point2<f64>)> = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let own = clearance(column, row);
                if own.metres() < LEAST_CLEARANCE_M {
                    continue;
                }
                let around =
                    (row.saturating_sub(reach)..(row + reach + 1).min(rows)).flat_map(|r| {
                        (column.saturating_sub(reach)..(column + reach + 1).min(columns))
                            .map(move |c| (c, r))
                    });
                // Of equals, the first.
                let is_highest = |(c, r)| {
                    let other = clearance(c, r);
                    other < own || other == own && (r, c) >= (row, column)
                };
                if around.into_iter().all(is_highest) {
                    let index = row * step * self.lattice.width + column * step;
                    places.push((own, self.lattice.centre(index)));
                }
            }
        }
        places.sort_by_key(|&(clearance, _)| std::cmp::Reverse(clearance));
        places.truncate(MOST_PLACES);
        places.into_iter().map(|(_, at)| at).collect()
    }

    #[expect(clippy::cast_possible_truncation, reason = "single precision will do")]
    fn view(&self, from: Point2<f64>) -> View {
        let seen: Vec<f64> = (0..BEAMS)
            .map(|beam| {
                let (sin, cos) = (TAU * beam as f64 / BEAMS as f64).sin_cos();
                (self.sight(from, Vector2::new(cos, sin)) / REACH_M).sqrt()
            })
            .collect();
        std::array::from_fn(|harmonic| {
            let (mut re, mut im) = (0.0, 0.0);
            for (beam, seen) in seen.iter().enumerate() {
                let (sin, cos) = (TAU * (harmonic * beam) as f64 / BEAMS as f64).sin_cos();
                re += seen * cos;
                im += seen * sin;
            }
            (re.hypot(im) / BEAMS as f64) as f32
        })
    }

    /// How far one sees along a direction until something is in the way or nothing is known.
    fn sight(&self, from: Point2<f64>, along: Vector2<f64>) -> f64 {
        let cell = self.lattice.resolution;
        let mut far = 0.0;
        while far < REACH_M {
            let Some(index) = self.lattice.index(from + far * along) else { break };
            let here = self.cells[index];
            if here.state != State::Free {
                break;
            }
            // No wall is nearer, but the unknown may be.
            far += here.distance.metres().min(4.0 * cell).max(cell);
        }
        far.min(REACH_M)
    }
}

/// Pairs of maps that look alike from inside: for each map `partners` others, those its rooms speak
/// for most. Ascending; the first of a pair before the second.
///
/// A room speaks for the maps with rooms most like it, and the more the likelier these are than the
/// next, so that rooms of which every map has some say little.
#[must_use]
pub fn candidate_pairs(signatures: &[MapSignature], partners: usize) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    for (map, signature) in signatures.iter().enumerate() {
        let mut votes = vec![0.0_f64; signatures.len()];
        for view in &signature.views {
            let mut nearest: Vec<(f32, usize)> = signatures
                .iter()
                .enumerate()
                .filter(|&(other, _)| other != map)
                .filter_map(|(other, found)| Some((found.nearest(view)?, other)))
                .collect();
            nearest.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let Some(&(next, _)) = nearest.get(VOTES).or(nearest.last()) else { continue };
            for &(distance, other) in nearest.iter().take(VOTES) {
                votes[other] += f64::from(1.0 - distance / next.max(f32::MIN_POSITIVE)).powi(2);
            }
        }
        let mut others: Vec<usize> = (0..signatures.len()).filter(|&other| other != map).collect();
        others.sort_by(|&a, &b| votes[b].total_cmp(&votes[a]).then(a.cmp(&b)));
        pairs.extend(others.iter().take(partners).map(|&other| (map.min(other), map.max(other))));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

impl MapSignature {
    /// The views, to be kept or sent.
    #[must_use]
    pub fn views(&self) -> &[View] {
        &self.views
    }

    /// The signature of these views.
    #[must_use]
    pub fn from_views(views: Vec<View>) -> Self {
        Self { views }
    }

    /// Squared distance of the view that is most like `view`.
    fn nearest(&self, view: &View) -> Option<f32> {
        let distance = |own: &View| own.iter().zip(view).map(|(a, b)| (a - b).powi(2)).sum::<f32>();
        self.views.iter().map(distance).min_by(f32::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use ogm_core::{ClassThresholds, GridFrame, Occupancy, OccupancyGrid, Se2};

    use super::{MapSignature, candidate_pairs};
    use crate::prepare::PreparedMap;

    /// Two rooms of these widths, metres, and what `turns` quarter turns make of them.
    fn rooms(widths: [f64; 2], turns: usize) -> MapSignature {
        let cell = 0.1;
        let size = 160;
        let mut cells = vec![Occupancy::UNKNOWN; size * size];
        for row in 0..size {
            for column in 0..size {
                let (mut x, mut y) = (column as f64 * cell - 8.0, row as f64 * cell - 8.0);
                for _ in 0..turns {
                    (x, y) = (-y, x);
                }
                let [left, right] = widths;
                let is_inside = x > -left && x < right && (0.0..3.0).contains(&y);
                let is_wall = x > -left - cell && x < right + cell && y > -cell && y < 3.0 + cell;
                let between = x.abs() < cell / 2.0 && y > 1.0;
                cells[row * size + column] = match (is_inside && !between, is_wall) {
                    (true, _) => Occupancy::FREE,
                    (false, true) => Occupancy::OCCUPIED,
                    (false, false) => Occupancy::UNKNOWN,
                };
            }
        }
        let grid = ogm_core::Grid::new(size, size, cells).unwrap();
        let frame = GridFrame::new(cell, Se2::new(-3.0, 1.0, 0.4)).unwrap();
        let map = OccupancyGrid::new(frame, grid);
        PreparedMap::new(&map, &ClassThresholds::default(), &()).unwrap().signature()
    }

    #[test]
    fn maps_of_the_same_rooms_find_each_other_whatever_their_heading() {
        let kinds = [[3.0, 5.0], [2.0, 2.5], [6.5, 4.0], [7.0, 1.5]];
        let maps: Vec<MapSignature> =
            kinds.iter().flat_map(|&kind| [rooms(kind, 0), rooms(kind, 1)]).collect();
        assert!(maps.iter().all(|map| !map.views().is_empty()));
        let likely = candidate_pairs(&maps, 2);
        assert!(likely.len() <= 14, "half of all at most");
        assert!([(0, 1), (2, 3), (4, 5), (6, 7)].iter().all(|pair| likely.contains(pair)));
        assert_eq!(candidate_pairs(&maps, maps.len()).len(), 8 * 7 / 2, "all of them at most");
        let again: Vec<MapSignature> =
            maps.iter().map(|map| MapSignature::from_views(map.views().to_vec())).collect();
        assert_eq!(candidate_pairs(&again, 2), candidate_pairs(&maps, 2));
    }

    #[test]
    fn a_map_of_nothing_has_no_views_and_is_no_hindrance() {
        let nothing = MapSignature::default();
        assert!(candidate_pairs(&[], 3).is_empty());
        let maps = [rooms([3.0, 5.0], 0), nothing, rooms([3.0, 5.0], 1)];
        assert!(candidate_pairs(&maps, 1).contains(&(0, 2)));
    }
}
