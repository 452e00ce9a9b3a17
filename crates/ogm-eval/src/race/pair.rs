//! What the race needs of a pair of maps.

use std::path::PathBuf;

use nalgebra::Point2;
use ogm_core::Se2;

use crate::map_pair::{Files, MapPair, read_pair};

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

/// The pair in each folder, the smallest maps first.
pub(super) fn read_pairs(folders: &[PathBuf]) -> anyhow::Result<Vec<Pair>> {
    let mut pairs: Vec<Pair> =
        folders.iter().map(|path| Ok(Pair::of(read_pair(path)?))).collect::<anyhow::Result<_>>()?;
    pairs.sort_by_key(|pair| pair.cells.iter().sum::<usize>());
    Ok(pairs)
}

impl Pair {
    fn of(maps: MapPair) -> Self {
        let truth = maps.truth.map(|truth| Truth {
            target_from_source: truth.target_from_source,
            source_centroid: maps.source_centroid(),
            target_resolution: maps.target.frame().resolution(),
            tolerance_m: truth.tolerance_m,
            tolerance: truth.tolerance,
        });
        let cells = [&maps.target, &maps.source].map(|map| map.width() * map.height());
        Self { name: maps.name, files: maps.files, cells, truth }
    }
}

#[cfg(test)]
mod tests {
    use super::{Pair, read_pairs};
    use crate::map_pair::folders_of_pairs;
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
