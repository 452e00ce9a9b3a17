//! The example maps: two robots in plan A, as files that a robot would have saved.

use std::path::Path;

use anyhow::Context;
use ogm_io::WriteOptions;
use ogm_sim::{FloorPlan, MappingParams, PairParams, SimulatedPair, simulate_pair};
use serde_json::json;

/// Metres a cell: coarse enough that the files stay small.
const RESOLUTION: f64 = 0.05;

/// Writes both maps, both tag logs and the truth into `folder`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(folder: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot create {}", folder.display()))?;
    let pair = simulated()?;
    let options = WriteOptions { overwrite: true, ..WriteOptions::default() };
    for (name, run) in [("target", &pair.target), ("source", &pair.source)] {
        ogm_io::write_map(&folder.join(format!("{name}.yaml")), &run.map, &options)?;
        ogm_io::write_tags(&folder.join(format!("{name}.tags.csv")), &run.readings)?;
    }
    crate::report::write_file(&folder.join("truth.json"), truth(&pair).as_bytes())
}

fn simulated() -> anyhow::Result<SimulatedPair> {
    let params = PairParams {
        seed: 1,
        mapping: MappingParams { resolution: RESOLUTION, ..MappingParams::default() },
        ..PairParams::default()
    };
    Ok(simulate_pair(&FloorPlan::plan_a(), &params)?)
}

/// The true transform, rounded to a micrometre so that the file is the same on every machine.
fn truth(pair: &SimulatedPair) -> String {
    let rounded = |value: f64| (value * 1e6).round() / 1e6;
    let target_from_source = pair.target_from_source;
    let truth = json!({
        "target": "target.yaml",
        "source": "source.yaml",
        "target_from_source": {
            "x_m": rounded(target_from_source.x()),
            "y_m": rounded(target_from_source.y()),
            "theta_deg": rounded(target_from_source.theta().to_degrees()),
        },
    });
    format!("{truth:#}\n")
}

#[cfg(test)]
mod tests {
    use super::write;
    use ogm_core::{Outcome, Se2};
    use ogm_merge::{RfidParams, RobotMap, TagMethod, align_by_tags};
    use rfid_loc::{FilterParams, localise};
    use std::path::Path;

    /// Not byte for byte: sines differ in the last bit between processors.
    #[test]
    fn the_committed_maps_are_what_this_writes() {
        let fresh = tempfile::tempdir().unwrap();
        write(fresh.path()).unwrap();
        let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/plan-a");
        for name in ["target", "source"] {
            let read = |folder: &Path| {
                let map = ogm_io::read_map(&folder.join(format!("{name}.yaml"))).unwrap().map;
                let tags = ogm_io::read_tags(&folder.join(format!("{name}.tags.csv"))).unwrap();
                (map, tags.len())
            };
            let ((new, new_tags), (old, old_tags)) = (read(fresh.path()), read(&committed));
            let stale = format!("{name} is stale; run `cargo xtask fixtures`");
            assert_eq!(
                (new.width(), new.height(), new_tags),
                (old.width(), old.height(), old_tags),
                "{stale}"
            );
            let cells = new.cells().cells().iter().zip(old.cells().cells());
            let differing = cells.filter(|(a, b)| a != b).count();
            assert!(differing <= 10, "{stale}: {differing} cells differ");
            let origin_new_from_old =
                new.frame().map_from_grid().between(&old.frame().map_from_grid());
            assert!(origin_new_from_old.translation().norm() < 1e-9, "{stale}");
        }
    }

    #[test]
    fn the_files_merge_at_the_stated_truth() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/plan-a");
        let read = |name: &str| {
            let map = ogm_io::read_map(&folder.join(format!("{name}.yaml"))).unwrap().map;
            let readings = ogm_io::read_tags(&folder.join(format!("{name}.tags.csv"))).unwrap();
            (map, localise(&readings, &FilterParams::default(), &()).unwrap())
        };
        let (target, target_tags) = read("target");
        let (source, source_tags) = read("source");
        let report = align_by_tags(
            TagMethod::Rfid3,
            &RobotMap { map: &target, tags: &target_tags },
            &RobotMap { map: &source, tags: &source_tags },
            &RfidParams::default(),
            &(),
        );
        let Outcome::Found(target_from_source) = report.unwrap().outcome else {
            panic!("the example maps were refused");
        };
        let truth = std::fs::read_to_string(folder.join("truth.json")).unwrap();
        let truth: serde_json::Value = serde_json::from_str(&truth).unwrap();
        let value = |key: &str| truth["target_from_source"][key].as_f64().unwrap();
        let true_target_from_source =
            Se2::new(value("x_m"), value("y_m"), value("theta_deg").to_radians());
        let error_source_from_source = true_target_from_source.between(&target_from_source);
        assert!(error_source_from_source.translation().norm() < 0.2 * super::RESOLUTION);
        assert!(error_source_from_source.theta().abs() < 2e-3);
    }
}
