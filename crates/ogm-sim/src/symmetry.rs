//! Plans that look the same after a turn.

use ogm_core::{Grid, l1_distance};

use crate::{FloorPlan, SimError};

/// Cell side of the comparison, metres; below half a wall, above rounding.
const RESOLUTION: f64 = 0.05;

/// An error if at least `share` of the solid cells land within a cell of solid cells when the
/// plan's bounding box is turned by 180 degrees, or by 90 if it is square.
pub(crate) fn refuse_symmetric(plan: &FloorPlan, share: f64) -> Result<(), SimError> {
    let (_, mask) = plan.raster(RESOLUTION)?;
    let Some((near, cells)) = l1_distance(&mask).zip(bounding_box(&mask)) else {
        return Ok(());
    };
    for degrees in [90, 180] {
        if matching_share(&mask, &near, cells, degrees).is_some_and(|found| found >= share) {
            return Err(SimError::SymmetricPlan { degrees });
        }
    }
    Ok(())
}

/// Share of solid cells that stay within a cell of solid ones; `None` if the box does not fit.
fn matching_share(
    mask: &Grid<bool>,
    near: &Grid<u32>,
    [[left, right], [low, high]]: [[usize; 2]; 2],
    degrees: u32,
) -> Option<f64> {
    if degrees == 90 && (right - left).abs_diff(high - low) > 1 {
        return None;
    }
    let (mut solid, mut matching) = (0_u32, 0_u32);
    for (mut index, _) in mask.indexed().filter(|(_, solid)| **solid) {
        let (column, row) = (index.column, index.row);
        (index.column, index.row) = match degrees {
            90 => (left + (high - row), low + (column - left)),
            _ => (right - (column - left), high - (row - low)),
        };
        solid += 1;
        matching += u32::from(near.get(index).is_some_and(|&distance| distance <= 1));
    }
    Some(f64::from(matching) / f64::from(solid))
}

/// First and last column, first and last row with a set cell.
fn bounding_box(mask: &Grid<bool>) -> Option<[[usize; 2]; 2]> {
    mask.indexed()
        .filter(|(_, set)| **set)
        .map(|(cell, _)| [[cell.column; 2], [cell.row; 2]])
        .reduce(|[a, b], [c, d]| {
            [[a[0].min(c[0]), a[1].max(c[1])], [b[0].min(d[0]), b[1].max(d[1])]]
        })
}

#[cfg(test)]
mod tests {
    use crate::{FloorPlan, SimError};

    fn plan(solids: &str) -> Result<FloorPlan, SimError> {
        FloorPlan::parse(&format!("size 6 6\nroute target 1 1 2 2\nroute source 2 2 1 1\n{solids}"))
    }

    #[test]
    fn plans_that_turn_into_themselves_are_refused() {
        let square = "box 3 1 4 0.1 0\nbox 3 5 4 0.1 0\nbox 1 3 0.1 4 0\nbox 5 3 0.1 4 0\n";
        assert_eq!(plan(square), Err(SimError::SymmetricPlan { degrees: 90 }));
        let half_turn = format!("{square}box 2 2 0.5 0.3 0\nbox 4 4 0.5 0.3 0");
        assert_eq!(plan(&half_turn), Err(SimError::SymmetricPlan { degrees: 180 }));
        assert!(plan(&format!("{square}box 2 2 0.5 0.3 0")).is_ok());
    }
}
