//! Grids as pictures in text, for tests and examples.

use crate::{CellClass, ClassThresholds, Grid, GridError, GridFrame, Occupancy, OccupancyGrid};

impl OccupancyGrid {
    /// A map from a picture: `#` occupied, `.` free, `?` unknown; the first line is the highest
    /// row. Surrounding blank lines and indentation are ignored.
    ///
    /// # Errors
    /// Another character, lines of unequal length, or no cell at all.
    pub fn from_ascii(frame: GridFrame, picture: &str) -> Result<Self, GridError> {
        let lines: Vec<&str> =
            picture.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
        let width = lines.first().map_or(0, |line| line.chars().count());
        let mut cells = Vec::with_capacity(width * lines.len());
        for (index, line) in lines.iter().enumerate().rev() {
            for character in line.chars() {
                cells.push(match character {
                    '#' => Occupancy::OCCUPIED,
                    '.' => Occupancy::FREE,
                    '?' => Occupancy::UNKNOWN,
                    _ => {
                        return Err(GridError::UnknownCharacter { line: index + 1, character });
                    }
                });
            }
        }
        Ok(Self::new(frame, Grid::new(width, lines.len(), cells)?))
    }

    /// The picture of a map, the reverse of [`from_ascii`](Self::from_ascii); a known cell that is
    /// neither occupied nor free is `+`.
    #[must_use]
    pub fn to_ascii(&self) -> String {
        let thresholds = ClassThresholds::default();
        let mut picture = String::with_capacity((self.width() + 1) * self.height());
        for row in self.cells().rows().rev() {
            picture.extend(row.iter().map(|&cell| match thresholds.classify(cell) {
                CellClass::Occupied => '#',
                CellClass::Free => '.',
                CellClass::Undecided => '+',
                CellClass::Unknown => '?',
            }));
            picture.push('\n');
        }
        picture
    }
}

#[cfg(test)]
mod tests {
    use crate::{CellIndex, GridError, GridFrame, Occupancy, OccupancyGrid, Se2};

    fn frame() -> GridFrame {
        GridFrame::new(1.0, Se2::identity()).unwrap()
    }

    #[test]
    fn the_first_line_is_the_highest_row() {
        let map = OccupancyGrid::from_ascii(frame(), "#.\n.?").unwrap();
        let top_left = CellIndex { column: 0, row: 1 };
        assert_eq!(map.cells().get(top_left), Some(&Occupancy::OCCUPIED));
        assert_eq!(map.to_ascii(), "#.\n.?\n");
    }

    #[test]
    fn pictures_that_are_no_grid_are_errors() {
        let bad = |picture| OccupancyGrid::from_ascii(frame(), picture).unwrap_err();
        assert_eq!(bad("..\n.x"), GridError::UnknownCharacter { line: 2, character: 'x' });
        assert!(matches!(bad("..\n."), GridError::WrongCellCount { cells: 3, .. }));
        assert!(matches!(bad("\n"), GridError::ZeroArea { .. }));
    }
}
