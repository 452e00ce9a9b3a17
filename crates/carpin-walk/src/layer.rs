//! One class of the target map: how far everything is from it, and it from everything.

use ogm_core::{Grid, l1_distance, l1_spread};

use crate::class_map::ClassMap;

/// Manhattan distances between one class of the target and the same class of a placed source.
///
/// Both fields cover only the box in which the target has cells of either class. A cell outside is
/// as far from a cell inside as its nearest point of the box plus the way there: city-block
/// distance adds along the axes. So no field ever covers the canvas.
#[derive(Debug, Clone)]
pub(crate) struct Layer {
    /// Positions in the box of the target's cells of this class.
    members: Vec<u32>,
    /// To the nearest of them, from each cell of the box; zero if there is none.
    to_target: Vec<u32>,
    /// To the nearest source cell of this class, once it has spread.
    to_source: Grid<u32>,
    /// Over the source cells counted so far, the distance to the target.
    sum: u64,
    counted: usize,
    /// Source cells of this class on the canvas, counted or not.
    placed: usize,
}

/// The two directed terms of a class before division.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Directed {
    pub(crate) target_cells: usize,
    pub(crate) target_sum: u64,
    pub(crate) source_cells: usize,
    pub(crate) source_sum: u64,
}

impl Layer {
    pub(crate) fn new(target: &ClassMap, code: u8) -> Self {
        let mask = target.codes.map(|&cell| cell == code);
        let members = (0..).zip(mask.cells()).filter(|(_, set)| **set).map(|(at, _)| at).collect();
        let distance = l1_distance(&mask).unwrap_or_else(|| mask.map(|_| 0));
        Self {
            members,
            to_target: distance.cells().to_vec(),
            to_source: distance,
            sum: 0,
            counted: 0,
            placed: 0,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.to_source.cells_mut().fill(u32::MAX);
        (self.sum, self.counted, self.placed) = (0, 0, 0);
    }

    /// A source cell whose nearest point of the box is at `position`, `away` cells from it.
    #[inline]
    pub(crate) fn add(&mut self, position: usize, away: u32, counts: bool) {
        self.placed += 1;
        let cell = &mut self.to_source.cells_mut()[position];
        *cell = (*cell).min(away);
        if counts {
            self.counted += 1;
            self.sum += u64::from(self.to_target[position]) + u64::from(away);
        }
    }

    /// The sums over the source cells that counted and the target cells that do.
    pub(crate) fn finish(&mut self, counts: Option<&[bool]>) -> Directed {
        let chosen = |at: &&u32| counts.is_none_or(|counts| counts[**at as usize]);
        let target_cells = match counts {
            Some(_) => self.members.iter().filter(chosen).count(),
            None => self.members.len(),
        };
        let mut target_sum = 0;
        if target_cells > 0 && self.placed > 0 {
            l1_spread(&mut self.to_source);
            let field = self.to_source.cells();
            let distances = self.members.iter().filter(chosen).map(|&at| field[at as usize]);
            target_sum = distances.map(u64::from).sum();
        }
        let reachable = if self.members.is_empty() { 0 } else { self.counted };
        Directed {
            target_cells,
            target_sum,
            source_cells: self.counted,
            source_sum: if reachable > 0 { self.sum } else { 0 },
        }
    }
}
