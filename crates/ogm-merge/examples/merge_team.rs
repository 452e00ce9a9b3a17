//! Two robots explore one building; their maps are merged by method #3.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use ogm_core::Outcome;
use ogm_merge::{MergeParams, Method, RobotMap, merge};
use ogm_sim::{FloorPlan, PairParams, simulate_pair};
use rfid_loc::{FilterParams, localise};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pair = simulate_pair(&FloorPlan::plan_a(), &PairParams::default())?;
    let target_tags = localise(&pair.target.readings, &FilterParams::default(), &())?;
    let source_tags = localise(&pair.source.readings, &FilterParams::default(), &())?;
    let target = RobotMap { map: &pair.target.map, tags: &target_tags };
    let source = RobotMap { map: &pair.source.map, tags: &source_tags };

    let (report, merged) = merge(Method::Rfid3, &target, &source, &MergeParams::default())?;
    println!("{} tags in both maps", report.evidence.common_tags.len());
    match report.outcome {
        Outcome::Refused(reason) => println!("refused: {reason}"),
        Outcome::Found(target_from_source) => {
            let error = target_from_source.between(&pair.target_from_source);
            println!(
                "target_from_source: {:.3} m, {:.3} m, {:.2}°",
                target_from_source.x(),
                target_from_source.y(),
                target_from_source.theta().to_degrees()
            );
            println!(
                "off by {:.4} m and {:.4}°",
                error.translation().norm(),
                error.theta().to_degrees()
            );
        }
    }
    if let Some(merged) = merged {
        println!("{} of {} common cells disagree", merged.conflict_count, merged.compared);
    }
    Ok(())
}
