//! What was found and done by a merge, as its JSON says it.

use std::path::Path;

use ogm_merge::{Component, ConflictRegion, Merged, PoseDegrees};
use serde::Serialize;

use crate::answer::PairAnswer;
use crate::bent::BendAnswer;
use crate::input::MapFile;
use crate::team_answer::TeamAnswer;

/// The most places of conflict that a report lists; the largest.
const LISTED: usize = 100;

/// What was found and done.
#[derive(Debug, Serialize)]
pub(crate) struct MergeAnswer {
    pub(crate) schema: u32,
    pub(crate) maps: Vec<MapFile>,
    pub(crate) pairs: Vec<PairAnswer>,
    pub(crate) components: Vec<Component>,
    pub(crate) output: Option<MergedMap>,
    /// Where more than two maps were searched.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) team: Option<TeamAnswer>,
    /// How far maps are bent, where that was looked at.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) bend: Vec<BendAnswer>,
}

/// The map that was written.
#[derive(Debug, Serialize)]
pub(crate) struct MergedMap {
    file: String,
    width: usize,
    height: usize,
    resolution_m: f64,
    origin: PoseDegrees,
    fusion: String,
    /// Maps that are in it.
    maps: Vec<usize>,
    compared_cells: usize,
    conflict_cells: usize,
    /// How many places they form.
    pub(crate) conflict_places: usize,
    /// The largest of them.
    pub(crate) conflicts: Vec<Conflict>,
}

/// A place where maps contradict each other.
#[derive(Debug, Serialize)]
pub(crate) struct Conflict {
    pub(crate) x_m: f64,
    pub(crate) y_m: f64,
    /// Extent along x and y.
    pub(crate) size_m: [f64; 2],
    cells: usize,
    /// The maps that say occupied, from 0.
    pub(crate) occupied: Vec<usize>,
    pub(crate) free: Vec<usize>,
}

impl MergedMap {
    /// What it is, in a line.
    pub(crate) fn summary(&self) -> String {
        format!(
            "{}: {} x {} cells of {} m, fused by {}; {} of {} cells that several maps know are in \
             conflict, in {} places",
            self.file,
            self.width,
            self.height,
            self.resolution_m,
            self.fusion,
            self.conflict_cells,
            self.compared_cells,
            self.conflict_places,
        )
    }

    pub(crate) fn new(yaml: &Path, component: &Component, merged: &Merged, fusion: String) -> Self {
        let map = &merged.map;
        let members: Vec<usize> = component.members.iter().map(|member| member.map).collect();
        let conflict = |region: &ConflictRegion| {
            let maps = |places: &[usize]| places.iter().map(|&place| members[place]).collect();
            Conflict {
                x_m: region.centre.x,
                y_m: region.centre.y,
                size_m: [region.size.x, region.size.y],
                cells: region.cells,
                occupied: maps(&region.occupied),
                free: maps(&region.free),
            }
        };
        Self {
            file: yaml.display().to_string(),
            width: map.width(),
            height: map.height(),
            resolution_m: map.frame().resolution(),
            origin: map.frame().map_from_grid().into(),
            fusion,
            compared_cells: merged.compared,
            conflict_cells: merged.conflict_count,
            conflict_places: merged.region_count,
            conflicts: merged.regions.iter().take(LISTED).map(conflict).collect(),
            maps: members,
        }
    }
}
