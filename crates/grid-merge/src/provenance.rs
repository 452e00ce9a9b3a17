//! Which maps say what, cell by cell.

use std::collections::BTreeMap;

use ogm_core::{Grid, GridFrame, Progress, Stage, Steps};

use crate::error::FusionError;
use crate::lay::{Laid, lay};
use crate::params::FusionParams;
use crate::placed::PlacedMap;
use crate::rows::Said;
use crate::verdict::{SAID_FREE, SAID_OCCUPIED, Tables};

/// Rows that are read of every map at a time.
const BAND: usize = 64;

/// Which maps say what of each cell of a merged map.
#[derive(Debug, Clone, PartialEq)]
pub struct Provenance {
    /// Where the cells lie: as those of the merged map.
    pub frame: GridFrame,
    /// Of each cell, its place in `claims`.
    pub cells: Grid<u16>,
    /// What is said of cells; the first is that no map says occupied or free.
    pub claims: Vec<Claim>,
}

/// What the maps say of a cell, by their place in what was handed in.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Claim {
    /// The maps that say occupied.
    pub occupied: Vec<usize>,
    /// The maps that say free.
    pub free: Vec<usize>,
}

/// Which of `maps` say what, on the cells that [`merge`](crate::merge()) gives them with the same
/// `params`.
///
/// # Errors
/// Those of [`merge`](crate::merge()), and [`FusionError::TooManyClaims`].
pub fn provenance(
    maps: &[PlacedMap<'_>],
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<Provenance, FusionError> {
    let Laid { lattice, bounds, reaches } = lay(maps, params, &Stage::new(progress, 0.0, 0.4))?;
    let tables = Tables::new(&params.thresholds);
    let (width, height) = bounds.size();
    let mut cells = Grid::filled(width, height, 0_u16)?;
    let mut numbers = BTreeMap::from([(vec![0; maps.len()], 0_u16)]);
    let mut said: Vec<Said> = maps.iter().map(|_| Said::default()).collect();
    let mut claim = vec![0; maps.len()];
    let (mut before, mut number) = (claim.clone(), 0);
    let reading = Stage::new(progress, 0.4, 1.0);
    let done = Steps::new(&reading, height);
    for (band, output) in cells.cells_mut().chunks_mut(BAND * width).enumerate() {
        let first = band * BAND;
        let rows = first..first + output.len() / width;
        for (reach, said) in reaches.iter().zip(&mut said) {
            reach.read(&rows, said);
        }
        for (row, output) in rows.zip(output.chunks_exact_mut(width)) {
            done.step()?;
            for (column, cell) in output.iter_mut().enumerate() {
                for (class, said) in claim.iter_mut().zip(&said) {
                    *class = tables.class(said.at(row, column));
                }
                if claim != before {
                    number = match numbers.get(&claim) {
                        Some(&number) => number,
                        None => {
                            let next = u16::try_from(numbers.len()).ok();
                            let next = next.ok_or(FusionError::TooManyClaims)?;
                            numbers.insert(claim.clone(), next);
                            next
                        }
                    };
                    before.clone_from(&claim);
                }
                *cell = number;
            }
        }
    }
    let mut claims = vec![Claim::default(); numbers.len()];
    for (classes, number) in numbers {
        let saying = |class| {
            let maps = classes.iter().enumerate().filter(|&(_, &said)| said == class);
            maps.map(|(map, _)| map).collect()
        };
        claims[usize::from(number)] =
            Claim { occupied: saying(SAID_OCCUPIED), free: saying(SAID_FREE) };
    }
    Ok(Provenance { frame: bounds.frame(&lattice), cells, claims })
}
