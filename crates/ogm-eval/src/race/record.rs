//! What the race keeps: a pair without its maps, and what each command made of it.

use std::path::PathBuf;

use crate::cases::map_pair::{Files, MapPair, read_pair};
use crate::judge::{Truth, Verdict};

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

/// What each command made of one pair; `None` where it did not take part.
#[derive(Debug)]
pub(super) struct Raced {
    pub(super) pair: Pair,
    pub(super) outcomes: Vec<Option<Outcome>>,
}

/// What one command made of one pair.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outcome {
    pub(super) verdict: Verdict,
    /// Least CPU seconds of the process, start-up included.
    pub(super) cpu_s: f64,
    /// Least CPU seconds without start-up and reading, if the command counts them itself.
    pub(super) own_cpu_s: Option<f64>,
}

impl Outcome {
    /// Two runs as one: the shorter times and the first verdict, but a crash is a crash.
    pub(super) fn and(self, next: Self) -> Self {
        let crashed = next.verdict == Verdict::Crash;
        Self {
            verdict: if crashed { Verdict::Crash } else { self.verdict },
            cpu_s: self.cpu_s.min(next.cpu_s),
            own_cpu_s: self.own_cpu_s.zip(next.own_cpu_s).map(|(a, b)| a.min(b)),
        }
    }

    /// The time without what a start costs, if the command tells.
    pub(super) fn bare_s(self) -> f64 {
        self.own_cpu_s.unwrap_or(self.cpu_s)
    }
}

/// The pair in each folder, the smallest maps first.
pub(super) fn smallest_first(folders: &[PathBuf]) -> anyhow::Result<Vec<Pair>> {
    let mut pairs: Vec<Pair> =
        folders.iter().map(|path| Ok(Pair::of(read_pair(path)?))).collect::<anyhow::Result<_>>()?;
    pairs.sort_by_key(|pair| pair.cells.iter().sum::<usize>());
    Ok(pairs)
}

impl Pair {
    fn of(maps: MapPair) -> Self {
        let cells = [&maps.target, &maps.source].map(|map| map.width() * map.height());
        Self { name: maps.name, files: maps.files, cells, truth: maps.truth }
    }
}

#[cfg(test)]
mod tests {
    use super::{Pair, smallest_first};
    use crate::cases::map_pair::folders_of_pairs;
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
        let pairs = smallest_first(&folders_of_pairs(folder.path()).unwrap()).unwrap();
        let names: Vec<&str> = pairs.iter().map(|pair| pair.name.as_str()).collect();
        assert_eq!(names, ["small", "large"]);
        let [Pair { truth: Some(truth), cells, .. }, Pair { truth: None, .. }] = &pairs[..] else {
            panic!("{pairs:?}");
        };
        assert_eq!(*cells, [8, 8]);
        assert_eq!((truth.tolerance.displacement.resolve(0.5), truth.cell), (0.3, 0.5));
        assert!((truth.tolerance.turn - 1.0_f64.to_radians()).abs() < 1e-12, "at least a degree");
        // Six known cells, four of them in the lower row, half a metre each.
        let centroid = Point2::new(10.0 + (1.0 + 2.0 * 2.0) / 6.0, -4.0 + (4.0 * 0.25 + 1.5) / 6.0);
        assert!((truth.centre - centroid).norm() < 1e-12, "{truth:?}");
    }

    #[test]
    fn a_pair_that_matches_nowhere_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(folders_of_pairs(folder.path()).is_err(), "no pairs");
        write(folder.path(), "pair", "#.", r#"{"match": true, "dx": 1.0}"#);
        let error = smallest_first(&[folder.path().join("pair")]).unwrap_err();
        assert!(error.to_string().contains("says no transform"), "{error}");
    }
}
