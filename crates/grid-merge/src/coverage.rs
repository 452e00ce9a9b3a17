//! Coverage fields: where each robot's sensor has been, made one.

use std::borrow::Cow;

use ogm_core::{Grid, GridFrame, OccupancyGrid, Se2};

use crate::gaps::blur_coverage;
use crate::lattice::Footprint;
use crate::mapping::{Layer, Source, Vacant};
use crate::pose::{check_pose, check_scatter};
use crate::{FusionError, FusionParams, GapTreatment, Mapping};

/// A coverage field and where it lies.
#[derive(Debug, Clone, Copy)]
pub struct PlacedCoverage<'a> {
    /// Which cells were covered.
    pub covered: &'a Grid<bool>,
    /// Where the cells lie; in most cases the frame of the robot's map.
    pub frame: &'a GridFrame,
    /// The pose of the robot's map in the frame of the output.
    pub reference_from_map: Se2,
}

/// The union of coverage `fields` on the cells of `onto`, a merged map, by the mapping and gap
/// treatment that merged it; what lies outside `onto` is cut off.
///
/// Interpolation is nearest cell, a hole with five covered neighbours is covered, and a blurred
/// cell (Tsardoulias et al., Eq. 16) is covered where half of its neighbourhood is. The printed
/// condition is about explored free cells and leaves a coverage field alone.
///
/// # Errors
/// A pose that is not finite or too far away, and forward mapping of a field that is coarser than
/// `onto`.
pub fn merge_coverage(
    fields: &[PlacedCoverage<'_>],
    onto: &OccupancyGrid,
    params: &FusionParams,
) -> Result<Grid<bool>, FusionError> {
    let lattice = onto.frame();
    let output = Footprint::of_grid((onto.width(), onto.height()));
    let mut union = onto.cells().map(|_| false);
    for (index, field) in fields.iter().enumerate() {
        check_pose(index, &field.reference_from_map)?;
        check_scatter(index, field.frame, lattice, &params.mapping)?;
        let source = Source {
            cells: Cow::Borrowed(field.covered),
            frame: *field.frame,
            reference_from_map: field.reference_from_map,
        };
        let reach = source.footprint(lattice, &params.mapping)?;
        let Some(footprint) = reach.clipped(&output) else {
            continue;
        };
        let vacant = Vacant { value: false, fill: |_: &[bool]| true };
        let (column, row) = footprint.offset_in(&output);
        let cells = source.onto(lattice, &footprint, &params.mapping, vacant, &())?;
        add(&mut union, &Layer { column, row, cells });
    }
    Ok(match params.mapping {
        Mapping::Forward { gaps: GapTreatment::BlurEverywhere, .. } => blur_coverage(&union),
        _ => union,
    })
}

fn add(union: &mut Grid<bool>, layer: &Layer<'_, bool>) {
    let width = union.width();
    for (row, output) in union.cells_mut().chunks_exact_mut(width).enumerate() {
        if let Some(covered) = layer.output_row(row) {
            for (cell, &covered) in output[layer.column..].iter_mut().zip(covered) {
                *cell |= covered;
            }
        }
    }
}
