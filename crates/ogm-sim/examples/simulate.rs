//! Two robots explore a building; what they bring home and how their maps truly fit.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use ogm_core::{CellClass, ClassThresholds};
use ogm_sim::{FloorPlan, PairParams, simulate_pair};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pair = simulate_pair(&FloorPlan::plan_a(), &PairParams::default())?;
    let thresholds = ClassThresholds::default();
    for (name, run) in [("target", &pair.target), ("source", &pair.source)] {
        let count = |class| {
            let cells = run.map.cells().cells().iter();
            cells.filter(|&&cell| thresholds.classify(cell) == class).count()
        };
        println!(
            "{name}: {} x {} cells, {} occupied, {} free, path of {:.1} m, {} tag readings",
            run.map.width(),
            run.map.height(),
            count(CellClass::Occupied),
            count(CellClass::Free),
            0.03 * run.path.len() as f64,
            run.readings.len(),
        );
    }
    let truth = pair.target_from_source;
    println!(
        "target_from_source: {:.3} m, {:.3} m, {:.2} degrees; overlap {:.2}",
        truth.x(),
        truth.y(),
        truth.theta().to_degrees(),
        pair.overlap()?,
    );
    Ok(())
}
