//! Matches the maps of two simulated robots that started apart on one floor.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use grid_match::{MatchParams, match_maps};
use ogm_core::Outcome;
use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, simulate_pair};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let world = PairParams {
        lidar: LidarParams { beams: 181, ..LidarParams::rf() },
        mapping: MappingParams { resolution: 0.05, ..MappingParams::default() },
        ..PairParams::default()
    };
    let pair = simulate_pair(&FloorPlan::random(7)?, &world)?;
    let report = match_maps(&pair.target.map, &pair.source.map, &MatchParams::default(), &())?;

    for hypothesis in &report.hypotheses {
        let pose = hypothesis.pose.target_from_source;
        println!(
            "{:7.3} m {:7.3} m {:8.3}°  probability {:.3}  overlap {:.2}  agreement {:.2}",
            pose.x(),
            pose.y(),
            pose.theta().to_degrees(),
            hypothesis.pose.probability,
            hypothesis.overlap,
            hypothesis.agreement,
        );
    }
    match report.outcome {
        Outcome::Found(target_from_source) => {
            let error = pair.target_from_source.between(&target_from_source);
            println!("off by {:.4} m, {:.4} rad", error.translation().norm(), error.theta());
        }
        Outcome::Refused(refusal) => println!("refused: {refusal}"),
    }
    Ok(())
}
