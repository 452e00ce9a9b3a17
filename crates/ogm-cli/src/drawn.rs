//! The pictures of a merge.

use std::path::Path;

use anyhow::Context;
use ogm_core::{OccupancyGrid, Se2};
use ogm_merge::{BentComponent, Component, FusionParams, Merged, PairReport, placed};
use ogm_view::{Claimed, Named, ViewError};

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
    sheet(path, &[(target, Se2::identity()), (source, target_from_source)]).map(Some)
}

/// All maps of a component on each other.
pub(crate) fn team(
    path: &Path,
    inputs: &[Input],
    component: &Component,
) -> anyhow::Result<Vec<u8>> {
    let reference = component.members.first().map(|first| first.reference_from_map);
    let first_from_reference = reference.unwrap_or_else(Se2::identity).inverse();
    let placed = component.members.iter();
    let placed: Vec<_> = placed
        .map(|member| (&inputs[member.map], first_from_reference * member.reference_from_map))
        .collect();
    sheet(path, &placed)
}

/// Maps in their poses in the frame of the first.
pub(crate) fn sheet(path: &Path, placed: &[(&Input, Se2)]) -> anyhow::Result<Vec<u8>> {
    let names: Vec<String> = placed.iter().map(|(input, _)| input.name()).collect();
    let named: Vec<Named<'_>> = placed
        .iter()
        .zip(&names)
        .map(|(&(input, first_from_map), name)| Named { map: input.map(), first_from_map, name })
        .collect();
    ogm_view::overlay_sheet(&named)
        .and_then(|picture| ogm_view::png(&picture))
        .with_context(|| format!("cannot draw {}", path.display()))
}

/// Metres between the places whose motions are drawn.
const MOTION_EVERY_M: f64 = 1.0;

/// The straightened maps of a component on each other, and how far each place of them was moved.
pub(crate) fn bend(path: &Path, inputs: &[Input], bent: &BentComponent) -> anyhow::Result<Vec<u8>> {
    let maps: Vec<_> = inputs.iter().map(Input::map).collect();
    let straight = bent.straight(&maps);
    let names: Vec<String> = inputs.iter().map(Input::name).collect();
    let members = bent.component.members.iter();
    let first_from_reference = bent.component.members[0].reference_from_map.inverse();
    let named = members.map(|member| Named {
        map: straight[member.map],
        first_from_map: first_from_reference * member.reference_from_map,
        name: &names[member.map],
    });
    let named: Vec<Named<'_>> = named.collect();
    let mut motions = Vec::new();
    for bent in bent.maps.iter().filter(|bent| bent.straight.is_some()) {
        let Some(pose) = named.iter().find(|named| std::ptr::eq(named.map, straight[bent.map]))
        else {
            continue;
        };
        let of_map = bent.report.motions(maps[bent.map], MOTION_EVERY_M);
        let pose = pose.first_from_map;
        motions.extend(of_map.into_iter().map(|(place, motion)| (pose * place, pose * motion)));
    }
    ogm_view::motion_sheet(&named, &motions)
        .and_then(|picture| ogm_view::png(&picture))
        .with_context(|| format!("cannot draw {}", path.display()))
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
