//! The pictures of a merge.

use std::path::Path;

use anyhow::Context;
use ogm_core::OccupancyGrid;
use ogm_merge::{Component, FusionParams, Merged, PairReport, placed};
use ogm_view::{Claimed, ViewError};

use crate::input::Input;

/// A pair of maps on each other under the best transform, accepted or not.
pub(crate) fn overlay(
    path: &Path,
    [target, source]: [&Input; 2],
    pair: &PairReport,
) -> anyhow::Result<Option<Vec<u8>>> {
    let Some(target_from_source) = pair.target_from_source else {
        return Ok(None);
    };
    let names = [target, source].map(Input::name);
    let names = names.each_ref().map(String::as_str);
    let png = ogm_view::overlay_sheet(target.map(), source.map(), target_from_source, names)
        .and_then(|picture| ogm_view::png(&picture));
    Ok(Some(png.with_context(|| format!("cannot draw {}", path.display()))?))
}

/// The merged map with its conflicts.
pub(crate) fn conflicts(path: &Path, merged: &Merged) -> anyhow::Result<Vec<u8>> {
    ogm_view::marked(&merged.map, merged.conflicts.iter())
        .map_err(ViewError::from)
        .and_then(|picture| ogm_view::png(&picture))
        .with_context(|| format!("cannot draw {}", path.display()))
}

/// Which map says what.
pub(crate) fn provenance(
    path: &Path,
    maps: &[&OccupancyGrid],
    component: &Component,
    params: &FusionParams,
) -> anyhow::Result<Vec<u8>> {
    let cannot_draw = || format!("cannot draw {}", path.display());
    let told =
        grid_merge::provenance(&placed(maps, component)?, params, &()).with_context(cannot_draw)?;
    let claims: Vec<_> = told
        .claims
        .iter()
        .map(|claim| Claimed { occupied: &claim.occupied, free: &claim.free })
        .collect();
    let picture = ogm_view::provenance(&told.cells, &claims);
    ogm_view::png(&picture).with_context(cannot_draw)
}
