//! Poses and mappings that cannot be meant.

use ogm_core::{GridFrame, Se2};

use crate::error::FusionError;
use crate::params::Mapping;

pub(crate) fn check_pose(map: usize, reference_from_map: &Se2) -> Result<(), FusionError> {
    reference_from_map.check_finite().map_err(|cause| FusionError::NonFinitePose { map, cause })
}

/// Forward mapping onto a finer lattice would leave more gaps than cells.
pub(crate) fn check_scatter(
    map: usize,
    frame: &GridFrame,
    lattice: &GridFrame,
    mapping: &Mapping,
) -> Result<(), FusionError> {
    let (have, output) = (frame.resolution(), lattice.resolution());
    let scatters = matches!(mapping, Mapping::Forward { .. });
    if scatters && have > output && !frame.same_resolution(lattice) {
        return Err(FusionError::TooCoarseToScatter { map, have, output });
    }
    Ok(())
}
