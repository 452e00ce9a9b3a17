//! Cells of a prepared map, looked up by metres in its local frame.

use nalgebra::{Point2, Vector2};

/// Width, height and metres a cell; cell (0, 0) has its lower-left corner at the local origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lattice {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) resolution: f64,
    /// Cells, for a division at each place that is looked up takes as long as the rest.
    per_metre: f64,
}

/// A value between cell centres and how it changes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slope {
    pub(crate) value: f64,
    /// Change a metre.
    pub(crate) gradient: Vector2<f64>,
}

/// Where a point lies between four cell centres.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corners {
    /// Of the lower row, the left one.
    lower: usize,
    /// And of the upper row.
    upper: usize,
    /// How far to the right and up of them, cells.
    right: f64,
    up: f64,
    per_metre: f64,
}

impl Lattice {
    pub(crate) fn new(width: usize, height: usize, resolution: f64) -> Self {
        Self { width, height, resolution, per_metre: 1.0 / resolution }
    }

    /// The centre of the cell at `index`, row-major.
    pub(crate) fn centre(&self, index: usize) -> Point2<f64> {
        let (column, row) = (index % self.width, index / self.width);
        Point2::new(column as f64 + 0.5, row as f64 + 0.5) * self.resolution
    }

    /// The cell that contains `point`, row-major.
    #[inline]
    pub(crate) fn index(&self, point: Point2<f64>) -> Option<usize> {
        let (x, y) = (point.x * self.per_metre, point.y * self.per_metre);
        let inside = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64;
        inside.then(|| floor_index(y) * self.width + floor_index(x))
    }

    /// The four cell centres around `point`, unless one lies outside.
    #[inline]
    pub(crate) fn corners(&self, point: Point2<f64>) -> Option<Corners> {
        let per_metre = self.per_metre;
        let (x, y) = (point.x * per_metre - 0.5, point.y * per_metre - 0.5);
        let inside =
            x >= 0.0 && y >= 0.0 && x < (self.width - 1) as f64 && y < (self.height - 1) as f64;
        inside.then(|| {
            let (column, row) = (floor_index(x), floor_index(y));
            let lower = row * self.width + column;
            let (right, up) = (x - column as f64, y - row as f64);
            Corners { lower, upper: lower + self.width, right, up, per_metre }
        })
    }
}

impl Corners {
    /// Of four, the cell that contains the point.
    #[inline]
    pub(crate) fn nearest(&self) -> usize {
        let row = if self.up >= 0.5 { self.upper } else { self.lower };
        row + usize::from(self.right >= 0.5)
    }

    /// A value given at the centres, by bilinear interpolation.
    #[inline]
    pub(crate) fn slope(&self, value: impl Fn(usize) -> f64) -> Slope {
        let Self { lower, upper, right, up, per_metre } = *self;
        let [a, b, c, d] = [lower, lower + 1, upper, upper + 1].map(value);
        let (low, high) = (a + right * (b - a), c + right * (d - c));
        let along_x = (b - a) + up * ((d - c) - (b - a));
        Slope {
            value: low + up * (high - low),
            gradient: Vector2::new(along_x, high - low) * per_metre,
        }
    }
}

/// The whole part of a number that is not negative, of at most 32 bits: more take a processor
/// without the instruction for it several times as long.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "callers pass numbers from 0 up to the side of a grid"
)]
pub(crate) fn floor_index(x: f64) -> usize {
    x as u32 as usize
}
