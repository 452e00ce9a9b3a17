//! The neighbourhood of an infinite line.

/// Column and row of a cell.
pub(crate) type Cell = [i32; 2];

/// The cells closer than a distance to the infinite line through two cells.
///
/// Tsardoulias et al., Eq. 3, without its division: products of cell coordinates are integers, so
/// the comparison is exact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Strip {
    through: Cell,
    along: [i64; 2],
    /// Whole number that |cross product| must stay below.
    limit: f64,
}

impl Strip {
    /// Cells closer than `distance` to the line through `b` and `c`; none if these coincide.
    pub(crate) fn new(b: Cell, c: Cell, distance: f64) -> Self {
        let along = difference(c, b);
        let length = ((along[0] * along[0] + along[1] * along[1]) as f64).sqrt();
        Self { through: b, along, limit: (distance * length).ceil() }
    }

    pub(crate) fn contains(&self, a: Cell) -> bool {
        (self.cross(a).abs() as f64) < self.limit
    }

    /// Twice the signed area of the triangle of `a` and the two cells of the line.
    pub(crate) fn cross(&self, a: Cell) -> i64 {
        let [x, y] = difference(a, self.through);
        self.along[0] * y - self.along[1] * x
    }

    pub(crate) fn along(&self) -> [i64; 2] {
        self.along
    }

    pub(crate) fn limit(&self) -> f64 {
        self.limit
    }
}

/// `a - b`, wide enough for products.
pub(crate) fn difference(a: Cell, b: Cell) -> [i64; 2] {
    [i64::from(a[0]) - i64::from(b[0]), i64::from(a[1]) - i64::from(b[1])]
}

#[cfg(test)]
mod tests {
    use super::Strip;

    #[test]
    fn t_l1_distance_of_equation_3() {
        for (a, b, c, distance) in [([3, 4], [0, 0], [10, 0], 4.0), ([0, 5], [1, 1], [4, 5], 3.2)] {
            assert!(!Strip::new(b, c, distance).contains(a), "strictly closer");
            assert!(Strip::new(b, c, distance + 1e-9).contains(a));
        }
    }

    #[test]
    fn one_cell_is_no_line() {
        assert!(!Strip::new([3, 3], [3, 3], 2.0).contains([3, 3]));
    }
}
