//! Map pairs on disk, and the truth about them.

use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use nalgebra::Point2;
use ogm_core::{OccupancyGrid, Se2};
use serde::Deserialize;

use super::contestant::Files;

/// Two maps as files, and what an answer about them is measured by.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) name: String,
    pub(super) files: Files,
    /// Cells of each map.
    pub(super) cells: [usize; 2],
    /// `None` for a pair that must be refused.
    pub(super) truth: Option<Truth>,
}

/// The true transform and how near to it an answer is right.
#[derive(Debug, Clone, Copy)]
pub(super) struct Truth {
    pub(super) target_from_source: Se2,
    /// Centroid of the source's known cells, where errors are taken.
    pub(super) source_centroid: Point2<f64>,
    /// Metres a cell of the target.
    pub(super) target_resolution: f64,
    /// Displacement below which an answer is right, metres.
    pub(super) tolerance_m: f64,
    /// Rotation error below which an answer is right, radians.
    pub(super) tolerance: f64,
}

#[derive(Debug, Deserialize)]
struct TruthFile {
    r#match: bool,
    dx: Option<f64>,
    dy: Option<f64>,
    theta_deg: Option<f64>,
    tolerance_hint_m: Option<f64>,
    tolerance_hint_deg: Option<f64>,
}

/// The folders below `folder` that hold a `truth.json`, by name.
pub(super) fn folders_of_pairs(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)
        .with_context(|| format!("cannot list the map pairs in {}", folder.display()))?;
    let mut folders: Vec<PathBuf> =
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    folders.retain(|path| path.join("truth.json").is_file());
    ensure!(!folders.is_empty(), "{} holds no pair with a truth.json", folder.display());
    folders.sort();
    Ok(folders)
}

/// The pair in each folder (`a.yaml`, `b.yaml` and `truth.json`), the smallest maps first.
pub(super) fn read_pairs(folders: &[PathBuf]) -> anyhow::Result<Vec<Pair>> {
    let mut pairs: Vec<Pair> =
        folders.iter().map(|path| read_pair(path)).collect::<Result<_, _>>()?;
    pairs.sort_by_key(|pair| pair.cells.iter().sum::<usize>());
    Ok(pairs)
}

fn read_pair(folder: &Path) -> anyhow::Result<Pair> {
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
    Ok(Pair {
        name: folder.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
        cells: [&target.map, &source.map].map(|map| map.width() * map.height()),
        files: Files { a, b, a_image: target.image, b_image: source.image },
        truth,
    })
}

impl TruthFile {
    fn truth(&self, target: &OccupancyGrid, source: &OccupancyGrid) -> Option<Truth> {
        Some(Truth {
            target_from_source: Se2::new(self.dx?, self.dy?, self.theta_deg?.to_radians()),
            source_centroid: centroid(source),
            target_resolution: target.frame().resolution(),
            tolerance_m: self.tolerance_hint_m.unwrap_or(0.0).max(0.25),
            tolerance: self.tolerance_hint_deg.unwrap_or(0.0).max(1.0).to_radians(),
        })
    }
}

/// Of the known cells.
fn centroid(map: &OccupancyGrid) -> Point2<f64> {
    let (mut sum, mut count) = (Point2::origin(), 0_usize);
    for (index, cell) in map.cells().indexed() {
        if cell.is_known() {
            sum += map.frame().cell_centre(index).coords;
            count += 1;
        }
    }
    sum / count.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::{Pair, folders_of_pairs, read_pairs};
    use nalgebra::Point2;
    use ogm_core::{GridFrame, OccupancyGrid, Se2};
    use std::path::Path;

    fn write(folder: &Path, name: &str, picture: &str, truth: &str) {
        let folder = folder.join(name);
        std::fs::create_dir_all(&folder).unwrap();
        let frame = GridFrame::new(0.5, Se2::new(10.0, -4.0, 0.0)).unwrap();
        let map = OccupancyGrid::from_ascii(frame, picture).unwrap();
        for file in ["a.yaml", "b.yaml"] {
            ogm_io::write_map(&folder.join(file), &map, &ogm_io::WriteOptions::default()).unwrap();
        }
        std::fs::write(folder.join("truth.json"), truth).unwrap();
    }

    #[test]
    fn small_pairs_come_first_and_the_truth_is_in_metres_and_radians() {
        let folder = tempfile::tempdir().unwrap();
        let truth = r#"{"match": true, "dx": 1.5, "dy": 2.0, "theta_deg": 90.0,
                        "tolerance_hint_m": 0.3, "tolerance_hint_deg": 0.2}"#;
        write(folder.path(), "large", "#..?\n#..?\n####", r#"{"match": false, "dx": null}"#);
        write(folder.path(), "small", "#.??\n....", truth);
        std::fs::create_dir(folder.path().join("no pair")).unwrap();
        let pairs = read_pairs(&folders_of_pairs(folder.path()).unwrap()).unwrap();
        let names: Vec<&str> = pairs.iter().map(|pair| pair.name.as_str()).collect();
        assert_eq!(names, ["small", "large"]);
        let [Pair { truth: Some(truth), cells, .. }, Pair { truth: None, .. }] = &pairs[..] else {
            panic!("{pairs:?}");
        };
        assert_eq!(*cells, [8, 8]);
        assert_eq!((truth.tolerance_m, truth.target_resolution), (0.3, 0.5));
        assert!((truth.tolerance - 1.0_f64.to_radians()).abs() < 1e-12, "at least a degree");
        // Six known cells, four of them in the lower row, half a metre each.
        let centroid = Point2::new(10.0 + (1.0 + 2.0 * 2.0) / 6.0, -4.0 + (4.0 * 0.25 + 1.5) / 6.0);
        assert!((truth.source_centroid - centroid).norm() < 1e-12, "{truth:?}");
    }

    #[test]
    fn a_pair_that_matches_nowhere_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(folders_of_pairs(folder.path()).is_err(), "no pairs");
        write(folder.path(), "pair", "#.", r#"{"match": true, "dx": 1.0}"#);
        let error = read_pairs(&[folder.path().join("pair")]).unwrap_err();
        assert!(error.to_string().contains("says no transform"), "{error}");
    }
}
