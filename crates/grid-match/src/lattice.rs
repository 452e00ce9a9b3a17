//! Cells of a prepared map, looked up by metres in its local frame.

use nalgebra::{Point2, Vector2};

/// Width, height and metres a cell; cell (0, 0) has its lower-left corner at the local origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lattice {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) resolution: f64,
}

/// A value between cell centres and how it changes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slope {
    pub(crate) value: f64,
    /// Change a metre.
    pub(crate) gradient: Vector2<f64>,
}

impl Lattice {
    /// The centre of the cell at `index`, row-major.
    pub(crate) fn centre(&self, index: usize) -> Point2<f64> {
        let (column, row) = (index % self.width, index / self.width);
        Point2::new(column as f64 + 0.5, row as f64 + 0.5) * self.resolution
    }

    /// The cell that contains `point`, row-major.
    #[inline]
    pub(crate) fn index(&self, point: Point2<f64>) -> Option<usize> {
        let (x, y) = (point.x / self.resolution, point.y / self.resolution);
        let inside = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64;
        inside.then(|| floor_index(y) * self.width + floor_index(x))
    }

    /// `field` at `point` by bilinear interpolation, unless a corner lies outside.
    #[inline]
    pub(crate) fn slope(&self, field: &[f32], point: Point2<f64>) -> Option<Slope> {
        let per_metre = 1.0 / self.resolution;
        let (x, y) = (point.x * per_metre - 0.5, point.y * per_metre - 0.5);
        let inside =
            x >= 0.0 && y >= 0.0 && x < (self.width - 1) as f64 && y < (self.height - 1) as f64;
        if !inside {
            return None;
        }
        let (column, row) = (floor_index(x), floor_index(y));
        let (right, up) = (x - column as f64, y - row as f64);
        let at = row * self.width + column;
        let [a, b] = [f64::from(field[at]), f64::from(field[at + 1])];
        let [c, d] = [f64::from(field[at + self.width]), f64::from(field[at + self.width + 1])];
        let (low, high) = (a + right * (b - a), c + right * (d - c));
        let along_x = (b - a) + up * ((d - c) - (b - a));
        Some(Slope {
            value: low + up * (high - low),
            gradient: Vector2::new(along_x, high - low) * per_metre,
        })
    }
}

/// The whole part of a number that is not negative.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "callers pass numbers from 0 up to the size of a grid"
)]
pub(crate) fn floor_index(x: f64) -> usize {
    x as usize
}
