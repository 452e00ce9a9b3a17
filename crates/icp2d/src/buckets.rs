//! Nearest neighbours among points about as dense as the cells of walls.

use nalgebra::{Point2, distance_squared};

use crate::nearest::Nearest;

/// Points sorted into square buckets, row-major.
#[derive(Debug)]
pub(crate) struct Buckets {
    corner: Point2<f64>,
    size: f64,
    columns: i64,
    rows: i64,
    /// Where the entries of each bucket start, and the end of the last.
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    position: Point2<f64>,
    index: u32,
}

/// Side of a bucket in spacings: a wall crosses it with about as many points.
const BUCKET_SPACINGS: f64 = 8.0;
/// Buckets that may be empty for each point; walls leave most of a map empty.
const MAX_BUCKETS_A_POINT: usize = 64;
/// Most points of a bucket: four a cell.
const MAX_IN_BUCKET: u32 = 256;
/// Rounding of bucket coordinates, with room to spare, in buckets.
const ROUNDING: f64 = 1e-6;

impl Buckets {
    /// `None` if the points are much denser or sparser than `spacing`, where buckets are slow.
    pub(crate) fn new(points: &[Point2<f64>], spacing: f64) -> Option<Self> {
        let size = BUCKET_SPACINGS * spacing;
        let first = *points.first()?;
        let (corner, opposite) =
            points.iter().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
        let extent = (opposite - corner) / size;
        let limit = 1024 + MAX_BUCKETS_A_POINT * points.len();
        // In floating point first: the product of two extents may exceed any integer.
        let count = (extent.x.floor() + 1.0) * (extent.y.floor() + 1.0);
        if count > limit as f64 {
            return None;
        }
        let mut buckets = Self {
            corner,
            size,
            columns: floor(extent.x) + 1,
            rows: floor(extent.y) + 1,
            starts: Vec::new(),
            entries: Vec::new(),
        };
        buckets.sort(points)?;
        Some(buckets)
    }

    /// Counting sort; `None` if a bucket is too full.
    fn sort(&mut self, points: &[Point2<f64>]) -> Option<()> {
        let bucket_count = usize::try_from(self.columns * self.rows).ok()?;
        let bucket_of = |point: &Point2<f64>| {
            let [x, y] = self.coordinates(*point).map(floor);
            let column = x.clamp(0, self.columns - 1);
            let row = y.clamp(0, self.rows - 1);
            position(row * self.columns + column)
        };
        let mut starts = vec![0_u32; bucket_count + 1];
        for point in points {
            starts[bucket_of(point) + 1] += 1;
        }
        if starts.iter().any(|&count| count > MAX_IN_BUCKET) {
            return None;
        }
        for bucket in 0..bucket_count {
            starts[bucket + 1] += starts[bucket];
        }
        let nowhere = Entry { position: self.corner, index: u32::MAX };
        let mut entries = vec![nowhere; points.len()];
        let mut next = starts.clone();
        for (index, point) in (0..).zip(points) {
            let slot = &mut next[bucket_of(point)];
            entries[*slot as usize] = Entry { position: *point, index };
            *slot += 1;
        }
        self.starts = starts;
        self.entries = entries;
        Some(())
    }

    pub(crate) fn nearest(&self, query: Point2<f64>, mut best: Nearest) -> Nearest {
        let [x, y] = self.coordinates(query);
        let (column, row) = (floor(x), floor(y));
        let (right, top) = (self.columns - 1, self.rows - 1);
        let first_ring = 0.max(-column).max(column - right).max(-row).max(row - top);
        let last_ring = column.abs().max((right - column).abs());
        let last_ring = last_ring.max(row.abs()).max((top - row).abs());
        let (inside_x, inside_y) = (x - column as f64, y - row as f64);
        let to_border = inside_x.min(1.0 - inside_x).min(inside_y).min(1.0 - inside_y);
        for ring in first_ring..=last_ring {
            // In buckets; what is further away in x or in y cannot be nearer.
            let reach = best.others_sq.sqrt() / self.size + ROUNDING;
            if (ring - 1) as f64 + to_border > reach {
                break;
            }
            let left = (column - ring).max(floor(x - reach)).max(0);
            let right = (column + ring).min(floor(x + reach)).min(right);
            let bottom = (row - ring).max(floor(y - reach)).max(0);
            let top = (row + ring).min(floor(y + reach)).min(top);
            for at in bottom..=top {
                if (at - row).abs() == ring {
                    self.scan(at, left, right, query, &mut best);
                    continue;
                }
                if column - ring >= left {
                    self.scan(at, column - ring, column - ring, query, &mut best);
                }
                if column + ring <= right {
                    self.scan(at, column + ring, column + ring, query, &mut best);
                }
            }
        }
        best
    }

    pub(crate) fn for_each_within(
        &self,
        centre: Point2<f64>,
        radius: f64,
        mut visit: impl FnMut(Point2<f64>),
    ) {
        let [x, y] = self.coordinates(centre);
        let reach = radius / self.size + ROUNDING;
        let left = floor(x - reach).max(0);
        let right = floor(x + reach).min(self.columns - 1);
        for row in floor(y - reach).max(0)..=floor(y + reach).min(self.rows - 1) {
            for entry in self.run(row, left, right) {
                if distance_squared(&entry.position, &centre) <= radius * radius {
                    visit(entry.position);
                }
            }
        }
    }

    fn scan(&self, row: i64, left: i64, right: i64, query: Point2<f64>, best: &mut Nearest) {
        for entry in self.run(row, left, right) {
            best.improve(entry.index, distance_squared(&entry.position, &query));
        }
    }

    /// The entries of adjacent buckets of one row, which are contiguous.
    fn run(&self, row: i64, left: i64, right: i64) -> &[Entry] {
        if left > right {
            return &[];
        }
        let from = self.starts[position(row * self.columns + left)];
        let to = self.starts[position(row * self.columns + right) + 1];
        &self.entries[from as usize..to as usize]
    }

    fn coordinates(&self, point: Point2<f64>) -> [f64; 2] {
        let offset = (point - self.corner) / self.size;
        [offset.x, offset.y]
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "clamped to what a query or a point can be away from a map"
)]
fn floor(x: f64) -> i64 {
    // Faster than `f64::floor`, which is a call on many processors.
    let x = x.clamp(-1e15, 1e15);
    let towards_zero = x as i64;
    towards_zero - i64::from(towards_zero as f64 > x)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "bucket numbers are clamped to the grid, which was allocated"
)]
fn position(bucket: i64) -> usize {
    bucket as usize
}
