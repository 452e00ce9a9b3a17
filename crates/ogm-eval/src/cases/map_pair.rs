//! Pairs of map files with the truth about them.

use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use nalgebra::Point2;
use ogm_core::{ClassThresholds, Length, NearestWall, OccupancyGrid, Se2};
use serde::Deserialize;

use crate::judge::{HALF_A_DOOR, Tolerance, Truth};

/// Two maps and the truth about them.
#[derive(Debug)]
pub(crate) struct MapPair {
    pub(crate) name: String,
    pub(crate) files: Files,
    pub(crate) target: OccupancyGrid,
    pub(crate) source: OccupancyGrid,
    /// `None` for a pair that must be refused. Errors are taken at the centroid of the source's
    /// known cells.
    pub(crate) truth: Option<Truth>,
}

/// The files of a pair.
#[derive(Debug, Clone)]
pub(crate) struct Files {
    pub(crate) a: PathBuf,
    pub(crate) b: PathBuf,
    pub(crate) a_image: PathBuf,
    pub(crate) b_image: PathBuf,
}

#[derive(Debug, Deserialize)]
struct TruthFile {
    r#match: bool,
    dx: Option<f64>,
    dy: Option<f64>,
    theta_deg: Option<f64>,
    tolerance_hint_m: Option<f64>,
    tolerance_hint_deg: Option<f64>,
    kind: Option<String>,
}

/// All pairs below `folder`, by name.
pub(crate) fn read_pairs(folder: &Path) -> anyhow::Result<Vec<MapPair>> {
    folders_of_pairs(folder)?.iter().map(|path| read_pair(path)).collect()
}

/// The folders below `folder` that hold a `truth.json`, by name.
pub(crate) fn folders_of_pairs(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)
        .with_context(|| format!("cannot list the map pairs in {}", folder.display()))?;
    let mut folders: Vec<PathBuf> =
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    folders.retain(|path| path.join("truth.json").is_file());
    folders.sort();
    ensure!(
        !folders.is_empty(),
        "{} holds no map pair: expected folders with a.yaml, b.yaml and truth.json",
        folder.display()
    );
    Ok(folders)
}

/// The pair in a folder: `a.yaml`, `b.yaml` and `truth.json`.
pub(crate) fn read_pair(folder: &Path) -> anyhow::Result<MapPair> {
    let path = folder.join("truth.json");
    let text = std::fs::read_to_string(&path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let file: TruthFile =
        serde_json::from_str(&text).with_context(|| format!("in {}", path.display()))?;
    let [a, b] = ["a.yaml", "b.yaml"].map(|name| folder.join(name));
    let (target, source) = (ogm_io::read_map(&a)?, ogm_io::read_map(&b)?);
    let truth = if file.r#match {
        let truth = file.truth(&target.map, &source.map);
        Some(truth.with_context(|| format!("{} says no transform", path.display()))?)
    } else {
        None
    };
    Ok(MapPair {
        name: folder.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
        files: Files { a, b, a_image: target.image, b_image: source.image },
        target: target.map,
        source: source.map,
        truth,
    })
}

impl TruthFile {
    fn truth(&self, target: &OccupancyGrid, source: &OccupancyGrid) -> Option<Truth> {
        let stated = Length::metres(self.tolerance_hint_m.unwrap_or(0.0));
        let stated = Tolerance::of_pose(stated, self.tolerance_hint_deg.unwrap_or(0.0));
        Some(Truth {
            target_from_source: Se2::new(self.dx?, self.dy?, self.theta_deg?.to_radians()),
            centre: known_centroid(source),
            radius: 0.0,
            cell: target.frame().resolution(),
            tolerance: HALF_A_DOOR.or(stated),
            exact: self.kind.as_deref() == Some("log-segments"),
        })
    }
}

/// The centroid of the cells that a map knows.
fn known_centroid(map: &OccupancyGrid) -> Point2<f64> {
    let (mut sum, mut count) = (Point2::origin(), 0_usize);
    for (index, cell) in map.cells().indexed() {
        if cell.is_known() {
            sum += map.frame().cell_centre(index).coords;
            count += 1;
        }
    }
    sum / count.max(1) as f64
}

impl MapPair {
    /// Source walls, in the source frame, that lie within 1.5 cells of a target wall under the
    /// truth: where both robots would have seen a tag.
    pub(crate) fn walls_in_both(&self, truth: &Truth) -> Vec<Point2<f64>> {
        let thresholds = ClassThresholds::default();
        let Some(nearest) = NearestWall::new(&self.target, &thresholds) else {
            return Vec::new();
        };
        let frame = self.target.frame();
        let reach = 1.5 * frame.resolution().max(self.source.frame().resolution());
        let mut walls = self.source.occupied_points(&thresholds);
        walls.retain(|&wall| {
            let image = truth.target_from_source * wall;
            let is_inside = self.target.cell_at(image).is_some();
            is_inside && (nearest.nearest_to(image) - image).norm() <= reach
        });
        walls
    }
}
