//! The walls of a map by patches: parts about the size of a room, over which it is hardly bent.

use std::collections::BTreeMap;

use nalgebra::{Point2, Vector2};

use crate::lattice::floor_index;
use crate::wall_points::WallPoint;

/// Side of a patch, metres.
const PATCH_M: f64 = 4.0;
/// Places along a side of a patch: of a metre each, about a door or a corner.
const PLACES_A_SIDE: usize = 4;
/// Places of a patch.
pub(crate) const PLACES: usize = PLACES_A_SIDE * PLACES_A_SIDE;

/// A square of a map.
#[derive(Debug, Clone, Default)]
pub(crate) struct Patch {
    /// In the order of the walls of the map, where those that are used first come first.
    walls: Vec<WallPoint>,
    /// The rank of each in that order.
    ranks: Vec<usize>,
    /// In which of its [`PLACES`] each lies.
    places: Vec<usize>,
    /// The patches that touch this one by side or corner.
    pub(crate) around: Vec<usize>,
}

impl Patch {
    /// Those that are among the first `most` of the map.
    pub(crate) fn walls(&self, most: usize) -> &[WallPoint] {
        &self.walls[..self.ranks.partition_point(|&rank| rank < most)]
    }

    /// Those that are among the first `most` of the map, each with its place.
    pub(crate) fn placed_walls(&self, most: usize) -> impl Iterator<Item = (usize, &WallPoint)> {
        self.places.iter().copied().zip(self.walls(most))
    }
}

/// The squares that hold any of `walls`.
pub(crate) fn patches(walls: &[WallPoint]) -> Vec<Patch> {
    let mut squares: BTreeMap<[usize; 2], Patch> = BTreeMap::new();
    for (rank, &wall) in walls.iter().enumerate() {
        let place =
            [wall.at.x, wall.at.y].map(|along| floor_index(along * PLACES_A_SIDE as f64 / PATCH_M));
        let patch = squares.entry(place.map(|along| along / PLACES_A_SIDE)).or_default();
        let [column, row] = place.map(|along| along % PLACES_A_SIDE);
        patch.walls.push(wall);
        patch.ranks.push(rank);
        patch.places.push(row * PLACES_A_SIDE + column);
    }
    let places: BTreeMap<[usize; 2], usize> =
        squares.keys().enumerate().map(|(index, &square)| (square, index)).collect();
    let with_around = |(square, patch): ([usize; 2], Patch)| {
        let around = neighbours(square).filter_map(|near| places.get(&near).copied()).collect();
        Patch { around, ..patch }
    };
    squares.into_iter().map(with_around).collect()
}

fn neighbours([column, row]: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
    (row.saturating_sub(1)..=row + 1).flat_map(move |near_row| {
        (column.saturating_sub(1)..=column + 1)
            .map(move |near_column| [near_column, near_row])
            .filter(move |&near| near != [column, row])
    })
}

/// The mean of their places.
pub(crate) fn centroid(walls: &[WallPoint]) -> Point2<f64> {
    let sum: Vector2<f64> = walls.iter().map(|wall| wall.at.coords).sum();
    Point2::from(sum / walls.len().max(1) as f64)
}
