//! Lengths that must not fall below a number of cells.

/// A length in metres that is never less than a number of cells of the grid it is used on.
///
/// Thresholds of the literature are printed in pixels of one resolution. As metres they keep their
/// meaning on any map; the floor in cells keeps them above the rasterisation of a coarse one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Length {
    /// Metres.
    pub metres: f64,
    /// Cells of the (coarser) grid that the length must at least be.
    pub min_cells: f64,
}

impl Length {
    /// A length of `metres`, whatever the resolution.
    #[must_use]
    pub const fn metres(metres: f64) -> Self {
        Self { metres, min_cells: 0.0 }
    }

    /// A length of `cells` of whatever grid it is used on.
    #[must_use]
    pub const fn cells(cells: f64) -> Self {
        Self { metres: 0.0, min_cells: cells }
    }

    /// The same length, but at least `cells` long.
    #[must_use]
    pub const fn at_least_cells(self, cells: f64) -> Self {
        Self { metres: self.metres, min_cells: cells }
    }

    /// Metres at `resolution` metres a cell.
    #[must_use]
    pub fn resolve(&self, resolution: f64) -> f64 {
        self.metres.max(self.min_cells * resolution)
    }
}

#[cfg(test)]
mod tests {
    use super::Length;

    #[test]
    fn the_floor_holds_on_coarse_grids_only() {
        let length = Length::metres(0.04).at_least_cells(1.5);
        assert_eq!(length.resolve(0.02), 0.04);
        assert_eq!(length.resolve(0.1), 0.15000000000000002);
        assert_eq!(Length::cells(5.0).resolve(1.0), 5.0);
    }
}
