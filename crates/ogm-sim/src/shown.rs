//! Where a map shows what its robot saw.

use std::collections::BTreeMap;

use nalgebra::{Point2, Vector2};
use ogm_core::Se2;

/// Side of the squares over which displacements are averaged, metres: the faces of a wall, seen from
/// two rooms, are displaced apart.
const SQUARE_M: f64 = 0.1;
/// Squares that are looked through around one in which nothing was hit: rounding to cells, and
/// walls that a mapper drew thicker.
const AROUND: i64 = 4;

/// Where a map shows the walls that its robot's lidar hit. A scan is displaced in one piece, by the
/// errors of the robot's pose, so what a wall is displaced by depends on where it was seen from;
/// scans from several places are averaged.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Shown {
    /// By where a place is, and by where it is shown, map frame.
    by_place: BTreeMap<[i64; 2], Sum>,
    by_shown: BTreeMap<[i64; 2], Sum>,
}

/// Of displacements.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Sum {
    displacement: Vector2<f64>,
    hits: f64,
}

impl Sum {
    fn add(&mut self, other: &Self) {
        self.displacement += other.displacement;
        self.hits += other.hits;
    }
}

impl Shown {
    /// Adds the hits of a scan that was taken at `place_from_robot` and drawn at
    /// `shown_from_robot`, both in the map frame.
    pub(crate) fn add_scan(
        &mut self,
        place_from_robot: Se2,
        shown_from_robot: Se2,
        beams: &[Vector2<f64>],
        ranges: &[f64],
    ) {
        let hits = beams.iter().zip(ranges).filter(|(_, range)| range.is_finite());
        let hits = hits.map(|(&beam, &range)| Point2::from(beam * range));
        let moves = hits.map(|hit| (place_from_robot * hit, shown_from_robot * hit));
        let moves: Vec<_> = moves.map(|(place, shown)| (place, shown, shown - place)).collect();
        add(&mut self.by_place, moves.iter().map(|(place, _, by)| (*place, *by)));
        add(&mut self.by_shown, moves.iter().map(|(_, shown, by)| (*shown, *by)));
    }

    /// Where the map shows what is at `place`; `None` if nothing was hit there.
    pub(crate) fn shown(&self, place: Point2<f64>) -> Option<Point2<f64>> {
        displacement(&self.by_place, place).map(|displacement| place + displacement)
    }

    /// What the map shows at `shown`; `None` if nothing.
    pub(crate) fn place(&self, shown: Point2<f64>) -> Option<Point2<f64>> {
        displacement(&self.by_shown, shown).map(|displacement| shown - displacement)
    }

    /// Where walls are that were hit: the middles of squares of a tenth of a metre, map frame.
    pub(crate) fn places(&self) -> impl Iterator<Item = Point2<f64>> {
        let middle = |square: &[i64; 2]| square.map(|index| (index as f64 + 0.5) * SQUARE_M);
        self.by_place.keys().map(move |square| Point2::from(middle(square)))
    }
}

/// Adds displacements at places, of which those of one square come in a row.
fn add(
    sums: &mut BTreeMap<[i64; 2], Sum>,
    displaced: impl Iterator<Item = (Point2<f64>, Vector2<f64>)>,
) {
    let mut displaced = displaced.map(|(at, by)| (square(at), by)).peekable();
    while let Some((square, by)) = displaced.next() {
        let mut row = Sum { displacement: by, hits: 1.0 };
        while let Some((_, by)) = displaced.next_if(|(next, _)| *next == square) {
            row.add(&Sum { displacement: by, hits: 1.0 });
        }
        sums.entry(square).or_default().add(&row);
    }
}

/// The mean of the nearest squares that have any.
fn displacement(sums: &BTreeMap<[i64; 2], Sum>, at: Point2<f64>) -> Option<Vector2<f64>> {
    let [column, row] = square(at);
    (0..=AROUND).find_map(|around| {
        let columns = column - around..=column + around;
        let squares = columns.flat_map(|c| sums.range([c, row - around]..=[c, row + around]));
        let mut sum = Sum::default();
        squares.for_each(|(_, square)| sum.add(square));
        (sum.hits > 0.0).then(|| sum.displacement / sum.hits)
    })
}

#[expect(clippy::cast_possible_truncation, reason = "a map is within 1000 km")]
fn square(at: Point2<f64>) -> [i64; 2] {
    [at.x, at.y].map(|coordinate| (coordinate / SQUARE_M).floor() as i64)
}
