//! Real map pairs with their truth, and the tags that they are given.

use std::path::{Path, PathBuf};

use anyhow::Context;
use nalgebra::Point2;
use ogm_core::{ClassThresholds, NearestCells, OccupancyGrid, Se2};
use serde::Deserialize;

/// Two maps and the truth about them.
#[derive(Debug)]
pub(crate) struct MapPair {
    pub(crate) name: String,
    pub(crate) target: OccupancyGrid,
    pub(crate) source: OccupancyGrid,
    pub(crate) truth: Option<Truth>,
}

/// The true transform and how exactly it is known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Truth {
    pub(crate) target_from_source: Se2,
    /// Displacement below which an answer is right, metres.
    pub(crate) tolerance_m: f64,
    /// Rotation error below which an answer is right, radians.
    pub(crate) tolerance: f64,
    /// Whether both maps share one corrected trajectory, so that the truth is exact.
    pub(crate) exact: bool,
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

/// All pairs below `folder`, by name: subfolders with `a.yaml`, `b.yaml` and `truth.json`.
pub(crate) fn read_pairs(folder: &Path) -> anyhow::Result<Vec<MapPair>> {
    let entries = std::fs::read_dir(folder)
        .with_context(|| format!("cannot list the map pairs in {}", folder.display()))?;
    let mut folders: Vec<PathBuf> =
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    folders.retain(|path| path.join("truth.json").is_file());
    folders.sort();
    anyhow::ensure!(
        !folders.is_empty(),
        "{} holds no map pair: expected folders with a.yaml, b.yaml and truth.json",
        folder.display()
    );
    folders.iter().map(|path| read_pair(path)).collect()
}

fn read_pair(folder: &Path) -> anyhow::Result<MapPair> {
    let read = |name: &str| -> anyhow::Result<OccupancyGrid> {
        Ok(ogm_io::read_map(&folder.join(name))?.map)
    };
    let path = folder.join("truth.json");
    let text = std::fs::read_to_string(&path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let file: TruthFile =
        serde_json::from_str(&text).with_context(|| format!("in {}", path.display()))?;
    let name = folder.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    Ok(MapPair { name, target: read("a.yaml")?, source: read("b.yaml")?, truth: file.truth() })
}

impl TruthFile {
    fn truth(&self) -> Option<Truth> {
        let target_from_source = Se2::new(self.dx?, self.dy?, self.theta_deg?.to_radians());
        self.r#match.then(|| Truth {
            target_from_source,
            tolerance_m: self.tolerance_hint_m.unwrap_or(0.0).max(0.25),
            tolerance: self.tolerance_hint_deg.unwrap_or(0.0).max(1.0).to_radians(),
            exact: self.kind.as_deref() == Some("log-segments"),
        })
    }
}

impl MapPair {
    /// The centroid of the source's known cells: where errors of the transform are taken.
    pub(crate) fn source_centroid(&self) -> Point2<f64> {
        let (mut sum, mut count) = (Point2::origin(), 0_usize);
        for (index, cell) in self.source.cells().indexed() {
            if cell.is_known() {
                sum += self.source.frame().cell_centre(index).coords;
                count += 1;
            }
        }
        sum / count.max(1) as f64
    }

    /// Source walls, in the source frame, that lie within 1.5 cells of a target wall under the
    /// truth: where both robots would have seen a tag.
    pub(crate) fn walls_in_both(&self, truth: &Truth) -> Vec<Point2<f64>> {
        let thresholds = ClassThresholds::default();
        let Some(nearest) = NearestCells::new(&self.target.occupied_mask(&thresholds)) else {
            return Vec::new();
        };
        let frame = self.target.frame();
        let reach = 1.5 * frame.resolution().max(self.source.frame().resolution());
        let mut walls = self.source.occupied_points(&thresholds);
        walls.retain(|&wall| {
            let image = truth.target_from_source * wall;
            let near = self.target.cell_at(image).and_then(|index| nearest.nearest(index));
            near.is_some_and(|near| (frame.cell_centre(near) - image).norm() <= reach)
        });
        walls
    }
}
