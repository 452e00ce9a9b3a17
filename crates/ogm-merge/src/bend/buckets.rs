//! Points near a place.

use nalgebra::{Point2, Vector2};

/// Least side of a bucket, metres: the reach of most searches.
const SIDE_M: f64 = 0.4;
/// Most buckets of few points, and besides for each point: walls leave most of a map empty.
const MOST_BUCKETS: f64 = 1024.0;
const MOST_A_POINT: f64 = 64.0;

/// Points sorted into square buckets, row by row.
#[derive(Debug, Clone)]
pub(super) struct Buckets {
    low: Point2<f64>,
    side: f64,
    columns: usize,
    rows: usize,
    /// Where the entries of each bucket start, and the end of the last.
    starts: Vec<usize>,
    /// Points by their places in the list.
    entries: Vec<usize>,
}

impl Buckets {
    pub(super) fn new(points: impl ExactSizeIterator<Item = Point2<f64>> + Clone) -> Self {
        let limit = MOST_BUCKETS + MOST_A_POINT * points.len() as f64;
        let corners = points.clone().map(|point| (point, point));
        let corners = corners.reduce(|(low, high), (point, _)| (low.inf(&point), high.sup(&point)));
        let (low, high) = corners.unwrap_or_default();
        let mut side = SIDE_M;
        let size = |side: f64| ((high - low) / side).map(|extent| extent.floor() + 1.0);
        while size(side).product() > limit {
            side *= 2.0;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "limited")]
        let [columns, rows] = [size(side).x as usize, size(side).y as usize];
        let mut buckets = Self {
            low,
            side,
            columns,
            rows,
            starts: vec![0; columns * rows + 1],
            entries: Vec::new(),
        };
        let in_bucket: Vec<usize> =
            points.map(|point| buckets.row(point.y) * columns + buckets.column(point.x)).collect();
        for &bucket in &in_bucket {
            buckets.starts[bucket + 1] += 1;
        }
        for bucket in 0..columns * rows {
            buckets.starts[bucket + 1] += buckets.starts[bucket];
        }
        buckets.entries = (0..in_bucket.len()).collect();
        buckets.entries.sort_by_key(|&point| in_bucket[point]);
        buckets
    }

    /// The points within `reach` of `place` along either axis, and some further ones.
    pub(super) fn around(&self, place: Point2<f64>, reach: f64) -> impl Iterator<Item = usize> {
        let reach = Vector2::repeat(reach);
        let (low, high) = (place - reach, place + reach);
        let columns = self.column(low.x)..=self.column(high.x);
        (self.row(low.y)..=self.row(high.y)).flat_map(move |row| {
            let first = self.starts[row * self.columns + columns.start()];
            let end = self.starts[row * self.columns + columns.end() + 1];
            self.entries[first..end].iter().copied()
        })
    }

    fn column(&self, x: f64) -> usize {
        index((x - self.low.x) / self.side, self.columns)
    }

    fn row(&self, y: f64) -> usize {
        index((y - self.low.y) / self.side, self.rows)
    }
}

/// The index of a bucket, the first or last where the place lies outside.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
fn index(buckets: f64, count: usize) -> usize {
    (buckets.floor() as usize).min(count - 1)
}
