//! Two robots explore a building; their maps become one.
#![expect(clippy::print_stdout, reason = "it talks to a person at a terminal")]

use ogm_merge::ogm_core::Outcome;
use ogm_merge::{
    AlignParams, FilterParams, FusionParams, Method, RobotMap, TagMethod, align_pair, fuse,
    localise,
};
use ogm_sim::{FloorPlan, PairParams, simulate_pair};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pair =
        simulate_pair(&FloorPlan::random(7)?, &PairParams { seed: 7, ..PairParams::default() })?;
    let filter = FilterParams::default();
    let target_tags = localise(&pair.target.readings, &filter, &())?;
    let source_tags = localise(&pair.source.readings, &filter, &())?;
    let target = RobotMap { map: &pair.target.map, tags: &target_tags };
    let source = RobotMap { map: &pair.source.map, tags: &source_tags };

    let params = AlignParams::default();
    println!("truth:  {}", pair.target_from_source);
    for method in [Method::Match, Method::Tags(TagMethod::Rfid3)] {
        let report = align_pair(method, &target, &source, &params, &())?;
        match &report.outcome {
            Outcome::Found(target_from_source) => {
                println!("{}: {target_from_source}", method.name())
            }
            Outcome::Refused(refusal) => println!("{}: {refusal}", method.name()),
        }
        for component in report.components() {
            let merged =
                fuse(&[target.map, source.map], &component, &FusionParams::default(), &())?;
            println!(
                "  {} maps in {} x {} cells",
                component.members.len(),
                merged.map.width(),
                merged.map.height()
            );
        }
    }
    Ok(())
}
